"""Matches the cells of a submitted notebook with those of the release, even if they have lost their names.

They are matched by name (nbgrader's grade_id), then by cell id, then by text and position between matched
cells. An ambiguous cell is not matched.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from grader.marking.submission.plain_cells import Cell, is_answer

MIN_LIKENESS = 0.5  # share of the released cell's lines
MIN_MARGIN = 0.2  # by which the best match must be better than the next

Cells = Sequence[Cell]
Pairs = list[tuple[int, int]]  # index in the release, index in the submission


@dataclass
class Match:
    """A mapping from a release's cells to submitted ones, all by index.

    copies: for each cell of the release its submitted copies, in order; empty where it is missing.
    by_id, by_text: cells of the release whose name was lost. swapped: those that had another cell's name.
    """

    copies: list[list[int]]
    by_id: list[int] = field(default_factory=list)
    by_text: list[int] = field(default_factory=list)
    swapped: list[int] = field(default_factory=list)

    def used(self) -> set[int]:
        """The submitted cells that are matched."""
        return {index for copies in self.copies for index in copies}


def match_cells(release: Sequence[Cell], submitted: Sequence[Cell]) -> Match:
    """Match the cells of `release` with those in `submitted`."""
    found = Match([[] for _ in release])
    _match_names(release, submitted, found)
    _match_ids(release, submitted, found)
    for pairs in (_equal_pairs, _similar_pairs, _single_pairs):
        for missing, free in _gaps(found, len(submitted)):
            for r, s in pairs(release, submitted, missing, free):
                found.copies[r].append(s)
                if release[r].name:
                    found.by_text.append(r)
    return found


def _match_names(release: Sequence[Cell], submitted: Sequence[Cell], found: Match) -> None:
    names = {cell.name: r for r, cell in enumerate(release) if cell.name}
    ids = {cell.id: names[cell.name] for cell in release if cell.id and cell.name}
    for s, cell in enumerate(submitted):
        r = names.get(cell.name)
        if r is None:
            continue
        other = ids.get(cell.id, r)
        if other != r:  # an id is created with its cell and never shown, so it is more reliable
            found.swapped.append(other)
        found.copies[other].append(s)


def _match_ids(release: Sequence[Cell], submitted: Sequence[Cell], found: Match) -> None:
    ids = {cell.id: r for r, cell in enumerate(release) if cell.id}
    for s in sorted(set(range(len(submitted))) - found.used()):
        r = ids.get(submitted[s].id)
        if r is not None and not found.copies[r]:
            found.copies[r].append(s)
            if release[r].name:
                found.by_id.append(r)


def _gaps(found: Match, length: int) -> Iterator[tuple[list[int], list[int]]]:
    """Yield the unmatched cells between two matched ones, with the unmatched submitted ones there."""
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


def _equal_pairs(release: Cells, submitted: Cells, missing: list[int], free: list[int]) -> Pairs:
    """Cells with the same text."""
    return _mutual_best(missing, free, lambda r, s: float(release[r].key == submitted[s].key), least=1.0)


def _similar_pairs(release: Cells, submitted: Cells, missing: list[int], free: list[int]) -> Pairs:
    """Cells that have most lines of the released one, or define what it defines.

    Tests are left out: students have no reason to edit one, so a cell like a test is the student's own.
    """

    def likeness(r: int, s: int) -> float:
        released, cell = release[r], submitted[s]
        if cell.kind not in (released.kind, "") or (released.name and not is_answer(released)):
            return 0.0
        common = len(released.lines & cell.lines) / max(1, len(released.lines))
        return common + bool(released.defined and released.defined <= cell.defined)

    return _mutual_best(missing, free, likeness, least=MIN_LIKENESS)


def _single_pairs(release: Cells, submitted: Cells, missing: list[int], free: list[int]) -> Pairs:
    """An answer and the only unmatched code cell at its position."""
    answers = [r for r in missing if is_answer(release[r])]
    cells = [s for s in free if submitted[s].kind in ("code", "") and submitted[s].key]
    single = len(answers) == len(cells) == 1 and release[answers[0]].kind == "code"
    return [(answers[0], cells[0])] if single else []


def _mutual_best(
    missing: Sequence[int], free: Sequence[int], likeness: Callable[[int, int], float], least: float
) -> Pairs:
    """The pairs of which each is clearly the best match of the other."""
    table = {(r, s): likeness(r, s) for r in missing for s in free}
    pairs = []
    for r in missing:
        s, value = _clearly_best({s: table[r, s] for s in free})
        if s is not None and value >= least and _clearly_best({r: table[r, s] for r in missing})[0] == r:
            pairs.append((r, s))
    return pairs


def _clearly_best(values: Mapping[int, float]) -> tuple[int | None, float]:
    best = sorted(values, key=values.__getitem__, reverse=True)[:2]
    if not best or (len(best) == 2 and values[best[0]] < values[best[1]] + MIN_MARGIN):
        return None, 0.0
    return best[0], values[best[0]]
