import math

import pytest

from grader import Missed, check
from grader.checks import Check
from sim import Recording


def test_the_docstrings_first_paragraph_is_the_sentence():
    @check(points=2)
    def drives(recording):
        """The node sends
        velocity commands.

        A remark for whoever reads the code.
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
        check(points=points)


def test_after_is_one_check_or_several():
    first, second = sentence("first"), sentence("second")
    assert check(points=1, after=first)(documented).after == (first,)
    assert check(points=1, after=(first, second))(documented).after == (first, second)


@pytest.mark.parametrize("returned, credit", [(None, 1.0), (1, 1.0), (0.25, 0.25), (0, 0.0)])
def test_what_is_returned_is_the_credit(returned, credit):
    assert returning(returned)(Recording()) == credit


@pytest.mark.parametrize("returned", [True, False, 1.5, -0.1, math.nan])
def test_anything_else_returned_is_refused(returned):
    with pytest.raises(ValueError) as caught:
        returning(returned)(Recording())
    assert str(caught.value) == (
        f"a check returns nothing, or the earned fraction from 0 to 1; this one returned {returned!r}"
    )


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


def documented(recording):
    """A sentence."""


def sentence(name):
    return Check(name, name, 1.0, (), documented)


def returning(value):
    return Check("returning", "A sentence.", 1.0, (), lambda recording: value)
