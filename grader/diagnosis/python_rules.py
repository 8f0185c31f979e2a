"""Exceptions of Python itself and of numpy, as `rules` has those of rclpy."""

from __future__ import annotations

from grader.diagnosis.rules import Rule

PYTHON_RULES = (
    Rule(
        "ValueError", r"operands could not be broadcast together with shapes (\(.*?\)) (\(.*?\))",
        "Arrays with the shapes {0} and {1} don't fit together: for `+`, `-`, `*` and comparisons the shapes "
        "must be equal, or one of the two must be a single number. `.shape` gives the shape of an array.",
    ),
    Rule(
        "ValueError", r"could not broadcast input array from shape (\(.*?\)) into shape (\(.*?\))",
        "Values with the shape {0} don't fit where the shape {1} is needed: both sides of `=` need the same "
        "shape.",
    ),
    Rule(
        "ValueError", r"mismatch in its core dimension .*size (\d+) is different from (\d+)",
        "In `a @ b` the number of a's columns must equal the number of b's rows; here they are {1} and {0}.",
    ),
    Rule(
        "ValueError", r"shapes (\(.*?\)) and (\(.*?\)) not aligned",
        "Arrays with the shapes {0} and {1} can't be multiplied: a needs as many columns as b has rows.",
    ),
    Rule(
        "IndexError", r"boolean index did not match .*axis is (\d+) but .*axis is (\d+)",
        "A mask must be as long as the array that it selects from: the array has {0} values, the mask {1}.",
    ),
    Rule(
        "ValueError", r"truth value of an array",
        "An array is not True or False as a whole: `(...).any()` tests whether at least one value is, "
        "`(...).all()` whether all of them are.",
    ),
    Rule(
        "IndentationError", r"expected an indented block after (.+?) on line (\d+)",
        "Indent what belongs to the {0} on line {1} by four more spaces.",
    ),
    *(
        Rule(
            error, r"",
            "Lines of one block begin in the same column: indent by four spaces for each level, never with "
            "tabs.",
        )
        for error in ("IndentationError", "TabError")
    ),
    Rule(
        "SyntaxError", r"expected ':'",
        "A colon is missing at the end of that line: `if`, `else`, `for`, `while`, `def` and `class` need "
        "one.",
    ),
    Rule("SyntaxError", r"'(.)' was never closed", "The `{0}` on that line is never closed."),
    Rule("SyntaxError", r"", "Python can't read that line: check its brackets, quotes, commas and colons."),
    Rule(
        "RuntimeError", r"no running event loop",
        "A node's coroutines are run by rclpy, not by asyncio: asyncio's functions can't be awaited there. "
        "For a pause, await a future that a timer completes, or let a timer call the next step.",
    ),
    Rule(
        "RuntimeError", r"asyncio\.run\(\) cannot be called from a running event loop",
        "asyncio's event loop is already running, and there is only one in a thread. Start a task in it: "
        "`asyncio.create_task(...)`, which returns at once.",
    ),
    Rule(
        "RuntimeError", r"await wasn't used with future",
        "rclpy runs this coroutine, and can't await an asyncio future. Start an asyncio task in the "
        "callback, `asyncio.create_task(...)`, and return at once.",
    ),
    Rule(
        "OverflowError", r"cannot convert float infinity to integer",
        "inf and -inf can't be converted to a whole number: check `math.isfinite(number)` first.",
    ),
    Rule(
        "ValueError", r"cannot convert float NaN to integer",
        "nan can't be converted to a whole number: check `math.isfinite(number)` first.",
    ),
)  # fmt: skip
