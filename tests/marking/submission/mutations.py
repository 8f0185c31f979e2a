"""Random damage to real submissions, and what holds whatever was damaged.

    python -m tests.marking.submission.mutations 5000      so many, each from its own seed
"""

import collections
import copy
import json
import random
import sys
from typing import Any

import nbformat

from grader.marking.errors import Unusable
from grader.marking.release.samples import submission
from grader.marking.submission.assignment_release import load_release
from grader.marking.submission.plain_cells import read_notebook
from grader.marking.submission.rebuild import rebuild
from tests.marking.submission.damage import ASSIGNMENTS, ROOT, data

VERDICTS = ("refused", "repaired", "flagged", "as it was")
NUMBERS = [True, -1, 1e308, 10**400]
ODD: list[Any] = [None, *NUMBERS, "", "x" * 300, "`\n\ud800\0", [], {}, [[]], {"": None}, [None, 1]]
MARKS = [b"<<<<<<< HEAD\n", b"\n>>>>>>> mine\n"]
SNIPPETS = [b"", b"\0", b"\xff\xfe", b'"', b"{", b"]", b"}}", b",", b"\\u0000", b"\xc3\x28", b"1e999", *MARKS]


def real(seed: int) -> tuple[nbformat.NotebookNode, bytes]:
    """A release and an honest submission of it."""
    assignment = ASSIGNMENTS[seed % len(ASSIGNMENTS)]
    name, starter = next(iter(load_release(ROOT / "exercises" / assignment).notebooks.items()))
    solution = nbformat.read(ROOT / "solutions" / assignment / f"{name}.ipynb", 4)
    return starter, data(submission(solution, starter, seed % 3 / 2))


def mutated(honest: bytes, random: random.Random) -> bytes:
    """The submission after one to five accidents."""
    damage = random.choice([_bytes, _values, _cells])
    notebook = json.loads(honest) if damage is not _bytes else honest
    for _ in range(random.randint(1, 5)):
        notebook = damage(notebook, random)
    return notebook if isinstance(notebook, bytes) else data(notebook)


def _bytes(file: bytes, random: random.Random) -> bytes:
    start, end = sorted(random.randrange(len(file) + 1) for _ in range(2))
    end = random.choice([start, start + 1, start + 40, end])
    middle = random.choice([*SNIPPETS, file[start:end] * 2, bytes([random.randrange(256)])])
    return file[:start] + middle + file[end:] or b"{}"


def _values(notebook: Any, random: random.Random) -> Any:
    """Something in it, at any depth, is another thing, or another part of the same notebook."""
    places = [(notebook, key) for key in notebook] if isinstance(notebook, dict) else []
    for container, key in places:
        inner = container[key]
        if len(places) < 3000 and isinstance(inner, (dict, list)):
            places += [(inner, place) for place in (inner if isinstance(inner, dict) else range(len(inner)))]
    if places:
        container, key = random.choice(places)
        other, place = random.choice(places)
        container[key] = copy.deepcopy(random.choice([*ODD, other[place]]))
    return notebook


def _cells(notebook: Any, random: random.Random) -> Any:
    cells = notebook["cells"]
    if not cells:
        return notebook
    one, other = random.randrange(len(cells)), random.randrange(len(cells))
    here, there = cells[one], cells[other]
    match random.randrange(7):
        case 0:
            del cells[one]
        case 1:
            cells.insert(other, copy.deepcopy(here))
        case 2:
            cells.insert(other, cells.pop(one))
        case 3:
            here["metadata"], there["metadata"] = there["metadata"], here["metadata"]
        case 4:
            here["source"] += cells.pop(other)["source"] if one != other else "x"
        case 5:
            here.pop("id", None)
            here["metadata"] = {}
        case 6:
            random.shuffle(cells)
    return notebook


def verdict(release: nbformat.NotebookNode, file: bytes) -> str:
    """Rebuild a damaged file and assert all that must hold. Returns one of VERDICTS."""
    try:
        once = rebuild(release, read_notebook(file, "a.ipynb"))
    except Unusable as reason:
        assert 20 < len(str(reason)) < 1000
        assert str(reason).isprintable()
        return "refused"
    nbformat.validate(once.notebook)
    fixed = {cell.id: cell for cell in release.cells if "nbgrader" in cell.metadata}
    found = {cell.id: cell for cell in once.notebook.cells if "nbgrader" in cell.metadata}
    assert {id: {**cell, "source": ""} for id, cell in found.items()} == {
        id: {**cell, "source": ""} for id, cell in fixed.items()
    }
    assert all(found[id] == cell for id, cell in fixed.items() if not cell.metadata.nbgrader.solution)
    assert once.notebook.metadata == release.metadata
    assert {cell.id for cell in release.cells} <= {cell.id for cell in once.notebook.cells}
    text = nbformat.writes(once.notebook).encode()
    twice = rebuild(release, read_notebook(text, "a.ipynb"))
    assert nbformat.writes(twice.notebook).encode() == text
    assert twice.repairs == twice.flags == []
    assert all(len(sentence) < 1000 and sentence.isprintable() for sentence in once.repairs + once.flags)
    return "flagged" if once.flags else "repaired" if once.repairs else "as it was"


def main(count: int, start: int = 0) -> None:
    """Damage so many submissions and print what became of them."""
    verdicts: collections.Counter[str] = collections.Counter()
    for seed in range(start, start + count):
        release, honest = real(seed)
        try:
            verdicts[verdict(release, mutated(honest, random.Random(seed)))] += 1
        except Exception:
            print("seed", seed, file=sys.stderr)
            raise
    print(dict(verdicts))


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
