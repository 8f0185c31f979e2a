"""What must be taught: each row's cells and checks are there, and the page is what the rows give."""

import pytest

from tests.rules.taught import PAGE, Row, problems, render, rows


@pytest.mark.parametrize("row", rows(), ids=lambda row: row.subject)
def test_what_must_be_taught_has_a_cell_and_a_check_or_a_reason(row):
    assert list(problems(row)) == []


def test_the_page_is_what_the_rows_give():
    assert PAGE.read_text(encoding="utf-8") == render(), "run python -m tests.rules.taught"


def test_a_row_that_does_not_hold_is_named():
    row = Row(
        "Flying", ("01_nodes/lesson: wings", "99_none/lesson: title"), ("nodes/hello: flies", "nodes/none: x")
    )
    assert list(problems(row)) == [
        "Flying: there is no cell 01_nodes/lesson: wings",
        "Flying: there is no cell 99_none/lesson: title",
        "Flying: there is no check nodes/hello: flies",
        "Flying: there is no check nodes/none: x",
    ]
    assert list(problems(Row("Diving", ()))) == [
        "Diving: no cell teaches it",
        "Diving: it has no check, and no reason",
    ]
