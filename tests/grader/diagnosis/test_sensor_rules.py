"""Every usual mistake with what sensors say, made by a real node, gets its own advice."""

import re

import pytest

from grader.diagnosis import find_fault
from grader.diagnosis.sensor_rules import SENSOR_RULES
from sim import run
from tests.students import sensor_mistakes as mistakes

ADVICE = {
    "ComparesAllRanges": "A list of distances can't be compared with one number: compare the smallest, `min(...)`, or a single one, such as `msg.ranges[0]`. Stars join two parts into one list: `min([*a, *b])`.",
    "AsksTheRangesForTheLeast": "The ranges are a list of numbers, and have no `min`: `min(msg.ranges)` finds the smallest, and `len(msg.ranges)` counts them.",
    "DividesInPlaceOfAComma": "`atan2` takes 2, with commas between them, but got 1.",
    "BiasOfAnotherBranch": "`bias` has no value on this path through the method: it is set only in another branch, or was set in an earlier call. Store what a later call needs in self.",
    "AddsUpVectors": "A Vector3 is not a number; it contains numbers: use the field that you need, such as `.x` or `.z`.",
    "LeastOfNothing": "min() of an empty list: no values were left. Add a default for that case: `min(values, default=math.inf)`.",
    "ReshapesByWidth": "The message has more or fewer bytes than that. In an image whose rows have padding, a row has "
    "`image.step` bytes: reshape to (image.height, image.step), and cut each row to 3 * image.width.",
    "LeastOfAnEmptyArray": "min() of an empty array: no values were left. Add an initial value for that case: `values.min(initial=np.inf)`.",
    "TakesAStampFromATime": "You can't calculate with the stamp of a message as it is: `Time.from_msg(msg.header.stamp)` converts it to a Time.",
    "LooksBackFromTimeZero": 'A bare Time() is time 0, and nothing comes before it. The current time is `self.get_clock().now()`; for "not yet" store None, and test for that first.',
    "ComparesWithTheSystemsTime": "A node's clock has ROS time, and a bare Time() system time. Name the clock type: `Time(seconds=3, clock_type=self.get_clock().clock_type)`; `Time.from_msg(stamp)` doesn't need it.",
    "DurationForAMessage": "`estimated_time_remaining` is itself a message: `.to_msg()` converts a Duration into one, as in `Duration(seconds=1.5).to_msg()`.",
    "LevelAsANumber": "The level of a DiagnosticStatus is a byte, not a number: take its constants, such as `DiagnosticStatus.OK` and `DiagnosticStatus.WARN`.",
    "TooShallow": "In an Odometry message it is two levels down: `msg.pose.pose.orientation`.",
    "ForgetsToReturn": "`self.polar` returned None, because it has no `return` with a value. End it with `return` and a value.",
    "QueueOfNumbers": "Several values were expected, but there was one float: return them together, as in `return x, y`, or as a pair, `(number, cell)`.",
    "IndexForAList": "There was one int where a list or a point was expected: check what the function called before returns.",
    "DistanceForAPoint": "There was one float where a list or a point was expected: check what the function called before returns.",
    "ColumnForRow": "Index 3 is out of range: axis 0 of the array has 2 items, counted from 0. Axis 0 is the row (y), axis 1 the column (x): `cells[row, column]`. Skip what is outside the map: `if 0 <= row < height and 0 <= column < width:`.",
    "CellNeverSeen": "The dictionary has no key (4, 34). Should it have been stored before? Otherwise test first, `if key in dictionary:`, or give a default, `dictionary.get(key, math.inf)`.",
    "BeforeTheStart": "The dictionary has no key None. Should it have been stored before? Otherwise test first, `if key in dictionary:`, or give a default, `dictionary.get(key, math.inf)`.",
    "WayTurnedInPlace": "There was None where a list or a point was expected: a function ended without `return`, or with `return values.reverse()`, which reverses the list itself and returns nothing; `values[::-1]` is a reversed copy.",
    "CostNeverNoted": "One side of the comparison is None: it was never set, or is what `dictionary.get(key)` returns for an unknown key. A second argument is the default: `dictionary.get(key, math.inf)`.",
    "DistanceForAPlace": "An index into a list is a whole number: `values.index(value)` finds the index of a value, and `math.floor(number)` rounds down to a whole number.",
    "OnTopOfThePoint": "The number after `/`, `//` or `%` on that line is 0 at that moment. Check for 0 first, with `if`, and decide what should happen then.",
    "MeanOfNothing": "The number after `/`, `//` or `%` on that line is 0 at that moment. Check for 0 first, with `if`, and decide what should happen then.",
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
