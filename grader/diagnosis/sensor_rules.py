"""Exceptions around what sensors say and what is calculated from it, as `rules` has those around topics."""

from __future__ import annotations

from grader.diagnosis.rules import Rule

_MESSAGES = "Vector3|Quaternion|Point|Pose|Twist|Header|Imu|LaserScan|Odometry"

SENSOR_RULES = (
    Rule(
        "TypeError", r"'[<>]=?' not supported between instances of .*'array\.array'",
        "Many distances can't be compared with one number: compare the least of them, `min(...)`, or a "
        "single one, such as `msg.ranges[0]`. Stars make one list of two parts: `min([*a, *b])`.",
    ),
    Rule(
        "AttributeError", r"'array\.array' object has no attribute '(\w+)'",
        "The ranges are a list of numbers, and have no `{0}`: `min(msg.ranges)` finds the least, and "
        "`len(msg.ranges)` says how many there are.",
    ),
    Rule(
        "TypeError", r"(\w+) expected (?:at \w+ )?(\d+) arguments?, got (\d+)",
        "`{0}` takes {1}, with commas between them, and got {2}.",
    ),
    Rule(
        "UnboundLocalError", r"local variable '(\w+)'",
        "`{0}` has no value on this way through the method: it is set in another branch only, or was set in "
        "an earlier call. What a later call needs is kept in self.",
    ),
    Rule(
        "TypeError", rf"unsupported operand type\(s\) for .*'({_MESSAGES})'",
        "A {0} is not a number, it has numbers in it: take the field that you need, such as `.x` or `.z`.",
    ),
    Rule(
        "ValueError", r"(min|max)\(\) .*empty",
        "{0}() of nothing: no value was left. Say what it is then: `{0}(values, default=math.inf)`.",
    ),
    Rule(
        "ValueError", r"zero-size array to reduction operation (min|max)imum",
        "{0}() of nothing: no value was left. Say what it is then: `values.{0}(initial=np.inf)`.",
    ),
    Rule(
        "TypeError", r"unsupported operand type\(s\) for -: '(?:Time|Duration)' and '(?:Time|Duration)'",
        "You can't calculate with the stamp of a message as it is: `Time.from_msg(msg.header.stamp)` makes a "
        "time of it.",
    ),
    Rule(
        "ValueError", r"Subtraction leads to negative time",
        "A bare Time() is time 0, and there is nothing before it. The time now is `self.get_clock().now()`; "
        'for "not yet" keep None, and ask for that first.',
    ),
    Rule(
        "TypeError", r"Can't (subtract|compare) times with different clock types",
        "A node's clock has ROS's time, and a bare Time() the system's. Name the clock: "
        "`Time(seconds=3, clock_type=self.get_clock().clock_type)`; `Time.from_msg(stamp)` needs nothing.",
    ),
    Rule(
        "AssertionError", r"The '(\w+)' field must be a sub message of type '(Time|Duration)'",
        "`{0}` is a message, too: `.to_msg()` makes one of a {1}, as in `Duration(seconds=1.5).to_msg()`.",
    ),
    Rule(
        "AttributeError",
        r"'(?:Odometry|PoseWithCovariance)' object has no attribute '(position|orientation)'",
        "In an Odometry it lies two steps deep: `msg.pose.pose.{0}`.",
    ),
    Rule(
        "TypeError", r"cannot unpack non-iterable NoneType object",
        "A function on that line gave nothing back: end it with `return` and what it has found.",
    ),
    Rule(
        "TypeError", r"cannot unpack non-iterable (\w+) object",
        "Several values were wanted, and one {0} came: give them together, as in `return x, y`, or as the "
        "pair `(number, cell)`.",
    ),
    Rule(
        "TypeError", r"'(int|float)' object is not (?:iterable|subscriptable)",
        "One {0} came where a list or a point was wanted: look at what the function before gives back.",
    ),
    Rule(
        "IndexError", r"index (-?\d+) is out of bounds for axis (\d) with size (\d+)",
        "Number {0} is too large: axis {1} of the array has {2} items, and counting begins at 0. Axis 0 is "
        "the row (y), axis 1 the column (x): `cells[row, column]`. What is outside of the map is left out: "
        "`if 0 <= row < height and 0 <= column < width:`.",
    ),
    Rule(
        "KeyError", r"^(\(.+\)|None)$",
        "The dictionary knows no {0}. Should it have been noted before? Otherwise ask first, "
        "`if key in dictionary:`, or say what counts in its place, `dictionary.get(key, math.inf)`.",
    ),
    Rule(
        "TypeError", r"'NoneType' object is not (?:iterable|subscriptable)",
        "None came where a list or a point was wanted: a function ended without `return`, or with "
        "`return values.reverse()`, which turns the list itself and gives nothing back; `values[::-1]` does.",
    ),
    Rule(
        "TypeError", r"not supported between instances of .*'NoneType'",
        "One side of the comparison is None: it was never set, or is what `dictionary.get(key)` says of an "
        "unknown key. A second argument says what counts then: `dictionary.get(key, math.inf)`.",
    ),
    Rule(
        "TypeError", r"indices must be integers",
        "A place in a list is a whole number: `values.index(value)` finds the place of a value, and "
        "`math.floor(number)` makes a number whole.",
    ),
    Rule(
        "ZeroDivisionError", r"division|modulo",
        "The number after `/`, `//` or `%` in that line is 0 at that moment. Ask first, with `if`, whether "
        "it is 0, and say what counts then.",
    ),
)  # fmt: skip
