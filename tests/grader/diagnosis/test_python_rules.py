"""Mistakes of Python's own kind, made by real nodes: each gets its own advice, and the line of the fault."""

import re

import pytest

from grader.diagnosis import find_fault
from grader.diagnosis.python_rules import PYTHON_RULES
from sim import run
from tests.students import python_mistakes as mistakes

BLOCK = "Lines of one block begin in the same column: indent by four spaces for each level, never with tabs."
ADVICE = {
    "AddsOtherShapes": "Arrays with the shapes (3,) and (2,) don't fit together: for `+`, `-`, `*` and comparisons the shapes must be equal, or one of the two must be a single number. `.shape` gives the shape of an array.",
    "FillsTooSmallAPlace": "Values with the shape (3,) don't fit where the shape (2,) is needed: both sides of `=` need the same shape.",
    "MultipliesOtherShapes": "In `a @ b` the number of a's columns must equal the number of b's rows; here they are 3 and 2.",
    "DotsOtherShapes": "Arrays with the shapes (2,3) and (2,) can't be multiplied: a needs as many columns as b has rows.",
    "ChoosesByAnotherLength": "A mask must be as long as the array that it selects from: the array has 2 values, the mask 4.",
    "AsksAnArray": "An array is not True or False as a whole: `(...).any()` tests whether at least one value is, `(...).all()` whether all of them are.",
    "ForgetsToIndent": "Indent what belongs to the function definition on line 1 by four more spaces.",
    "IndentsTooFar": BLOCK,
    "MixesTabs": BLOCK,
    "ForgetsTheColon": "A colon is missing at the end of that line: `if`, `else`, `for`, `while`, `def` and `class` need one.",
    "ForgetsABracket": "The `(` on that line is never closed.",
    "WritesNonsense": "Python can't read that line: check its brackets, quotes, commas and colons.",
    "SleepsWithAsyncio": "`asyncio.sleep()` works only in asyncio's event loop, and a callback that is a coroutine runs in rclpy's executor. For a pause, await a future that a timer completes: `pause = Future(); timer = self.create_timer(0.5, lambda: pause.set_result(None)); await pause; timer.cancel()`, with `from rclpy.task import Future`.",
    "awaits_in_asyncios_loop": "rclpy runs this coroutine, and can't await an asyncio future. Start an asyncio task in the callback, `asyncio.create_task(...)`, and return at once.",
    "runs_in_asyncios_loop": "asyncio's event loop is already running, and there is only one in a thread. Start a task in it: `asyncio.create_task(...)`, which returns at once.",
    "OpensNoFile": "There is no file `map.yaml`. A name without a slash in front is looked for in the folder that the program was started in, here the notebook's: `os.getcwd()` names it, `os.listdir()` what is in it.",
    "StartsNoProgram": "There is no program `ros2` on this machine. What it would do can often be done in Python: a node has methods for what `ros2 topic`, `ros2 service` and `ros2 param` do.",
    "MakesAnIntOfInf": "inf and -inf can't be converted to a whole number: check `math.isfinite(number)` first.",
    "MakesAnIntOfNan": "nan can't be converted to a whole number: check `math.isfinite(number)` first.",
}


def record(name, *others):
    return run(*others, getattr(mistakes, name), seconds=2, quiet=True)


@pytest.mark.parametrize("name", ADVICE)
def test_a_mistake_gets_its_advice(name):
    assert find_fault(record(name)).hint == ADVICE[name]


@pytest.mark.parametrize("name", ["Worker", "Imports", "Scanner"])
def test_what_they_are_built_on_has_no_fault(name):
    assert find_fault(record(name)) is None


@pytest.mark.parametrize(
    ("name", "saw"),
    {
        "ForgetsToIndent": "IndentationError: expected an indented block after function definition on line 1 "
        "(in not_indented.py, line 2, at 1 s)",
        "ForgetsABracket": "SyntaxError: '(' was never closed (in open_bracket.py, line 2, at 1 s)",
    }.items(),
)
def test_code_that_cannot_be_read_is_shown_at_the_line_of_the_fault_not_at_its_import(name, saw):
    assert find_fault(record(name)).saw == saw


def test_a_ray_without_a_distance_is_named_with_what_it_means():
    assert find_fault(record("MapsEveryRay", mistakes.Scanner)).hint == (
        "In the scan of 0.5 s ray 1 is inf (nothing is there), ray 3 is -inf (something is too near to be "
        "measured), ray 5 is nan (the ray got lost, and every comparison with nan is False). Check `math.isfinite(distance)` before you calculate with it."
    )


def test_no_rule_stands_there_without_a_student_who_earns_it():
    errors = [record(name).errors[0] for name in ADVICE]
    earned = [any(r.type == e.type and re.search(r.pattern, e.text) for e in errors) for r in PYTHON_RULES]
    assert earned == [True] * len(PYTHON_RULES)
