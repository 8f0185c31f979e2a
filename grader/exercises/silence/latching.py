"""An exercise on durability: hear what was said before you came, and leave word for those who come later."""

from __future__ import annotations

from grader.checks import Missed, hinting, publishes, subscribes
from grader.checks.no_data import no_data
from grader.exercise import Exercise
from grader.exercises.silence.senders import FREE, MapServer, Visitor
from sim.evidence import Recording, Seconds

GRID, COUNT = "nav_msgs/msg/OccupancyGrid", "std_msgs/msg/Int32"
SOON = 1.0  # s
FIRST, SECOND = (3.0, 4.5), (7.0, 8.5)  # s, when the visitor is there

late = Exercise("late", "Latecomers", seconds=9, companions=[MapServer, Visitor], seeds=(1, 2))


@late.check(2)
def listens_to_the_map(run: Recording) -> None:
    """The node subscribes to /map."""
    with hinting("The map comes on /map."):
        subscribes(run, "/map", GRID)


@late.check(5, after=listens_to_the_map)
def hears_what_was_said_before(run: Recording) -> None:
    """It hears the map that was published before it began: its free cells (Int32) are on /free at once."""
    free, said = _truth(run)[0], publishes(run.during(0.0, run.ended.stamp), "/free", COUNT)
    first = said[0]
    if first.stamp > SOON:
        raise Missed(
            f"{free} on /free within {SOON:g} s",
            f"nothing there before {first.stamp:.3g} s",
            "The map was published before your node was there, and only once. Who wants to hear it "
            "asks for durability TRANSIENT_LOCAL, and stays reliable.",
        )
    if first.message.data != free:
        raise Missed(f"{free} free cells", f"{first.message.data}", _why_wrong(run, first.message.data))


@late.check(2, after=hears_what_was_said_before)
def speaks_once_for_each_map(run: Recording) -> None:
    """Each map gets one message, when it comes, and no other is sent."""
    said, free = [heard.message.data for heard in run.messages("/free")], _truth(run)
    if said != free:
        hint = (
            "Publish in the map's callback and nowhere else: who comes later is the middleware's care."
            if len(said) > len(free)
            else "The callback is called with every map, and each of them has its own count."
        )
        expected = f"{len(free)} messages: {', '.join(map(str, free))}"
        raise Missed(expected, f"{len(said)}: {', '.join(map(str, said[:5]))}", hint)


@late.check(4, after=hears_what_was_said_before)
def leaves_word(run: Recording) -> None:
    """Who comes at 3 s hears it, though it was sent long before."""
    _received(run, FIRST, _truth(run)[0])


@late.check(3, after=leaves_word)
def only_the_newest_counts(run: Recording) -> None:
    """A node that comes at 7 s hears the count of the newest map, and of no other."""
    _received(run, SECOND, _truth(run)[-1])


def _truth(run: Recording) -> list[int]:
    """How many cells are free in each of our maps."""
    maps = [heard.message.data for heard in run.messages("/map") if heard.from_course]
    if len(maps) < 2:
        raise no_data(run, "two maps", f"{len(maps)}", run.graph.publishers("/map"))
    return [sum(cell == FREE for cell in cells) for cells in maps]


def _received(run: Recording, window: tuple[Seconds, Seconds], free: int) -> None:
    got = [heard.message.data for heard in run.during(*window).messages("/receipt") if heard.from_course]
    if got == [free]:
        return
    expected = f"{free}, and nothing else, for the visitor who comes at {window[0]:g} s"
    if free in got:
        hint = (
            "The depth says how many old messages are kept for latecomers: here one."
            if len(set(got)) > 1
            else "Publish when a map comes, and not again and again."
        )
        raise Missed(expected, ", ".join(map(str, got)), hint)
    guess = "What was sent is kept for latecomers if the publisher has durability TRANSIENT_LOCAL."
    raise Missed(expected, ", ".join(map(str, got)) or "nothing", guess=guess)


def _why_wrong(run: Recording, said: int) -> str:
    """The usual reasons for another number."""
    cells = next(heard.message.data for heard in run.messages("/map") if heard.from_course)
    known = sum(cell >= 0 for cell in cells)
    if said == known:
        return "That is how many cells are known. A free cell is 0."
    if said == sum(cell > 0 for cell in cells):
        return "That is how many are occupied, 100. A free cell is 0."
    if said == len(cells):
        return "That is how many cells there are. A free one is 0, an occupied one 100, an unknown one -1."
    return "Count the cells of msg.data that are 0; -1 means that nothing is known there."
