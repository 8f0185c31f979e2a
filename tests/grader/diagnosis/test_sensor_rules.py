"""Every usual mistake with what sensors say, made by a real node, gets its own advice."""

import re

import pytest

from grader.diagnosis import find_fault
from grader.diagnosis.sensor_rules import SENSOR_RULES
from sim import run
from tests.students import sensor_mistakes as mistakes

ADVICE = {
    "ComparesAllRanges": "Many distances can't be compared with one number: compare the least of them, `min(...)`, or a single one, such as `msg.ranges[0]`. Stars make one list of two parts: `min([*a, *b])`.",
    "AsksTheRangesForTheLeast": "The ranges are a list of numbers, and have no `min`: `min(msg.ranges)` finds the least, and `len(msg.ranges)` says how many there are.",
    "DividesInPlaceOfAComma": "`atan2` takes 2, with commas between them, and got 1.",
    "BiasOfAnotherBranch": "`bias` has no value on this way through the method: it is set in another branch only, or was set in an earlier call. What a later call needs is kept in self.",
    "AddsUpVectors": "A Vector3 is not a number, it has numbers in it: take the field that you need, such as `.x` or `.z`.",
    "LeastOfNothing": "min() of nothing: no value was left. Say what it is then: `min(values, default=math.inf)`.",
    "LeastOfAnEmptyArray": "min() of nothing: no value was left. Say what it is then: `values.min(initial=np.inf)`.",
    "TakesAStampFromATime": "You can't calculate with the stamp of a message as it is: `Time.from_msg(msg.header.stamp)` makes a time of it.",
    "LooksBackFromTimeZero": 'A bare Time() is time 0, and there is nothing before it. The time now is `self.get_clock().now()`; for "not yet" keep None, and ask for that first.',
    "ComparesWithTheSystemsTime": "A node's clock has ROS's time, and a bare Time() the system's. Name the clock: `Time(seconds=3, clock_type=self.get_clock().clock_type)`; `Time.from_msg(stamp)` needs nothing.",
    "DurationForAMessage": "`estimated_time_remaining` is a message, too: `.to_msg()` makes one of a Duration, as in `Duration(seconds=1.5).to_msg()`.",
    "TooShallow": "In an Odometry it lies two steps deep: `msg.pose.pose.orientation`.",
    "ForgetsToReturn": "A function on that line gave nothing back: end it with `return` and what it has found.",
    "QueueOfNumbers": "Several values were wanted, and one float came: give them together, as in `return x, y`, or as the pair `(number, cell)`.",
    "IndexForAList": "One int came where a list or a point was wanted: look at what the function before gives back.",
    "DistanceForAPoint": "One float came where a list or a point was wanted: look at what the function before gives back.",
    "ColumnForRow": "Number 3 is too large: axis 0 of the array has 2 items, and counting begins at 0. Axis 0 is the row (y), axis 1 the column (x): `cells[row, column]`. What is outside of the map is left out: `if 0 <= row < height and 0 <= column < width:`.",
    "CellNeverSeen": "The dictionary knows no (4, 34). Should it have been noted before? Otherwise ask first, `if key in dictionary:`, or say what counts in its place, `dictionary.get(key, math.inf)`.",
    "BeforeTheStart": "The dictionary knows no None. Should it have been noted before? Otherwise ask first, `if key in dictionary:`, or say what counts in its place, `dictionary.get(key, math.inf)`.",
    "WayTurnedInPlace": "None came where a list or a point was wanted: a function ended without `return`, or with `return values.reverse()`, which turns the list itself and gives nothing back; `values[::-1]` does.",
    "CostNeverNoted": "One side of the comparison is None: it was never set, or is what `dictionary.get(key)` says of an unknown key. A second argument says what counts then: `dictionary.get(key, math.inf)`.",
    "DistanceForAPlace": "A place in a list is a whole number: `values.index(value)` finds the place of a value, and `math.floor(number)` makes a number whole.",
    "OnTopOfThePoint": "The number after `/`, `//` or `%` in that line is 0 at that moment. Ask first, with `if`, whether it is 0, and say what counts then.",
    "MeanOfNothing": "The number after `/`, `//` or `%` in that line is 0 at that moment. Ask first, with `if`, whether it is 0, and say what counts then.",
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
