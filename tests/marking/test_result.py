import json
from dataclasses import replace

import pytest

from grader.marking import result as results
from grader.marking.errors import ResultError
from grader.marking.result import CellResult, NotebookResult, Result
from tests.marking.classroom import verdict

CELLS = [
    CellResult("test_a", "a", 1.5, 4.0, [verdict("a", 4, 0.375)], ["d1ce"]),
    CellResult("test_b", "b", 2.0, 2, needs_look=True),
]
NOTEBOOK = {"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": [{"source": "é"}]}
WHOLE = Result(
    "anna", "01_nodes", "00ff", "repaired", "", ["One."], ["Two."],
    [NotebookResult("nodes", NOTEBOOK, CELLS)], {"total": 0.5},
)


def test_a_result_crosses_as_text():
    assert Result.from_json(WHOLE.to_json()) == WHOLE
    assert Result.from_json(WHOLE.to_json().encode()) == WHOLE
    assert WHOLE.points == 3.5


def test_the_timings_are_no_part_of_the_grade():
    other = replace(WHOLE, timings={"total": 9.0})
    assert other.to_json() != WHOLE.to_json()
    assert other.grade_json() == WHOLE.grade_json()


def message(text):
    with pytest.raises(ResultError) as refused:
        Result.from_json(text)
    return str(refused.value)


NONSENSE = ["", "[]", "3", "null", "{}", '{"notebooks": 3}', "[" * 100_000, b"\xff\xfe"]


@pytest.mark.parametrize("text", NONSENSE)
def test_what_is_no_result_is_refused(text):
    assert message(text).startswith("this is not a result of marking: ")


def changed(*path_and_value):
    """The text of a result with one value changed."""
    *path, last, value = path_and_value
    data = json.loads(WHOLE.to_json())
    place = data
    for key in path:
        place = place[key]
    place[last] = value
    return json.dumps(data)


CELL = ("notebooks", 0, "cells", 0)
WRONG = [
    (("student", "../eve"), "'../eve' can't be the name of a folder or file"),
    (("assignment", ""), "'' can't be the name of a folder or file"),
    (("notebooks", 0, "name", ".."), "'..' can't be the name of a folder or file"),
    (("student", 3), "3 can't be the name of a folder or file"),
    (
        ("verdict", "perfect"),
        "the verdict is one of marked, repaired, stopped, refused, broken, not 'perfect'",
    ),
    (("key", None), "key, reason, repairs and flags are text"),
    (("repairs", "many"), "repairs and flags are lists"),
    (("flags", [3]), "key, reason, repairs and flags are text"),
    (("timings", {"total": "long"}), "the timings are finite numbers"),
    (("timings", {"total": True}), "the timings are finite numbers"),
    (("notebooks", 0, "notebook", {"cells": 3}), "nodes holds no cells"),
    (("notebooks", 0, "notebook", {"cells": [3]}), "nodes holds no cells"),
    ((*CELL, "cell", "test_b"), "a test cell of nodes has two results"),
    ((*CELL, "digests", [3]), "a cell's name, its exercise and the digests are text"),
    ((*CELL, "points", "4"), "the points of test_a are finite numbers"),
    ((*CELL, "max", False), "the points of test_a are finite numbers"),
    ((*CELL, "points", 5), "test_a has 5 points of 4"),
    ((*CELL, "points", -1), "test_a has -1 points of 4"),
    ((*CELL, "needs_look", "no"), "test_a needs a look or doesn't"),
    ((*CELL, "verdicts", 0, "saw", 3), "the verdicts of test_a are text"),
]


@pytest.mark.parametrize(("change", "words"), WRONG)
def test_a_wrong_value_is_named(change, words):
    assert message(changed(*change)) == f"this is not a result of marking: {words}"


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity"])
def test_what_is_no_number_is_refused(number):
    text = WHOLE.to_json().replace('"points": 1.5', f'"points": {number}')
    assert message(text) == f"this is not a result of marking: {number} is not a number"


def test_a_number_beyond_all_is_refused():
    text = WHOLE.to_json().replace('"max": 4.0', '"max": 1e999')
    assert message(text) == "this is not a result of marking: the points of test_a are finite numbers"


def test_too_much_is_refused_before_it_is_read(monkeypatch):
    monkeypatch.setattr(results, "MAX_BYTES", 2_000_000)
    assert message(" " * 3_000_000) == "a result has at most 2 MB, this one has 3 MB"
