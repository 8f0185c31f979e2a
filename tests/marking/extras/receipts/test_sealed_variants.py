"""A receipt seals the numbers of a student's variants with the seeds."""

import nbformat

from grader.marking.extras.receipts.issue import sealed
from grader.marking.extras.receipts.receipt import MarkReceipt, seal_of
from grader.marking.judge.personal_release import drawn_numbers, tag
from grader.seeds import revealed_seeds, secret_of_student
from tests.marking.assignment import release

KEY = "d1ce"
RECEIPT = MarkReceipt("ann", "Ann", "02_two", 23.0, 23.0, "me", "2026-01-01", (), {}, {})


def test_variants_are_sealed_with_the_seeds_and_revealed_with_them(tmp_path):
    notebook = nbformat.read(release(tmp_path / "02_two") / "two.ipynb", 4)
    without = sealed(RECEIPT, KEY, [notebook], reveal=True)
    assert without.seeds.keys() == {"greeting", "temperature"}
    tag(notebook, "02_two")
    made = sealed(RECEIPT, KEY, [notebook], reveal=True)
    numbers = drawn_numbers([notebook], secret_of_student(KEY, "ann"))
    assert made.seeds == {**without.seeds, **{f"variant of {name}": [each] for name, each in numbers.items()}}
    assert made.seal == seal_of(made.nonce, made.seeds) != without.seal
    again = secret_of_student(revealed_seeds(made.seeds), "ann")
    assert drawn_numbers([notebook], again) == numbers
    hidden = sealed(RECEIPT, KEY, [notebook], reveal=False)
    assert (hidden.seal, hidden.seeds) == (made.seal, {})
