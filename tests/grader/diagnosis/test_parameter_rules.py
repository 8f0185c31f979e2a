"""Every usual mistake with parameters, made by a real node, gets its own advice."""

import re

import pytest

from grader.diagnosis import find_fault
from grader.diagnosis.parameter_rules import PARAMETER_RULES
from sim import run
from tests.students import parameter_mistakes as mistakes

ADVICE = {
    "whole_number_at_the_start": "The parameter `radius` got 1, which is of type INTEGER, but it is declared as DOUBLE: its default decides that. `1` and `1.0` have different types; use the same one in both places.",
    "DeclaresTwice": "The parameter `radius` is declared twice: call declare_parameter('radius', default) once, in __init__.",
    "DeclaresWithoutAValue": "The parameter `width` has no value: it was declared without one, and none was given at the start. Declare it with a default, declare_parameter('width', 1.0), or give the program parameters={'width': ...}.",
    "ReckonsWithoutAValue": "The parameter `width` has no value: it was declared without one, and none was given at the start. Declare it with a default, declare_parameter('width', 1.0).",
    "SetsPairs": "set_parameters() takes a list of parameters: `[Parameter('name', value=1.0)]`, with `from rclpy.parameter import Parameter`.",
    "ComputesWithTheParameter": "A parameter is not a number; it contains one: `self.get_parameter('name').value`.",
    "CallsTheCheck": "Pass a callback without parentheses: `add_on_set_parameters_callback(self.check)`.",
    "ChecksOneParameter": "The check receives a list, because several parameters may be set at once: loop with `for parameter in parameters:`, and use `parameter.value`.",
    "ReturnsNothing": "The check has to return a SetParametersResult for every value, even for a valid one: end it with `return SetParametersResult(successful=True)`.",
    "RefusesItsDefault": "The check refuses 0.1, the value that `radius` starts with: its default, or the one that the program was given. Which values does the check accept?",
    "SaysYesByPosition": "The fields of a result are set by name: SetParametersResult(successful=True), or SetParametersResult(successful=False, reason='...').",
    "launches_an_object": "Pass the class itself, without parentheses after its name: Wheel, not Wheel().",
    "launches_with_a_keyword": "A Process takes parameters as a dictionary of names and values: `Process(NodeClass, parameters={'radius': ...})`.",
    "launches_with_text": "A dictionary of names and values is needed there, not a str: write `{'name': value}`.",
    "LooksUpAWordThatIsNotThere": "The dictionary has no key 'square': is it a typo? If the key comes from outside, refuse any that isn't in the dictionary: `if value not in dictionary:`.",
    "TakesTheFutureForTheAnswer": "A future has the response only once it has arrived: `await` it first, or use `future.result().sum` in its done callback.",
}


def record(name):
    return run(getattr(mistakes, name), seconds=2, quiet=True)


@pytest.mark.parametrize("name", ADVICE)
def test_a_mistake_gets_its_advice(name):
    assert find_fault(record(name)).hint == ADVICE[name]


def test_a_node_without_a_mistake_has_no_fault():
    assert find_fault(record("Wheel")) is None


def test_no_rule_stands_there_without_a_student_who_earns_it():
    errors = [record(name).errors[0] for name in ADVICE]
    earned = [any(r.type == e.type and re.search(r.pattern, e.text) for e in errors) for r in PARAMETER_RULES]
    assert earned == [True] * len(PARAMETER_RULES)
