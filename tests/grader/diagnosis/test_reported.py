"""Mistakes that are reported on public trackers, each made by a small node, and the words for each."""

import pytest

from grader.diagnosis import find_fault, find_flaw
from sim import run
from tests.students import reported

TWO_EXECUTORS = (
    "At 0 s a second executor took over /ticker, and the first one, which also spins, no longer runs any of its callbacks: a node belongs to one executor. Spin it with one. `rclpy.spin_once(node)` and "
    "`rclpy.spin_until_future_complete(node, future)` use an executor of their own unless you pass "
    "`executor=node.executor`."
)
CATCH = "Catch tf2_ros.TransformException around the lookup: at the start some transforms are missing."
UNTYPED = (
    "The parameter `names` got a list of type STRING_ARRAY, but was declared with an empty list, which rclpy takes "
    "for a BYTE_ARRAY: `[]` doesn't show what is in the list. Declare the type: `self.declare_parameter('names', "
    "Parameter.Type.STRING_ARRAY)`, with `from rclpy.parameter import Parameter`; the parameter then has no value "
    "until it is set."
)
LOST = (
    "/once sent its only message on /chatter at {} s, before /listener could receive it. What is sent before a "
    "subscription exists and is discovered is lost: publish from a timer, or latch the message (durability "
    "transient_local at both ends)."
)
UNCONFIGURED = (
    "/camera is unconfigured, and a lifecycle node has no transition activate in this state (possible: configure or shutdown). "
    "Read the state first (`ros2 lifecycle get /camera`, or the service get_state), and go through the "
    "states in order: configure, activate, deactivate, cleanup. rclpy does not refuse a wrong request: it raises an exception, and the node dies."
)
ADVICE = {
    (
        reported.PausesWithAsyncio,
    ): "`asyncio.sleep()` works only in asyncio's event loop, and a callback that is a "
    "coroutine runs in rclpy's executor. For a pause, await a future that a timer completes: `pause = Future(); "
    "timer = self.create_timer(0.5, lambda: pause.set_result(None)); await pause; timer.cancel()`, with `from "
    "rclpy.task import Future`.",
    (
        reported.Scanner,
        reported.LooksUpAtTheStamp,
    ): "The transform for time 1735689601.200000 has not arrived yet: the newest is for time 1735689601.000000. A transform often arrives later than the measurement with its stamp. "
    "Use the newest one, with `rclpy.time.Time()` in place of the stamp, or wait for it: "
    f"`timeout=Duration(seconds=0.2)`, in a node that a `MultiThreadedExecutor` spins, so that it keeps receiving meanwhile. {CATCH}",
    (
        reported.Scanner,
        reported.LooksUpTooOld,
    ): "The buffer has no transform for time 1735689600.000000: its earliest is for time 1735689600.500000. It holds the last 10 s, and nothing from before the listener started. "
    + CATCH,
    (
        reported.Scanner,
        reported.LooksUpAMisspeltFrame,
    ): "No transform with the frame `wrold` has arrived: either no "
    f"node publishes it, the name (target_frame) has a typo, or the lookup comes too early. {CATCH}",
    (
        reported.Scanner,
        reported.island,
        reported.LooksUpAnIsland,
    ): "`sea` and `base` are in two trees: no transform that connects them has arrived. Either no node publishes it, "
    f"or the lookup comes too early. {CATCH}",
    (reported.ActivatesItself,): UNCONFIGURED,
    (reported.Camera, reported.ActivatesTooEarly): UNCONFIGURED,
    (reported.named_at_the_start,): UNTYPED,
}
FLAWS = {
    (reported.spun_by_two_executors,): TWO_EXECUTORS,
    (reported.spun_once_beside_its_executor,): TWO_EXECUTORS,
    (reported.Named, reported.NamesOthers): UNTYPED,
    (
        reported.sleeps_in_its_cancel_callback,
        reported.Canceling,
    ): "/canceling requested at 1.1 s that its goal be canceled, but the cancel callback of /counting took 2 s; meanwhile the goal carried on and ended. Return CancelResponse.ACCEPT at once, and do anything that takes time in execute, once goal_handle.is_cancel_requested is True.",
    (reported.Once, reported.Listener): LOST.format("0"),
    (reported.Once, reported.listens_late): LOST.format("0"),
    (
        reported.OnceWithALifespan,
        reported.listens_late_to_latched,
    ): "/once sent its only message on /chatter at 0.5 s, and it expired before /listener received it: the lifespan is 0.1 s. Spin the node from the start, or use a longer lifespan.",
}


def names(students):
    return "+".join(student.__name__ for student in students)


def record(students):
    return run(*students, seconds=5, quiet=True)


@pytest.mark.parametrize("students", ADVICE, ids=names)
def test_an_error_that_is_often_reported_gets_its_advice(students):
    assert find_fault(record(students)).hint == ADVICE[students]


@pytest.mark.parametrize("students", FLAWS, ids=names)
def test_a_silent_mistake_that_is_often_reported_is_named(students):
    recording = record(students)
    assert find_fault(recording) is None
    assert find_flaw(recording) == FLAWS[students]


def test_a_cancel_in_the_last_moment_is_no_mistake():
    recording = record((reported.cancels_promptly, reported.CancelingInTheLastMoment))
    assert [event for _, event in recording.goals[0].events][-2:] == ["canceling", "succeeded"]
    assert find_flaw(recording) == ""


def test_a_cancel_just_before_the_end_of_the_run_is_no_mistake():
    students = reported.sleeps_in_its_cancel_callback, reported.Canceling
    recording = run(*students, seconds=1.3, quiet=True)
    assert [event for _, event in recording.goals[0].events][-1] == "cancel requested"
    assert find_flaw(recording) == ""
