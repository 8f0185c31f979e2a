"""The likely wrong formula is the first of a table that explains what was seen."""

from grader.checks.mistakes import usual_mistake

MISTAKES = {"Twice.": 2, "Squared.": 4, "Four times.": 4}


def test_the_first_formula_that_explains_it_gives_the_hint():
    assert usual_mistake(MISTAKES, lambda formula: formula == 4) == "Squared."


def test_where_no_formula_explains_it_there_is_no_hint():
    assert usual_mistake(MISTAKES, lambda formula: formula == 5) == ""
