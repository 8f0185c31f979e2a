"""Tests of the programs that a student's test of depots is tried on."""

import random

import pytest
from rclpy.node import Node

from grader.exercises import systems
from grader.exercises.systems.race_test.depots import NAMES, RACY_ONES, RIGHT_ONES, candidates, source_of
from grader.exercises.systems.race_test.racy_depots import ANSWERS, NEGATIVE, RACY
from grader.exercises.systems.race_test.right_depots import RIGHT
from sim import run
from tests.exercises.systems.race_test.students import Users, asserts_at_each_pause, pauses, problems

DESIGNS = RIGHT | RACY


def program(design):
    names = {"__name__": "program", "started": lambda: None}
    exec(source_of(DESIGNS[design], random.Random(design)), names)
    return names["main"]


def at_pauses(design, order=0):
    recording = run(program(design), Users, seconds=2.5, order=order, quiet=True)
    assert len(pauses(recording)) > 8
    return [text for part in pauses(recording) for text in problems(part)]


@pytest.mark.parametrize("design", DESIGNS)
def test_every_design_keeps_the_contract_in_the_usual_order(design):
    assert at_pauses(design) == []


@pytest.mark.parametrize("design", RIGHT)
def test_a_right_design_keeps_it_in_other_orders(design):
    assert [at_pauses(design, order) for order in (3, 14)] == [[], []]


def test_a_seed_draws_designs_and_each_line_of_the_contract_is_needed_twice():
    for seed in range(20):
        found = candidates(seed)
        assert [each.number for each in found] == list(range(1, RIGHT_ONES + RACY_ONES + 1))
        assert sum(each.right for each in found) == RIGHT_ONES
        assert all((each.design in RIGHT) == each.right for each in found)
        assert {*NEGATIVE, *ANSWERS} <= {each.design for each in found}
    assert {each.design for seed in range(20) for each in candidates(seed)} == {*DESIGNS} - {"no lock"}
    assert candidates(1) == candidates(1)
    assert candidates(1) != candidates(2)


def test_drawn_names_differ_and_are_none_of_a_nodes():
    drawn = [name for key, names in NAMES.items() if key != "Depot" for name in names]
    assert len(drawn) == len({*drawn})
    assert [name for name in drawn if hasattr(Node, name)] == []


def test_a_test_that_takes_too_long_is_not_tried_on_the_other_programs(monkeypatch):
    monkeypatch.setattr("grader.companions.race_test_runner.MOST_SECONDS", 0.0)
    missed = systems.race_test.grade(asserts_at_each_pause).verdicts[0]
    assert missed.expected == "the outcome of the test on program Depot"
    assert missed.saw == "none: the test took more than 60 s of computing on those before"
