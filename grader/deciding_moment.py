"""The moment that shows a miss about the whole run, found in what its text says and what the run has."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from grader.checks.verdicts import Verdict
from sim.evidence import Pose, Recording

STILL = 2e-3  # m and rad; a robot that moves less stands
QUOTED = re.compile(r"“([^”]+)”")
TOPIC = re.compile(r"(?<![\w/])/[a-z]\w*(?:/\w+)*")
SILENT = re.compile(r"\b(none for|no more|stop\w*|silent|end\w*)\b")
STOOD = re.compile(r"\b(stand\w*|stood|never|away|reach\w*|left|gets|ends)\b")
MOVED = re.compile(r"\b(mov\w+|turn\w+|driv\w+|drove|path|rad/s|m/s|m)\b")


def deciding_moment(verdict: Verdict, run: Recording) -> float | None:
    """Return when (s) the run shows what was missed, though the text names no time; None where nothing tells.

    A quoted log line: its stamp. A topic: its first message from the student, or its last one if it should
    have gone on. A motion: the first one, or the last one of a robot that didn't get far enough.
    """
    found = _of_log(QUOTED.findall(verdict.saw), run)
    if found is None:
        found = _of_topic(f"{verdict.expected} {verdict.saw}", verdict.saw, run)
    if found is None and MOVED.search(f"{verdict.expected} {verdict.saw}"):
        found = _of_motion(run.path, last=bool(STOOD.search(verdict.saw)))
    return found


def _of_log(texts: Iterable[str], run: Recording) -> float | None:
    wanted = set(texts)
    return next((line.stamp for line in run.logs if line.text in wanted), None)


def _of_topic(words: str, saw: str, run: Recording) -> float | None:
    for name in TOPIC.findall(words):
        sent = [item for item in run.messages(name) if not item.from_course]
        if sent:
            return sent[-1 if SILENT.search(saw) else 0].stamp
    return None


def _of_motion(path: Sequence[Pose], *, last: bool) -> float | None:
    """Return when the robot begins to move, or comes to its last place; None if it never moves."""
    poses = path[::-1] if last else path
    return next((pose.stamp for pose in poses if _differ(pose, poses[0])), None) if poses else None


def _differ(pose: Pose, other: Pose) -> bool:
    return max(abs(a - b) for a, b in zip(pose[1:4], other[1:4], strict=True)) > STILL
