"""A heart in a robot's namespace: a full name, and two timers that share what the node knows."""

from grader.checks import LogMatch, Missed, come_every, logs
from grader.exercise import Exercise
from grader.responses import EDGE
from grader.variants import Variants
from sim.evidence import Recording

heart = Exercise("heart", "A heart with two timers", seconds=5, variants=Variants(
    {"namespace": ("robot1", "robot3", "robot7")},
    {"period": (0.25, 0.2, 0.5), "often": ("four times", "five times", "twice"),
     "beats": ("four beats", "five beats", "two beats"),
     "one": (4, 5, 2), "two": (8, 10, 4), "less": (3, 4, 1)},
    texts=("/{namespace}", "{period:g} s", "create_timer({period:g}, ", "{often} a second", "{beats}",
           "Beats: {one}", "Beats: {two}", "Beats: {less}"),
    elsewhere=("[{namespace}.heart]: Beats: {one}",),
))


@heart.check(4)
def called_heart_of_robot1(run: Recording) -> None:
    """The node is called heart and is in the namespace /robot1."""
    name, nodes = f"/{heart.drawn.namespace}/heart", run.graph.nodes
    if name in nodes:
        return
    hint = "super().__init__ takes the name first; pass the namespace as a keyword: namespace=..."
    if any(node.endswith("/heart") for node in nodes):
        hint = f"The name is right. {hint}"
    raise Missed(f"a node called {name}", ", ".join(nodes) or "no node", hint)


@heart.check(5, lasts=True)
def beats(run: Recording) -> list[LogMatch]:
    """“Beat” is logged every 0.25 s."""
    lines = logs(run, r"^\W*?beat\W*$", level="INFO", example="Beat")
    return come_every(run, lines, heart.drawn.period, credit=0.2)


@heart.check(5, lasts=True)
def reports(run: Recording) -> list[LogMatch]:
    """A report like “Beats: 4” is logged every second."""
    lines = logs(run, r"^\W*?beats\W+(\d+)", level="INFO", example=f"Beats: {heart.drawn.one}")
    return come_every(run, lines, 1.0, credit=0.2)


@heart.check(6, after=(beats, reports))
def reports_all_beats(run: Recording, beats: list[LogMatch], reports: list[LogMatch]) -> None:
    """Each report says how many beats there have been since the start."""
    stamps = [beat.stamp for beat in beats]
    for report in reports:
        # At the same moment, either of the two timers may come first.
        most = sum(stamp <= report.stamp for stamp in stamps)
        fewest = sum(stamp < report.stamp - EDGE for stamp in stamps)
        if not fewest <= int(report.groups[0]) <= most:
            hint = ("One callback counts the beats and the other reports them: both use the same attribute "
                    "of self.")
            raise Missed(f"“Beats: {most}” at {report.stamp:.3g} s", f"“{report.text}”", hint)
