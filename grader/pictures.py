"""What goes with a score: one picture of each kind, for the first miss that asks for it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from grader.checks.judge import Verdict
from sim.evidence import Recording


def draw(verdicts: Sequence[Verdict], recordings: Sequence[Recording]) -> list[tuple[str, Any]]:
    """Pairs of a caption and what Jupyter displays: the replay of a drive, a figure of what was published."""
    wanted: dict[str, Verdict] = {}
    for verdict in verdicts:
        if verdict.picture and verdict.run < len(recordings):
            wanted.setdefault(verdict.picture, verdict)
    return [_picture(kind, recordings[verdict.run]) for kind, verdict in wanted.items()]


def _picture(kind: str, recording: Recording) -> tuple[str, Any]:
    from sim.view import plot_topics

    if kind == "path":
        return "The robot's path, seen from above", recording.replay()
    return "What was published, and when", plot_topics(recording)
