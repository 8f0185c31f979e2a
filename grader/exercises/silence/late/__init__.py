"""Durability: receive what was published before the node started, and latch for later subscribers."""

from collections.abc import Callable

from grader.checks import Missed, hinting, publishes, subscribes
from grader.checks.check import Check
from grader.exercise import Exercise
from grader.exercises.silence.late.latched_map import FREE, LatchedMap, LateSubscriber
from sim.evidence import Message, Recording, Seconds

__all__ = ["LatchedMap", "LateSubscriber", "late"]

GRID, COUNT = "nav_msgs/msg/OccupancyGrid", "std_msgs/msg/Int32"
SOON = 1.0  # s
FIRST, SECOND = (3.0, 4.5), (7.0, 8.5)  # s, while the visitor is subscribed

late = Exercise("late", "Latecomers", seconds=9, companions=[LatchedMap, LateSubscriber], seeds=(1, 2))


@late.check(2)
def subscribes_to_the_map(run: Recording) -> None:
    """The node subscribes to /map."""
    with hinting("The map is published on /map."):
        subscribes(run, "/map", GRID)


# What is counted by mistake; the rest can still be judged then.
COUNTS: dict[str, Callable[[list[int]], int]] = {
    "": lambda cells: cells.count(FREE),
    "That is the number of known cells. A free cell is 0.": lambda cells: sum(cell >= 0 for cell in cells),
    "That is the number of occupied cells, 100. A free cell is 0.":
        lambda cells: sum(cell > 0 for cell in cells),
    "That is the number of all cells. A free one is 0, an occupied one 100, an unknown one -1.": len,
    "Count the cells of msg.data that are 0; -1 means unknown.":
        lambda cells: sum(cell <= 0 for cell in cells),
}


@late.check(2, after=subscribes_to_the_map)
def counts_the_free_cells(run: Recording) -> None:
    """Each message on /free (Int32) has the number of free cells of one of the maps."""
    counts = [row.message.data for row in _sent(run)]
    free = [cells.count(FREE) for cells in _maps(run)]
    wrong = next((count for count in counts if count not in free), None)
    if wrong is not None:
        hint = _counted(run) or "Count the cells of msg.data that are 0; -1 means unknown."
        raise Missed(f"{free[0]} free cells", f"{wrong}", hint)


@late.check(3, after=subscribes_to_the_map)
def receives_the_latched_map(run: Recording) -> None:
    """It receives the map that was published before it started: its free cells (Int32) are on /free."""
    free, first = _truth(run)[0], _sent(run, counts_the_free_cells)[0]
    if first.stamp > SOON:
        hint = ("The map was published before your node was there, and only once. To receive it, request "
                "durability TRANSIENT_LOCAL, and stay reliable.")
        raise Missed(f"{free} on /free within {SOON:g} s", f"nothing there before {first.stamp:.3g} s", hint)
    if first.message.data != free:
        raise Missed(f"{free} on /free", f"{first.message.data}", because=(counts_the_free_cells,))


@late.check(2, after=subscribes_to_the_map)
def publishes_once_for_each_map(run: Recording) -> None:
    """For each map one message is published, when the map arrives, and no others."""
    rows, free = _sent(run, counts_the_free_cells), _truth(run)
    sent = [row.message.data for row in rows]
    if sent == free[1:] and rows[0].stamp > SOON:
        return  # it never received the first one: that has cost its part
    if sent != free:
        hint = "The callback is called with every map: count each one anew."
        if len(sent) > len(free):
            hint = "Publish in the map's callback and nowhere else: the middleware takes care of latecomers."
        expected = f"{len(free)} messages: {', '.join(map(str, free))}"
        raise Missed(expected, f"{len(sent)}: {', '.join(map(str, sent[:5]))}", hint)


@late.check(4, after=subscribes_to_the_map)
def latches_the_count(run: Recording) -> None:
    """A node that starts at 3 s receives it, although it was published long before."""
    _received(run, FIRST, _truth(run)[0], (receives_the_latched_map, counts_the_free_cells))


@late.check(3, after=subscribes_to_the_map)
def only_the_newest_counts(run: Recording) -> None:
    """A node that starts at 7 s receives the count of the newest map, and of no other."""
    _received(run, SECOND, _truth(run)[-1], (latches_the_count, receives_the_latched_map))


def _sent(run: Recording, *because: Check) -> list[Message]:
    """Return what was published on /free."""
    try:
        publishes(run, "/free", COUNT)
    except Missed as missed:
        missed.because = because
        raise
    return run.messages("/free")


def _truth(run: Recording) -> list[int]:
    """Return the number of free cells in each of the course's maps; or a mistaken count, if that is all."""
    count = COUNTS[_counted(run)]
    return [count(cells) for cells in _maps(run)]


def _counted(run: Recording) -> str:
    """The hint to what was counted in all messages; "" for the free cells, and where it is nothing known."""
    sent = {row.message.data for row in run.messages("/free")}
    return next((hint for hint, count in COUNTS.items() if sent <= set(map(count, _maps(run)))), "")


def _maps(run: Recording) -> list[list[int]]:
    """The cells of each of the course's maps, received or not."""
    return [list(row.message.data) for row in run.messages("/map") if row.from_course]


def _received(run: Recording, window: tuple[Seconds, Seconds], free: int, because: tuple[Check, ...]) -> None:
    got = [row.message.data for row in run.during(*window).messages("/receipt") if row.from_course]
    if got == [free]:
        return
    expected = f"{free}, and nothing else, for the visitor that starts at {window[0]:g} s"
    if free in got:
        hint = "The depth is how many old messages are stored for latecomers: here you need one."
        if len(set(got)) == 1:
            hint = "Publish only when a map arrives, not again and again."
        raise Missed(expected, ", ".join(map(str, got)), hint, because=because)
    guess = "Give the publisher durability TRANSIENT_LOCAL: then its messages are stored for latecomers."
    raise Missed(expected, ", ".join(map(str, got)) or "nothing", guess=guess, because=because)
