"""Finds the cells of an assignment in what a student handed in, even where their names were lost.

By name (nbgrader's grade_id), then by cell id, then by text and place between cells that are known. Where
two cells could be meant, neither is taken.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from grader.marking.handed_in.cells import Cell, is_answer

ALIKE = 0.5  # share of the lines that were handed out
CLEARLY = 0.2  # how much more alike than the next

Pairs = list[tuple[int, int]]  # index in the release, index in the submitted


@dataclass
class Match:
    """Which submitted cells are which of a release's, all by index.

    copies: for each cell of the release its submitted copies, in order; empty where it is missing.
    by_id, by_look: cells of the release whose name was lost. swapped: those that bore another one's name.
    """

    copies: list[list[int]]
    by_id: list[int] = field(default_factory=list)
    by_look: list[int] = field(default_factory=list)
    swapped: list[int] = field(default_factory=list)

    def used(self) -> set[int]:
        """The submitted cells that are the release's."""
        return {index for copies in self.copies for index in copies}


def match_cells(release: Sequence[Cell], submitted: Sequence[Cell]) -> Match:
    """Find the cells of `release` in `submitted`."""
    found = Match([[] for _ in release])
    _by_name(release, submitted, found)
    _by_id(release, submitted, found)
    for pairs in (_equal, _alike, _alone):
        for missing, free in _gaps(found, len(submitted)):
            for r, s in pairs(release, submitted, missing, free):
                found.copies[r].append(s)
                if release[r].name:
                    found.by_look.append(r)
    return found


def _by_name(release: Sequence[Cell], submitted: Sequence[Cell], found: Match) -> None:
    names = {cell.name: r for r, cell in enumerate(release) if cell.name}
    ids = {cell.id: names[cell.name] for cell in release if cell.id and cell.name}
    for s, cell in enumerate(submitted):
        r = names.get(cell.name)
        if r is None:
            continue
        other = ids.get(cell.id, r)
        if other != r:  # an id is made with its cell and nobody sees it, so it is the better witness
            found.swapped.append(other)
        found.copies[other].append(s)


def _by_id(release: Sequence[Cell], submitted: Sequence[Cell], found: Match) -> None:
    ids = {cell.id: r for r, cell in enumerate(release) if cell.id}
    for s in sorted(set(range(len(submitted))) - found.used()):
        r = ids.get(submitted[s].id)
        if r is not None and not found.copies[r]:
            found.copies[r].append(s)
            if release[r].name:
                found.by_id.append(r)


def _gaps(found: Match, length: int) -> Iterator[tuple[list[int], list[int]]]:
    """Yield the missing cells between two known ones, with the free submitted ones in the same place."""
    used = found.used()
    missing: list[int] = []
    start = 0
    for r, copies in enumerate([*found.copies, [length]]):
        if not copies:
            missing.append(r)
            continue
        if missing:
            yield missing, [s for s in range(start, copies[0]) if s not in used]
        missing, start = [], copies[-1] + 1


def _equal(release: Sequence[Cell], submitted: Sequence[Cell], missing: list[int], free: list[int]) -> Pairs:
    """Those that say the same."""
    return _only(missing, free, lambda r, s: float(release[r].key == submitted[s].key), least=1.0)


def _alike(release: Sequence[Cell], submitted: Sequence[Cell], missing: list[int], free: list[int]) -> Pairs:
    """Those that kept most lines of what was handed out, or define what it defined.

    No tests: nobody has to change one, so a cell that is like a test is the student's own.
    """

    def likeness(r: int, s: int) -> float:
        ours, theirs = release[r], submitted[s]
        if theirs.kind not in (ours.kind, "") or (ours.name and not is_answer(ours)):
            return 0.0
        kept = len(ours.lines & theirs.lines) / max(1, len(ours.lines))
        return kept + bool(ours.defined and ours.defined <= theirs.defined)

    return _only(missing, free, likeness, least=ALIKE)


def _alone(release: Sequence[Cell], submitted: Sequence[Cell], missing: list[int], free: list[int]) -> Pairs:
    """An answer and the only cell in its place."""
    answers = [r for r in missing if is_answer(release[r])]
    cells = [s for s in free if submitted[s].kind in ("code", "") and submitted[s].key]
    alone = len(answers) == len(cells) == 1 and release[answers[0]].kind == "code"
    return [(answers[0], cells[0])] if alone else []


def _only(
    missing: Sequence[int], free: Sequence[int], likeness: Callable[[int, int], float], least: float
) -> Pairs:
    """The pairs that are clearly more alike than either of the two is to any other."""
    table = {(r, s): likeness(r, s) for r in missing for s in free}
    pairs = []
    for r in missing:
        s, value = _clearly_best({s: table[r, s] for s in free})
        if s is not None and value >= least and _clearly_best({r: table[r, s] for r in missing})[0] == r:
            pairs.append((r, s))
    return pairs


def _clearly_best(values: Mapping[int, float]) -> tuple[int | None, float]:
    best, *others = sorted(values, key=values.__getitem__, reverse=True)[:2] or [None]
    if best is None or (others and values[best] < values[others[0]] + CLEARLY):
        return None, 0.0
    return best, values[best]
