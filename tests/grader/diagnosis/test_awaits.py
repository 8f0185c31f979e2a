"""What a run says of callbacks that await futures: which are never completed, and which only wait."""

import linecache
from types import FunctionType

import pytest

from grader.diagnosis import find_fault, find_flaw
from sim import run
from tests.students.engine import awaits
from tests.students.engine.actions import Client

IN_VAIN = "It awaits a future that no code completes: nothing calls its set_result()."
SAME_GROUP = (
    "It awaits a future that only {} can complete, and that is in the same callback group, so it can run "
    "only after {} has returned."
)
COMPLETE_IT = (
    "A future is complete once some code has called `future.set_result(value)` on it: a callback of another "
    "callback group, or another thread. Without one, let a timer or a subscription do the next step."
)
OTHER_GROUP = (
    "A callback that awaits occupies its callback group until it has returned. Give the timer or "
    "subscription that completes the future a group of its own: `callback_group=ReentrantCallbackGroup()`, "
    "with `from rclpy.callback_groups import ReentrantCallbackGroup`."
)
WRONG = {
    (awaits.Waiting,): ("Waiting.go", 0.5, awaits.Waiting, "await Future()", IN_VAIN),
    (awaits.spins_in_steps,): ("Waiting.go", 0.5, awaits.Waiting, "await Future()", IN_VAIN),
    (awaits.WaitsInExecute, Client): (
        "WaitsInExecute.execute", 0, awaits.WaitsInExecute, "await Future()", IN_VAIN,
    ),
    (awaits.SleepsInItsGroup,): (
        "SleepsInItsGroup.go", 0.5, awaits.SleepsInItsGroup, "await pause",
        SAME_GROUP.format("<lambda>", "SleepsInItsGroup.go"),
    ),
    (awaits.SleepsWithAPartial,): (
        "SleepsWithAPartial.go", 0.5, awaits.SleepsWithAPartial, "await pause",
        SAME_GROUP.format("wake", "SleepsWithAPartial.go"),
    ),
    (awaits.OpensInItsGroup,): (
        "OpensInItsGroup.go", 0.5, awaits.OpensInItsGroup, "await self.opened",
        SAME_GROUP.format("OpensInItsGroup.open", "OpensInItsGroup.go"),
    ),
}  # fmt: skip
RIGHT = [
    awaits.SleepsInAnotherGroup,
    awaits.WaitsForAService,
    awaits.FindsItsFuture,
    awaits.opens_it_late,
    awaits.stays_with_a_task,
]


def line_of(owner, text):
    # A function's code knows its file, whatever became of the module.
    codes = [each.__code__ for each in vars(owner).values() if isinstance(each, FunctionType)]
    lines, first = linecache.getlines(codes[0].co_filename), min(code.co_firstlineno for code in codes)
    return next(at for at, line in enumerate(lines, 1) if at >= first and line.strip() == text)


def names(programs):
    return "+".join(each.__name__ for each in programs)


@pytest.mark.parametrize("programs", WRONG, ids=names)
def test_a_future_that_is_never_completed_is_named_with_the_line(programs):
    name, since, owner, text, why = WRONG[programs]
    fault = find_fault(run(*programs, seconds=3, quiet=True))
    node = "server" if "server" in fault.saw else "waiting"
    assert fault.saw == (
        f"{name} of node /{node} has waited since t = {since:g} s and never returned, at line "
        f"{line_of(owner, text)}: {text}. {why}"
    )
    assert fault.hint == (COMPLETE_IT if why == IN_VAIN else OTHER_GROUP)


@pytest.mark.parametrize("program", RIGHT, ids=lambda it: it.__name__)
def test_a_future_that_may_still_be_completed_is_no_fault(program):
    recording = run(program, seconds=3, quiet=True)
    assert (find_fault(recording), find_flaw(recording)) == (None, "")
