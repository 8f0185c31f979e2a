"""What counts as the same, and how it is written."""

import math

import pytest

from grader.responses import listed, matches, numbers_in, same, states, text_of


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


def test_numbers_are_listed_up_to_the_ninth():
    assert listed([0.0, 0.5, -1.25]) == "0, 0.5, -1.25"
    assert listed([1.0] * 9) == ", ".join("1" * 9)
    assert listed([1.0] * 11) == ", ".join("1" * 9) + ", and 2 more"
    assert listed([]) == ""


def test_series_match_as_far_as_the_shorter_one_goes():
    assert matches([2.0, 4.0], [2.0, 4.0])
    assert matches([-1.0], [-1.0, -2.0])
    assert matches([-1.0, -2.0], [-1.0])
    assert not matches([2.0, 4.0], [2.0, 4.5])
    assert matches([2.0, 4.0], [2.0, 4.5], tolerance=0.5)
    assert not matches([math.nan], [math.nan])


def test_an_empty_series_matches_nothing():
    assert not matches([], [1.0])
    assert not matches([1.0], [])


def test_a_text_states_a_number_among_few():
    assert numbers_in("from -1 to 2.5, 30 of them") == [-1.0, 2.5, 30.0]
    assert numbers_in("bias -0.031 rad/s of 50 readings") == [-0.031, 50.0]
    assert states("bias -0.031 rad/s of 50 readings", 1.0, -0.03, tolerance=0.002)
    assert not states("bias -0.031 rad/s", 0.031, tolerance=0.002)
    assert states("1 2 3 4 5", 5.0)
    assert not states("1 2 3 4 5 6", 5.0)
    assert not states("", 0.0)
