"""Durability: receive what was published before the node started, and latch for later subscribers."""

from grader.checks import Missed, hinting, otherwise, publishes, subscribes
from grader.companions.latched_map import FREE, LatchedMap, LateSubscriber
from grader.exercise import Exercise
from grader.responses import from_course
from sim.evidence import Recording, Seconds

GRID, COUNT = "nav_msgs/msg/OccupancyGrid", "std_msgs/msg/Int32"
SOON = 1.0  # s
FIRST, SECOND = (3.0, 4.5), (7.0, 8.5)  # s, while the visitor is subscribed

late = Exercise("late", "Latecomers", seconds=9, companions=[LatchedMap, LateSubscriber], seeds=(1, 2))


@late.check(2)
def subscribes_to_the_map(run: Recording) -> None:
    """The node subscribes to /map."""
    with hinting("The map is published on /map."):
        subscribes(run, "/map", GRID)


@late.check(5, after=subscribes_to_the_map, hints={
    "That is the number of known cells. A free cell is 0.":
        lambda run, count: count == sum(cell >= 0 for cell in _cells(run)),
    "That is the number of occupied cells, 100. A free cell is 0.":
        lambda run, count: count == sum(cell > 0 for cell in _cells(run)),
    "That is the number of all cells. A free one is 0, an occupied one 100, an unknown one -1.":
        lambda run, count: count == len(_cells(run)),
    "Count the cells of msg.data that are 0; -1 means unknown.": otherwise,
})
def receives_the_latched_map(run: Recording) -> None:
    """It receives the map that was published before it started: its free cells (Int32) are on /free."""
    free, first = _truth(run)[0], publishes(run.during(0.0, run.ended.stamp), "/free", COUNT)[0]
    if first.stamp > SOON:
        hint = ("The map was published before your node was there, and only once. To receive it, request "
                "durability TRANSIENT_LOCAL, and stay reliable.")
        raise Missed(f"{free} on /free within {SOON:g} s", f"nothing there before {first.stamp:.3g} s", hint)
    if first.message.data != free:
        raise Missed(f"{free} free cells", f"{first.message.data}", about=(first.message.data,))


@late.check(2, after=receives_the_latched_map)
def publishes_once_for_each_map(run: Recording) -> None:
    """For each map one message is published, when the map arrives, and no others."""
    sent, free = [row.message.data for row in run.messages("/free")], _truth(run)
    if sent != free:
        hint = "The callback is called with every map: count each one anew."
        if len(sent) > len(free):
            hint = "Publish in the map's callback and nowhere else: the middleware takes care of latecomers."
        expected = f"{len(free)} messages: {', '.join(map(str, free))}"
        raise Missed(expected, f"{len(sent)}: {', '.join(map(str, sent[:5]))}", hint)


@late.check(4, after=receives_the_latched_map)
def latches_the_count(run: Recording) -> None:
    """A node that starts at 3 s receives it, although it was published long before."""
    _received(run, FIRST, _truth(run)[0])


@late.check(3, after=latches_the_count)
def only_the_newest_counts(run: Recording) -> None:
    """A node that starts at 7 s receives the count of the newest map, and of no other."""
    _received(run, SECOND, _truth(run)[-1])


def _truth(run: Recording) -> list[int]:
    """How many cells are free in each of the course's maps."""
    maps = from_course(run, "/map", at_least=2, what="two maps")
    return [sum(cell == FREE for cell in row.message.data) for row in maps]


def _received(run: Recording, window: tuple[Seconds, Seconds], free: int) -> None:
    got = [row.message.data for row in run.during(*window).messages("/receipt") if row.from_course]
    if got == [free]:
        return
    expected = f"{free}, and nothing else, for the visitor that starts at {window[0]:g} s"
    if free in got:
        hint = "The depth is how many old messages are stored for latecomers: here you need one."
        if len(set(got)) == 1:
            hint = "Publish only when a map arrives, not again and again."
        raise Missed(expected, ", ".join(map(str, got)), hint)
    guess = "Give the publisher durability TRANSIENT_LOCAL: then its messages are stored for latecomers."
    raise Missed(expected, ", ".join(map(str, got)) or "nothing", guess=guess)


def _cells(run: Recording) -> list[int]:
    return list(from_course(run, "/map")[0].message.data)
