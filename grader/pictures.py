"""The figures that go with a score: one of each kind, for the first miss that asks for it."""

from __future__ import annotations

from collections.abc import Sequence

from grader.checks.judge import Verdict
from sim.recording import Recording


def draw(verdicts: Sequence[Verdict], recordings: Sequence[Recording]) -> list[tuple[str, bytes]]:
    """Pairs of a caption and a PNG."""
    wanted: dict[str, Verdict] = {}
    for verdict in verdicts:
        if verdict.picture and verdict.run < len(recordings):
            wanted.setdefault(verdict.picture, verdict)
    return [_picture(kind, recordings[verdict.run]) for kind, verdict in wanted.items()]


def _picture(kind: str, recording: Recording) -> tuple[str, bytes]:
    from sim.view import plot_path, plot_topics, png

    if kind == "path":
        return "The robot's path, seen from above", png(plot_path(recording))
    return "What was published, and when", png(plot_topics(recording))
