"""Every usual mistake with what sensors say, made by a real node, gets its own advice."""

import re

import pytest

from grader.diagnosis import find_fault
from grader.diagnosis.sensor_rules import SENSOR_RULES
from sim import run
from tests.students import sensor_mistakes as mistakes

ADVICE = {
    "ComparesAllRanges": "Many distances can't be compared with one number: compare the least of them, `min(...)`, or a single one, such as `msg.ranges[0]`.",
    "AddsUpVectors": "A Vector3 is no number, it holds numbers: take the field that you need, such as `.x` or `.z`.",
    "LeastOfNothing": "min() of nothing: no value was left. Say what it is then: `min(values, default=math.inf)`.",
    "LeastOfAnEmptyArray": "min() of nothing: no value was left. Say what it is then: `values.min(initial=np.inf)`.",
}


def record(name):
    return run(getattr(mistakes, name), seconds=2, quiet=True)


@pytest.mark.parametrize("name", ADVICE)
def test_a_mistake_gets_its_advice(name):
    assert find_fault(record(name)).hint == ADVICE[name]


def test_a_node_without_a_mistake_has_no_fault():
    assert find_fault(record("Looker")) is None


def test_no_rule_stands_there_without_a_student_who_earns_it():
    errors = [record(name).errors[0] for name in ADVICE]
    earned = [any(r.type == e.type and re.search(r.pattern, e.text) for e in errors) for r in SENSOR_RULES]
    assert earned == [True] * len(SENSOR_RULES)
