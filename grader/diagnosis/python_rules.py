"""Exceptions of Python itself and of numpy, as `rules` has those of rclpy."""

from __future__ import annotations

from grader.diagnosis.rules import Rule

PYTHON_RULES = (
    Rule(
        "ValueError", r"operands could not be broadcast together with shapes (\(.*?\)) (\(.*?\))",
        "Arrays of the shapes {0} and {1} don't fit together: for `+`, `-`, `*` and comparisons they must be "
        "equal, or one of them a single number. `.shape` says what an array has.",
    ),
    Rule(
        "ValueError", r"could not broadcast input array from shape (\(.*?\)) into shape (\(.*?\))",
        "Values of the shape {0} don't fit into a place of the shape {1}: both sides of `=` need the same.",
    ),
    Rule(
        "ValueError", r"mismatch in its core dimension .*size (\d+) is different from (\d+)",
        "In `a @ b` the number of a's columns must be that of b's rows; here they are {1} and {0}.",
    ),
    Rule(
        "ValueError", r"shapes (\(.*?\)) and (\(.*?\)) not aligned",
        "Arrays of the shapes {0} and {1} can't be multiplied: a needs as many columns as b has rows.",
    ),
    Rule(
        "IndexError", r"boolean index did not match .*axis is (\d+) but .*axis is (\d+)",
        "What chooses from an array must be as long as the array: this has {0} values, and True or False "
        "came for {1}.",
    ),
    Rule(
        "ValueError", r"truth value of an array",
        "An array is not True or False as a whole: `(...).any()` asks whether one of them is, `(...).all()` "
        "whether each is.",
    ),
    Rule(
        "IndentationError", r"expected an indented block after (.+?) on line (\d+)",
        "What belongs to the {0} on line {1} stands further right, by four spaces.",
    ),
    *(
        Rule(
            error, r"",
            "Lines of one block begin in the same column: four spaces for each step, and no tabs.",
        )
        for error in ("IndentationError", "TabError")
    ),
    Rule(
        "SyntaxError", r"expected ':'",
        "A colon is missing at the end of that line: `if`, `else`, `for`, `while`, `def` and `class` need "
        "one.",
    ),
    Rule("SyntaxError", r"'(.)' was never closed", "The `{0}` on that line has no partner that closes it."),
    Rule("SyntaxError", r"", "Python can't read that line: look at its brackets, quotes, commas and colons."),
    Rule(
        "RuntimeError", r"no running event loop",
        "A coroutine of a node is run by rclpy, and not by asyncio: what asyncio has can't be awaited there. "
        "For a pause, await a future that a timer completes, or let a timer call the next step.",
    ),
    Rule(
        "RuntimeError", r"await wasn't used with future",
        "rclpy runs this coroutine, and can't wait for a future of asyncio. Start a task of asyncio in the "
        "callback, `asyncio.create_task(...)`, and return at once.",
    ),
    Rule(
        "OverflowError", r"cannot convert float infinity to integer",
        "inf and -inf have no whole number: ask `math.isfinite(number)` first.",
    ),
    Rule(
        "ValueError", r"cannot convert float NaN to integer",
        "nan has no whole number: ask `math.isfinite(number)` first.",
    ),
)  # fmt: skip
