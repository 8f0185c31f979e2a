"""Exceptions around what sensors say and what is calculated from it, as `rules` has those around topics."""

from __future__ import annotations

from grader.diagnosis.rules import Rule

_MESSAGES = "Vector3|Quaternion|Point|Pose|Twist|Header|Imu|LaserScan|Odometry"

SENSOR_RULES = (
    Rule(
        "TypeError", r"'[<>]=?' not supported between instances of .*'array\.array'",
        "A list of distances can't be compared with one number: compare the smallest, `min(...)`, or a "
        "single one, such as `msg.ranges[0]`. Stars join two parts into one list: `min([*a, *b])`.",
    ),
    Rule(
        "AttributeError", r"'array\.array' object has no attribute '(\w+)'",
        "The ranges are a list of numbers, and have no `{0}`: `min(msg.ranges)` finds the smallest, and "
        "`len(msg.ranges)` counts them.",
    ),
    Rule(
        "TypeError", r"(\w+) expected (?:at \w+ )?(\d+) arguments?, got (\d+)",
        "`{0}` takes {1}, with commas between them, but got {2}.",
    ),
    Rule(
        "UnboundLocalError", r"local variable '(\w+)'",
        "`{0}` has no value on this path through the method: it is set only in another branch, or was set in "
        "an earlier call. Store what a later call needs in self.",
    ),
    Rule(
        "TypeError", rf"unsupported operand type\(s\) for .*'({_MESSAGES})'",
        "A {0} is not a number; it contains numbers: use the field that you need, such as `.x` or `.z`.",
    ),
    Rule(
        "ValueError", r"(min|max)\(\) .*empty",
        "{0}() of an empty list: no values were left. Add a default for that case: `{0}(values, "
        "default=math.inf)`.",
    ),
    Rule(
        "ValueError", r"zero-size array to reduction operation (min|max)imum",
        "{0}() of an empty array: no values were left. Add an initial value for that case: "
        "`values.{0}(initial=np.inf)`.",
    ),
    Rule(
        "TypeError", r"unsupported operand type\(s\) for -: '(?:Time|Duration)' and '(?:Time|Duration)'",
        "You can't calculate with the stamp of a message as it is: `Time.from_msg(msg.header.stamp)` "
        "converts it to a Time.",
    ),
    Rule(
        "ValueError", r"Subtraction leads to negative time",
        "A bare Time() is time 0, and nothing comes before it. The current time is `self.get_clock().now()`; "
        'for "not yet" store None, and test for that first.',
    ),
    Rule(
        "TypeError", r"Can't (subtract|compare) times with different clock types",
        "A node's clock has ROS time, and a bare Time() system time. Name the clock type: `Time(seconds=3, "
        "clock_type=self.get_clock().clock_type)`; `Time.from_msg(stamp)` doesn't need it.",
    ),
    Rule(
        "AssertionError", r"The 'level' field must be of type 'bytes'",
        "The level of a DiagnosticStatus is a byte, not a number: take its constants, such as "
        "`DiagnosticStatus.OK` and `DiagnosticStatus.WARN`.",
    ),
    Rule(
        "AssertionError", r"The '(\w+)' field must be a sub message of type '(Time|Duration)'",
        "`{0}` is itself a message: `.to_msg()` converts a {1} into one, as in "
        "`Duration(seconds=1.5).to_msg()`.",
    ),
    Rule(
        "AttributeError",
        r"'(?:Odometry|PoseWithCovariance)' object has no attribute '(position|orientation)'",
        "In an Odometry message it is two levels down: `msg.pose.pose.{0}`.",
    ),
    Rule(
        "TypeError", r"cannot unpack non-iterable NoneType object",
        "A function on that line returned nothing: end it with `return` and its result.",
    ),
    Rule(
        "TypeError", r"cannot unpack non-iterable (\w+) object",
        "Several values were expected, but there was one {0}: return them together, as in `return x, y`, or "
        "as a pair, `(number, cell)`.",
    ),
    Rule(
        "TypeError", r"'(int|float)' object is not (?:iterable|subscriptable)",
        "There was one {0} where a list or a point was expected: check what the function called before "
        "returns.",
    ),
    Rule(
        "IndexError", r"index (-?\d+) is out of bounds for axis (\d) with size (\d+)",
        "Index {0} is out of range: axis {1} of the array has {2} items, counted from 0. Axis 0 is the row "
        "(y), axis 1 the column (x): `cells[row, column]`. Skip what is outside the map: `if 0 <= row < "
        "height and 0 <= column < width:`.",
    ),
    Rule(
        "ValueError", r"cannot reshape array of size \d+ into shape \(\d+,\d+,3\)",
        "The message has more or fewer bytes than that. In an image whose rows have padding, a row has "
        "`image.step` bytes: reshape to (image.height, image.step), and cut each row to 3 * image.width.",
    ),
    Rule(
        "KeyError", r"^(\(.+\)|None)$",
        "The dictionary has no key {0}. Should it have been stored before? Otherwise test first, `if key in "
        "dictionary:`, or give a default, `dictionary.get(key, math.inf)`.",
    ),
    Rule(
        "TypeError", r"'NoneType' object is not (?:iterable|subscriptable)",
        "There was None where a list or a point was expected: a function ended without `return`, or with "
        "`return values.reverse()`, which reverses the list itself and returns nothing; `values[::-1]` is a "
        "reversed copy.",
    ),
    Rule(
        "TypeError", r"not supported between instances of .*'NoneType'",
        "One side of the comparison is None: it was never set, or is what `dictionary.get(key)` returns for "
        "an unknown key. A second argument is the default: `dictionary.get(key, math.inf)`.",
    ),
    Rule(
        "TypeError", r"indices must be integers",
        "An index into a list is a whole number: `values.index(value)` finds the index of a value, and "
        "`math.floor(number)` rounds down to a whole number.",
    ),
    Rule(
        "ZeroDivisionError", r"division|modulo",
        "The number after `/`, `//` or `%` on that line is 0 at that moment. Check for 0 first, with `if`, "
        "and decide what should happen then.",
    ),
)  # fmt: skip
