"""A heart in a robot's namespace: a full name, and two timers that share what the node knows."""

from __future__ import annotations

from grader.checks import Missed, check
from grader.exercise import Exercise
from grader.exercises.nodes.lines import Found, come_every, lines_like
from sim.recording import LogLine, Recording

NAME = "/robot1/heart"


@check(points=4)
def called_heart_of_robot1(recording: Recording) -> None:
    """The node is called heart and lives in the namespace /robot1."""
    nodes = recording.graph.nodes
    if NAME in nodes:
        return
    hint = "super().__init__ takes the name first, and then the namespace by its own name: namespace=..."
    if any(node.endswith("/heart") for node in nodes):
        hint = f"The name is right. {hint}"
    raise Missed(f"a node called {NAME}", ", ".join(nodes) or "no node", hint)


def _beats(recording: Recording) -> list[LogLine]:
    return [line for line, _ in lines_like(recording, r"beat\W*$", "Beat", level="INFO")]


def _reports(recording: Recording) -> list[Found]:
    return lines_like(recording, r"beats\W+(\d+)", "Beats: 4", level="INFO")


@check(points=5)
def beats(recording: Recording) -> None:
    """“Beat” is logged every 0.25 s."""
    come_every(recording, _beats(recording), 0.25, credit=0.2)


@check(points=5)
def reports(recording: Recording) -> None:
    """A report like “Beats: 4” is logged every second."""
    come_every(recording, [line for line, _ in _reports(recording)], 1.0, credit=0.2)


@check(points=6, after=(beats, reports))
def reports_all_beats(recording: Recording) -> None:
    """Each report says how many beats there have been since the start."""
    moments = [line.stamp for line in _beats(recording)]
    for line, found in _reports(recording):
        # At the same moment, either of the two timers may come first.
        most = sum(moment <= line.stamp for moment in moments)
        fewest = sum(moment < line.stamp - 1e-6 for moment in moments)
        if not fewest <= int(found[1]) <= most:
            hint = "One callback counts, the other reads: they share one value in self."
            raise Missed(f"“Beats: {most}” at {line.stamp:.3g} s", f"“{line.text}”", hint)


heart = Exercise(
    "heart", "A heart with two timers", [called_heart_of_robot1, beats, reports, reports_all_beats], seconds=5
)
