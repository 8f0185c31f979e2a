"""In which order the cells of a rebuilt notebook stand: as the student had them, so that they run as there.

Where code of the assignment has left its place, such as the set-up or a test above its answer, the release's
order holds for all of it: in the kernel that the student had open, another one may have worked.
"""

from bisect import bisect_left
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from grader.marking.handed_in.cells import Cell, is_test


class Place(NamedTuple):
    """A cell by its index: of the release, or of the student's own."""

    from_course: bool
    index: int


def order_cells(
    release: Sequence[Cell], chosen: Mapping[int, int], own: Iterable[int]
) -> tuple[list[Place], list[int]]:
    """Return the order, and which cells of the release had left their place, by index in it.

    chosen: which submitted cell stands for which of the release, by index. own: the student's own cells.
    """
    seen = [*((s, Place(True, r)) for r, s in chosen.items()), *((s, Place(False, s)) for s in own)]
    order = [place for _, place in sorted(seen)]
    ours = [place.index for place in order if place.from_course]
    code = [r for r in ours if release[r].kind == "code"]
    moved = sorted(set(code) - set(_in_order(code)))
    if moved or (len(ours) < len(release) and ours != sorted(ours)):  # else a missing one has no place
        return _as_released(release, order), moved
    for r in range(len(release)):
        if r not in chosen:
            order.insert(_place_of_missing(release, order, r), Place(True, r))
    return order, []


def _in_order(numbers: Sequence[int]) -> list[int]:
    """As many of these different numbers as stand in order, each behind a smaller one."""
    ends: list[int] = []  # the smallest end of a row of each length
    lengths = []
    for number in numbers:
        length = bisect_left(ends, number)
        ends[length : length + 1] = [number]
        lengths.append(length)
    row: list[int] = []
    wanted = len(ends) - 1
    for number, length in zip(reversed(numbers), reversed(lengths), strict=True):
        if length == wanted and (not row or number < row[-1]):
            row.append(number)
            wanted -= 1
    return row[::-1]


def _as_released(release: Sequence[Cell], order: Sequence[Place]) -> list[Place]:
    """The release's cells in its order, and each of the student's own before the one that it stood before."""
    before: dict[int, list[Place]] = {}
    waiting: list[Place] = []
    for place in order:
        if place.from_course:
            before[place.index], waiting = waiting, []
        else:
            waiting.append(place)
    cells = [[*before.get(r, ()), Place(True, r)] for r in range(len(release))]
    return [place for group in (*cells, waiting) for place in group]


def _place_of_missing(release: Sequence[Cell], order: Sequence[Place], r: int) -> int:
    """Right behind the cell before it; a test before the cell behind it, and so after the student's own."""
    known = {place.index: position for position, place in enumerate(order) if place.from_course}
    behind = [known[other] for other in range(r + 1, len(release)) if other in known]
    if is_test(release[r]):
        return min(behind, default=len(order))
    return known[r - 1] + 1 if r else 0
