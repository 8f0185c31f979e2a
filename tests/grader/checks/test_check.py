import math

import pytest

from grader import Missed, check
from grader.checks import Check, hinting, otherwise
from grader.checks.check import new_check, tenths
from sim.evidence import Ended, Recording


def test_the_docstrings_first_paragraph_is_the_sentence():
    @check(points=2)
    def drives(recording):
        """The node sends
        velocity commands.

        A remark for readers of the code.
        """

    assert isinstance(drives, Check)
    assert (drives.name, drives.sentence, drives.points) == (
        "drives",
        "The node sends velocity commands.",
        2.0,
    )


def test_a_check_needs_a_docstring():
    with pytest.raises(
        ValueError, match=r"^drives needs a docstring: it is the sentence that the student reads$"
    ):

        @check(points=1)
        def drives(recording):
            pass


@pytest.mark.parametrize("points", [-1, math.nan, math.inf])
def test_points_are_a_finite_number_from_0_up(points):
    with pytest.raises(ValueError, match=rf"^points must be a finite number from 0 up, not {points}$"):
        check(points=points)(documented)


@pytest.mark.parametrize("points", [0, 0.5])
def test_a_check_may_give_no_points_or_less_than_one(points):
    assert check(points=points)(documented).points == points


def test_a_check_holds_in_all_scenarios_or_in_those_it_names():
    everywhere, one = new_check(documented, 1), new_check(documented, 1, only="windy")
    two = new_check(documented, 1, only=("windy", "calm"))
    scenarios = ("", "windy", "calm")
    assert [everywhere.holds_in(name) for name in scenarios] == [True, True, True]
    assert [one.holds_in(name) for name in scenarios] == [False, True, False]
    assert [two.holds_in(name) for name in scenarios] == [False, True, True]


def test_a_check_lasts_to_the_end_of_the_run_where_it_says_so_or_builds_on_others():
    assert not new_check(documented, 1).lasts
    assert not sentence("made by hand").lasts
    assert new_check(documented, 1, lasts=True).lasts
    assert new_check(documented, 1, after=sentence("first")).lasts


def test_after_is_one_check_or_several():
    first, second = sentence("first"), sentence("second")
    assert check(points=1, after=first)(documented).after == (first,)
    assert check(points=1, after=(first, second))(documented).after == (first, second)


@pytest.mark.parametrize("credit", [True, False, 1.1, 1.5, -0.1, math.nan])
def test_a_credit_is_a_fraction(credit):
    with pytest.raises(ValueError) as caught:
        Missed("1 Hz", "2 Hz", credit=credit)
    assert str(caught.value) == f"a credit is the earned fraction, from 0 to 1; this one is {credit!r}"


@pytest.mark.parametrize("credit", [0, 0.9, 1])
def test_a_credit_may_be_nothing_and_all(credit):
    assert Missed("1 Hz", "2 Hz", credit=credit).credit == credit


def test_a_check_takes_a_recording_and_all_results_or_none():
    first, second = sentence("first"), sentence("second")

    def takes_one(recording, measured):
        """A sentence."""

    with pytest.raises(ValueError) as caught:
        check(points=1, after=(first, second))(takes_one)
    assert str(caught.value) == (
        "takes_one takes a recording and nothing else, or also what each of its 2 checks in `after` has "
        "measured; it takes 1 more"
    )


def test_hinting_gives_a_miss_what_it_lacks():
    with pytest.raises(Missed) as caught, hinting("Look.", guess="Perhaps so."):
        raise Missed("1 Hz", "2 Hz", credit=0.5)
    assert (caught.value.hint, caught.value.guess, caught.value.credit) == ("Look.", "Perhaps so.", 0.5)
    with pytest.raises(Missed) as caught, hinting("Look.", guess="Perhaps so."):
        raise Missed("1 Hz", "2 Hz", "Halve it.", guess="Its own.")
    assert (caught.value.hint, caught.value.guess) == ("Halve it.", "Its own.")


def test_a_miss_is_data():
    miss = Missed("1 Hz", "2 Hz", "Halve it.", credit=0.5, picture="topics")
    assert (miss.expected, miss.saw, miss.hint, miss.credit, miss.picture) == (
        "1 Hz",
        "2 Hz",
        "Halve it.",
        0.5,
        "topics",
    )
    assert str(miss) == "expected 1 Hz; saw 2 Hz"
    plain = Missed("1 Hz", "2 Hz")
    assert (plain.hint, plain.guess, plain.credit, plain.picture) == ("", "", 0.0, "")
    assert (plain.measured, plain.typo, plain.unsafe, plain.about, plain.because) == (None, None, False, (), ())


def documented(recording):
    """A sentence."""


def sentence(name):
    return Check(name, name, 1.0, (), documented)


HINTS = {
    "Nothing came.": lambda run: run.ended.reason == "error",
    "It is {count} too many.": lambda run, count: count > 1 and {"count": count - 1},
    "Count again.": otherwise,
}


@pytest.mark.parametrize(
    ("reason", "about", "hint"),
    [
        ("time", (3,), "It is 2 too many."),
        ("time", (1,), "Count again."),
        ("time", (), ""),
        ("error", (), "Nothing came."),
        ("error", (3,), "It is 2 too many."),
        ("time", (3, 4), "Count again."),
    ],
)
def test_the_hint_is_the_first_row_whose_cause_takes_what_the_miss_is_about_and_explains_it(
    reason, about, hint
):
    def counts(recording):
        """A sentence."""
        raise Missed("1", "3", about=about)

    with pytest.raises(Missed) as caught:
        new_check(counts, 1, hints=HINTS)(Recording(ended=Ended(reason, "", 1.0)))
    assert caught.value.hint == hint


def test_a_miss_with_a_hint_of_its_own_keeps_it():
    def counts(recording):
        """A sentence."""
        raise Missed("1", "3", "Its own.", about=(3,))

    with pytest.raises(Missed) as caught:
        new_check(counts, 1, hints=HINTS)(Recording())
    assert caught.value.hint == "Its own."


@pytest.mark.parametrize(
    ("own", "guess", "expected"),
    [("", "Perhaps so.", "Perhaps so."), ("", HINTS, "It is 2 too many."), ("Its own.", HINTS, "Its own.")],
)
def test_a_miss_without_a_guess_has_that_of_the_check_which_may_be_a_table(own, guess, expected):
    def counts(recording):
        """A sentence."""
        raise Missed("1", "3", guess=own, about=(3,))

    with pytest.raises(Missed) as caught:
        new_check(counts, 1, guess=guess)(Recording(ended=Ended("time", 1.0, "")))
    assert (caught.value.hint, caught.value.guess) == ("", expected)


def test_two_checks_are_the_same_whatever_their_hints_and_guesses():
    assert new_check(documented, 1, hints=HINTS, guess="Perhaps so.") == new_check(documented, 1)


def test_a_miss_without_a_table_of_hints_has_none():
    def counts(recording):
        """A sentence."""
        raise Missed("1", "3")

    with pytest.raises(Missed) as caught:
        new_check(counts, 1)(Recording())
    assert caught.value.hint == ""


@pytest.mark.parametrize(
    ("credit", "earned"),
    [(0.0, 0.0), (0.34, 0.3), (0.7 - 0.4, 0.3), (0.29999, 0.2), (0.99, 0.9), (1.0, 1.0), (1.7, 1.0), (-0.3, 0.0)],
)
def test_a_part_of_the_points_is_rounded_down_to_tenths(credit, earned):
    assert tenths(credit) == earned
