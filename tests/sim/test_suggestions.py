"""What differs in two texts, in one sentence."""

import pytest

from sim.suggestions import describe_text_difference

WANTED = "Hello, robot!"
CASES = {
    "Hello robot": "Compare the two texts: “,” is missing after “Hello”; “!” is missing after “robot”.",
    "hello, robot!": "Capital letters count: write “Hello, robot!”.",
    "Hello, robot!!": "Compare the two texts: remove “!” after “robot!”.",
    "Hello, Robot!": "Capital letters count: write “Hello, robot!”.",
    "Hallo, robot!": "Compare the two texts: write “e” for “a” after “H”.",
    "ello, robot!": "Compare the two texts: “H” is missing at the beginning.",
    "Good day to you": "Compare the two texts letter by letter.",
}


@pytest.mark.parametrize("found, sentence", CASES.items())
def test_the_characters_that_differ_are_named(found, sentence):
    assert describe_text_difference(found, WANTED) == sentence
