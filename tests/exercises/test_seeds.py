"""Private seeds with which a right node once fell short: what a check asked for was not certain there."""

import pytest

from grader.programs import LocalPrograms
from tests.exercises.reference import solution
from tests.exercises.seeds import SOLUTION, exercise_of, programs_named

FELL_SHORT = [
    ("safety", "latch", "Stop", "secret 0"),  # the button's message overtakes a command
    ("delivery", "decide", "OneClassForEachState", "secret 74"),  # it decides between two orders' arrivals
    ("navigating", "navigate", SOLUTION, "secret 112"),  # its path is 35 % longer in another order
]


@pytest.mark.parametrize(("topic", "name", "node", "secret"), FELL_SHORT)
def test_a_right_node_earns_everything_with_a_seed_that_was_unkind(topic, name, node, secret):
    exercise = exercise_of(topic, name)
    programs = programs_named(topic, name, node)
    assert exercise.judge(LocalPrograms(programs), secret) == exercise.points


def test_a_solution_may_be_a_function_that_runs_programs():
    (answer,) = solution("systems", "race_test")
    assert answer.__name__ == "test_depot"
