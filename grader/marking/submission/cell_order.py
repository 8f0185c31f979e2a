"""Orders the cells of a rebuilt notebook as the student had them, so that they run in that order.

If code cells of the assignment were moved, such as the set-up or a test above its answer, all of them get the
release's order: in the student's open kernel, cells may have been run in another order than they are in.
"""

from bisect import bisect_left
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from grader.marking.submission.plain_cells import Cell, is_test


class CellPlace(NamedTuple):
    """A cell by its index, in the release or among the submitted cells."""

    released: bool
    at: int


def order_cells(
    release: Sequence[Cell], chosen: Mapping[int, int], own: Iterable[int]
) -> tuple[list[CellPlace], list[int]]:
    """Return the order, and which cells of the release were moved, by index in it.

    chosen: the submitted cell of each cell of the release, by index. own: the student's own cells.
    """
    seen = [*((s, CellPlace(True, r)) for r, s in chosen.items()), *((s, CellPlace(False, s)) for s in own)]
    order = [place for _, place in sorted(seen)]
    released = [place.at for place in order if place.released]
    code = [r for r in released if release[r].kind == "code"]
    moved = sorted(set(code) - set(_in_order(code)))
    # A missing cell has a position only if those of the release are in order.
    if moved or (len(released) < len(release) and released != sorted(released)):
        return _as_released(release, order), moved
    for r in range(len(release)):
        if r not in chosen:
            order.insert(_place_of_missing(release, order, r), CellPlace(True, r))
    return order, []


def _in_order(numbers: Sequence[int]) -> list[int]:
    """The longest increasing subsequence of these different numbers."""
    ends: list[int] = []  # the smallest last number of an increasing subsequence of each length
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


def _as_released(release: Sequence[Cell], order: Sequence[CellPlace]) -> list[CellPlace]:
    """The release's cells in its order, and each of the student's own before the same cell as it was."""
    before: dict[int, list[CellPlace]] = {}
    waiting: list[CellPlace] = []
    for place in order:
        if place.released:
            before[place.at], waiting = waiting, []
        else:
            waiting.append(place)
    cells = [[*before.get(r, ()), CellPlace(True, r)] for r in range(len(release))]
    return [place for group in (*cells, waiting) for place in group]


def _place_of_missing(release: Sequence[Cell], order: Sequence[CellPlace], r: int) -> int:
    """Directly after the previous cell; a test directly before the next one: after the student's own."""
    known = {place.at: position for position, place in enumerate(order) if place.released}
    later = [known[other] for other in range(r + 1, len(release)) if other in known]
    if is_test(release[r]):
        return min(later, default=len(order))
    return known[r - 1] + 1 if r else 0
