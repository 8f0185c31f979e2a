"""What counts as the same, how it is written, and which wrong formula explains it."""

import math

import pytest

from grader.responses import first_matching, same, text_of


@pytest.mark.parametrize(
    ("value", "wanted", "equal"),
    [
        (1.0, 1.05, True),
        (1.0, 1.2, False),
        (math.nan, math.nan, False),
        ((1.0, 2.0), (1.0, 2.05), True),
        ((1.0, 2.0), (1.0, 2.2), False),
        ((1.0,), (1.0, 2.0), False),
        ("go", "go", True),
        ("go", "Go", False),
        (True, True, True),
        (1, True, True),
    ],
)
def test_numbers_are_the_same_within_a_tolerance(value, wanted, equal):
    assert same(value, wanted, 0.1) is equal


@pytest.mark.parametrize(
    ("value", "text"), [(1.23456, "1.23"), (math.nan, "NaN"), ("x" * 70, f"“{'x' * 60}”"), (3, "3")]
)
def test_a_value_is_written_as_a_score_page_shows_it(value, text):
    assert text_of(value) == text


def test_the_first_wrong_formula_that_gives_all_values_is_the_hint():
    mistakes = {"The sign.": [-1.0, -2.0], "Twice.": [2.0, 4.0]}
    assert first_matching(mistakes, [2.0, 4.0]) == "Twice."
    assert first_matching(mistakes, [-1.0]) == "The sign."
    assert first_matching(mistakes, [3.0]) == ""
    assert first_matching(mistakes, []) == ""
