"""In which order the cells of a rebuilt notebook stand: as the student had them, so that they run as there.

Cells that were missing stand where the release has them, and no test stands before its answer.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from grader.marking.handed_in.cells import Cell, is_answer, is_test


class Place(NamedTuple):
    """A cell by its index: of the release, or of the student's own."""

    ours: bool
    index: int


def order_cells(
    release: Sequence[Cell], chosen: Mapping[int, int], own: Iterable[int]
) -> tuple[list[Place], list[int]]:
    """Return the order, and the submitted tests, by index in the release, that stood before an answer.

    chosen: which submitted cell stands for which of the release, by index. own: the student's own cells.
    """
    seen = [*((s, Place(True, r)) for r, s in chosen.items()), *((s, Place(False, s)) for s in own)]
    order = [place for _, place in sorted(seen)]
    for r in range(len(release)):
        if r not in chosen:
            order.insert(_place_of_missing(release, order, r), Place(True, r))
    moved = [r for r, answers in _tests(release) if _move_behind(order, r, answers)]
    return order, [r for r in moved if r in chosen]


def _place_of_missing(release: Sequence[Cell], order: Sequence[Place], r: int) -> int:
    """Right behind the cell before it; a test before the cell behind it, and so after the student's own."""
    known = {place.index: position for position, place in enumerate(order) if place.ours}
    behind = [known[other] for other in range(r + 1, len(release)) if other in known]
    if is_test(release[r]):
        return behind[0] if behind else len(order)
    return known[r - 1] + 1 if r else 0


def _tests(release: Sequence[Cell]) -> list[tuple[int, list[int]]]:
    """Each test with the answers between the test before it and itself."""
    found: list[tuple[int, list[int]]] = []
    answers: list[int] = []
    for r, cell in enumerate(release):
        if is_answer(cell):
            answers.append(r)
        elif is_test(cell):
            found.append((r, answers))
            answers = []
    return found


def _move_behind(order: list[Place], test: int, answers: Iterable[int]) -> bool:
    position = order.index(Place(True, test))
    last = max((order.index(Place(True, answer)) for answer in answers), default=-1)
    if position > last:
        return False
    order.insert(last, order.pop(position))
    return True
