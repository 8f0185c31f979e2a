"""Where a None came from: the function that returned it is named, and not a cause that only looks alike."""

import pytest

from grader.diagnosis import find_fault
from sim import run
from sim.evidence import CallbackError
from tests.students import none_mistakes as mistakes
from tests.students.engine.services import Adder

NO_RETURN = "`{}` returned None, because it has no `return` with a value. End it with `return {}`."
NO_NAME = "`{}` returned None, because it has no `return` with a value. End it with `return` and a value."
ONE_PATH = "`self.speed` returned None: not every path through it ends with `return` and a value."
CHANGES = "`{}` changes the list itself and returns None."
ADVICE = {
    mistakes.polls_what_was_not_returned: NO_RETURN.format("node.send", "future"),
    mistakes.waits_for_what_was_not_returned: NO_RETURN.format("node.send", "future"),
    mistakes.spins_what_was_not_returned: NO_RETURN.format("make_node", "node"),
    mistakes.takes_what_spinning_returns: "`rclpy.spin_until_future_complete` never returns a value: it gives None.",
    mistakes.PublishesWhatWasNotReturned: NO_NAME.format("self.make"),
    mistakes.MultipliesNothing: ONE_PATH,
    mistakes.ComparesNothing: ONE_PATH,
    mistakes.RootOfNothing: ONE_PATH,
    mistakes.UnpacksNothing: NO_RETURN.format("self.pair", "point"),
    mistakes.PassesOnNothing: NO_RETURN.format("self.pair", "point"),
    mistakes.KeepsNothing: NO_NAME.format("self.make"),
    mistakes.AwaitsNothing: NO_RETURN.format("self.ask", "total"),
    mistakes.LoopsOverASort: CHANGES.format("self.distances.sort"),
    mistakes.TakesTheFirstOfASort: CHANGES.format("distances.sort"),
    mistakes.LoopsOverAReturnedReverse: "There was None where a list or a point was expected: a function ended without "
    "`return`, or with `return values.reverse()`, which reverses the list itself and returns nothing; `values[::-1]` "
    "is a reversed copy.",
    mistakes.LooksUpNothing: "The value before `.x` is None: it was never set, or comes from a function without `return`.",
}


@pytest.mark.parametrize("student, advice", ADVICE.items(), ids=lambda it: getattr(it, "__name__", ""))
def test_the_function_that_returned_nothing_is_named(student, advice):
    assert find_fault(run(student, companions=[Adder], seconds=3, quiet=True)).hint == advice


def test_an_error_without_a_note_has_none():
    assert CallbackError(0.5, "/talker", "tick", "TypeError", "", "TypeError: Note: no line\n").note == ""
