"""The pictures of a score: one of each kind, for the first missed check that requests it."""

from __future__ import annotations

import base64
import html
import re
from collections.abc import Sequence
from typing import Any

from grader.checks.verdicts import Verdict
from grader.deciding_moment import deciding_moment
from grader.page import named_moments
from sim.evidence import Recording
from sim.evidence.connections import missing

MOMENTS = 20  # marked in a replay
CHARACTERS = 4_000  # of a graph's description


def score_pictures(verdicts: Sequence[Verdict], recordings: Sequence[Recording]) -> list[tuple[str, Any]]:
    """Pairs of a caption and an object for Jupyter: the replay of a run, or a plot of its topics."""
    wanted: dict[str, Verdict] = {}
    for verdict in verdicts:
        if verdict.picture and verdict.run < len(recordings):
            wanted.setdefault(verdict.picture, verdict)
    return [
        _picture(kind, recordings[number], missed_moments(verdicts, number, recordings[number]))
        for kind, number in ((kind, verdict.run) for kind, verdict in wanted.items())
    ]


def missed_moments(
    verdicts: Sequence[Verdict], number: int, recording: Recording
) -> list[tuple[float, str]]:
    """The moments (s) of a run's missed checks, with what they say, in order; each once.

    They are those that the texts name. A miss about a part of the run has the moment that shows it, or else
    when the part began; one about the whole run counts only where there is no other.
    """
    found: list[tuple[float, str]] = []
    whole: list[tuple[float, str]] = []
    for verdict in verdicts:
        if verdict.run != number or verdict.status != "failed":
            continue
        text = f"{verdict.sentence} {verdict.saw}"
        named = named_moments(verdict)
        found += [(stamp, text) for stamp in named]
        part = recording if verdict.begin is None else recording.during(verdict.begin)
        shown = None if named else deciding_moment(verdict, part)
        shown = verdict.begin if shown is None and not named else shown
        if shown is not None:
            (whole if verdict.begin is None else found).append((shown, text))
    return sorted({stamp: text for stamp, text in reversed(found or whole[:1])}.items())[:MOMENTS]


def replay_keys(verdicts: Sequence[Verdict], recordings: Sequence[Recording]) -> dict[int, str]:
    """The keys of the runs that `score_pictures` shows as replays, by index."""
    from sim.view.replay_data import run_key

    shown = next((verdict.run for verdict in verdicts if verdict.picture == "path"), len(recordings))
    return {shown: run_key(recordings[shown])} if shown < len(recordings) else {}


def _picture(kind: str, recording: Recording, missed: list[tuple[float, str]]) -> tuple[str, Any]:
    from sim.view import plot_signal, plot_topics

    if kind == "path":
        return "The robot's path, seen from above", recording.replay(moments=missed)
    if kind.startswith("/"):
        return f"The numbers on {kind}", plot_signal(recording, kind)
    return "What was published, and when", plot_topics(recording)


def graph_of_missed_check(verdicts: Sequence[Verdict], recordings: Sequence[Recording]) -> tuple[int, str]:
    """The index of a verdict that a missing connection explains, and the graph of its run as HTML.

    It is the first missed check that mentions a topic, service or action with an unconnected end of the
    student's in its run; unconnected ends of the course are part of the exercise. The HTML is "" if there is
    none.
    """
    names: dict[int, set[str]] = {}  # by run
    for index, verdict in enumerate(verdicts):
        if verdict.status != "failed" or verdict.run >= len(recordings):
            continue
        recording = recordings[verdict.run]
        if verdict.run not in names:
            names[verdict.run] = _unconnected(recording)
        words = " ".join((verdict.sentence, verdict.expected, verdict.saw, verdict.hint))
        if any(re.search(rf"(?<![\w/]){re.escape(name)}(?![\w/])", words) for name in names[verdict.run]):
            return index, _folded_graph(recording)
    return 0, ""


def _unconnected(recording: Recording) -> set[str]:
    pairs = [[end for end in (gap.given, gap.wanted) if end] for gap in missing(recording.graph)]
    return {end.name for pair in pairs for end in pair if not all(end.from_course for end in pair)}


def _folded_graph(recording: Recording) -> str:
    from sim.view import plot_graph, small_png

    figure = plot_graph(recording)
    picture = base64.b64encode(small_png(figure)).decode()
    return (
        "<details><summary>The graph of this run: what is missing is red</summary>"
        f'<img src="data:image/png;base64,{picture}" alt="{html.escape(figure.description[:CHARACTERS])}"'
        ' style="max-width: 100%"></details>'
    )
