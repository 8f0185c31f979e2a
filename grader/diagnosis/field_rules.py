"""What a message says of a value that one of its fields does not take, as `rules` has rclpy's exceptions."""

from __future__ import annotations

from grader.diagnosis.rules import Rule

FIELD_RULES = (
    Rule(
        "AssertionError", r"The '(\w+)' field must be of type 'float'",
        "`{0}` takes a number with a decimal point: set `msg.{0} = 1.0`, not `1`; `float(value)` converts.",
    ),
    Rule(
        "AssertionError", r"The '(\w+)' field must be of type 'int'",
        "`{0}` takes a whole number: set `msg.{0} = 1`, not `1.0`; `int(value)` converts.",
    ),
    Rule(
        "AssertionError", r"The '(\w+)' field must be of type 'str'",
        "`{0}` takes text: set `msg.{0} = 'text'`; `str(value)` converts.",
    ),
    Rule(
        "AssertionError", r"The '(\w+)' field must be of type 'bool'",
        "`{0}` takes True or False, not 1 or 0; `bool(value)` converts.",
    ),
    Rule(
        "AssertionError", r"The '(\w+)' field must be of type 'bytes'",
        "`{0}` takes one byte, such as `b'\\x01'`, and not 1.",
    ),
    Rule(
        "AssertionError", r"The '(\w+)' field must be a sub message of type '(\w+)'",
        "`{0}` is a message of its own, a {1}: set the fields inside it (`msg.{0}.x = 1.0`), or assign a "
        "whole {1}().",
    ),
    Rule(
        "AssertionError", r"The '(\w+)' field must be a set or sequence with length (\d+)",
        "`{0}` takes a list of exactly {1} values.",
    ),
    *(
        Rule(
            "AssertionError", rf"The '(\w+)' field must be a set or sequence .*each value of type '{kind}'",
            f"`{{0}}` takes {example}.",
        )
        for kind, example in (
            ("float", "a list of floats: [0.0, 0.0]"),
            ("int", "a list of whole numbers: [0, 0]"),
            ("str", "a list of strings: ['a', 'b']"),
            ("bool", "a list of True and False: [True, False]"),
        )
    ),
    Rule(
        "AssertionError", r"The '(\w+)' field must be a set or sequence .*each value of type '(\w+)'",
        "`{0}` takes a list of {1} messages: [{1}(), {1}()].",
    ),
    Rule(
        "AssertionError", r"The '(\w+)' field must be (an? .+)",
        "`{0}` must be {1}: give it a value of that kind.",
    ),
    Rule(
        "AssertionError", r"Invalid arguments passed to constructor: (.+)",
        "This message has no field `{0}`. `get_fields_and_field_types()` of its class lists the fields.",
    ),
)  # fmt: skip
