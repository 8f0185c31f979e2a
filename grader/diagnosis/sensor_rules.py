"""Exceptions around what sensors say, as `rules` has those around topics."""

from __future__ import annotations

from grader.diagnosis.rules import Rule

_MESSAGES = "Vector3|Quaternion|Point|Pose|Twist|Header|Imu|LaserScan|Odometry"

SENSOR_RULES = (
    Rule(
        "TypeError", r"'[<>]=?' not supported between instances of .*'array\.array'",
        "Many distances can't be compared with one number: compare the least of them, `min(...)`, or a "
        "single one, such as `msg.ranges[0]`.",
    ),
    Rule(
        "TypeError", rf"unsupported operand type\(s\) for .*'({_MESSAGES})'",
        "A {0} is no number, it holds numbers: take the field that you need, such as `.x` or `.z`.",
    ),
    Rule(
        "ValueError", r"(min|max)\(\) .*empty",
        "{0}() of nothing: no value was left. Say what it is then: `{0}(values, default=math.inf)`.",
    ),
    Rule(
        "ValueError", r"zero-size array to reduction operation (min|max)imum",
        "{0}() of nothing: no value was left. Say what it is then: `values.{0}(initial=np.inf)`.",
    ),
)  # fmt: skip
