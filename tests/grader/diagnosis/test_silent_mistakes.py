"""What ROS is silent about is named: stamps that never meet, transforms, a Rate, a name off /rosout."""

import pytest

from grader.diagnosis import find_fault, find_flaw
from sim import run
from tests.students import silent_mistakes as mistakes

NEVER_MET = "The callback of /pairs's synchronizer never ran: the stamps of /point and /scan never meet. "
APART = (
    f"{NEVER_MET}The nearest two are 0.03 s apart: ApproximateTimeSynchronizer([a, b], 10, slop) accepts stamps that "
    "differ by less than slop, in seconds."
)
BOTH = (
    "/localizer and /other_localizer both send the transform {} on /tf, and listeners get now one, now the other. Only "
    "one node may send the transform of a frame: give the frames of two robots a prefix, or stop one of the nodes."
)
SILENT = {
    (mistakes.NeverStamps,): f"{NEVER_MET}Those of /point are 0: set them before you publish, with "
    "`msg.header.stamp = self.get_clock().now().to_msg()`, or copy the stamp of the message that yours is made from.",
    (mistakes.StampsApart,): APART,
    (mistakes.StampsFurtherApartThanTheSlop,): APART,
    (mistakes.NeverStampsTransforms,): "/localizer sends the transform map -> odom with the stamp 0, so a lookup for "
    "any other time finds none. Set it each time, before sendTransform(): `t.header.stamp = "
    "self.get_clock().now().to_msg()`.",
    (mistakes.Localizer, mistakes.OtherLocalizer): BOTH.format("map -> odom"),
    (mistakes.Localizer, mistakes.LocalizerInTheWorld): BOTH.format("to odom (from map and world)"),
    (mistakes.sleeps_in_its_only_thread,): "/sleeper has a Rate, which is a timer of the node, but no other thread "
    "spins the node, so rate.sleep() never returns. Use create_timer in its place, or spin first in a thread: "
    "`threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()`.",
    (mistakes.destroys_a_namesake,): "Two nodes of one program were called /twin, and one of them was destroyed at 0 "
    "s: ROS then takes the name off /rosout, and what the other one logs no longer arrives there. Give each node a "
    "name of its own, in super().__init__('...').",
}
INPUT = (
    "message_filters.Subscriber takes the node first, and then what create_subscription takes: "
    "`Subscriber(self, LaserScan, '/scan')`."
)
CALLED = (
    "{} is called with one message for each input of its filter{}, in the order of the inputs: "
    "`def on_pair(self, scan, image):` for two."
)
FAULTS = {
    mistakes.TakesNoMessage: CALLED.format("`on_pair`", ", here 2"),
    mistakes.TakesOneMessage: CALLED.format("`on_pair`", ", here 2"),
    mistakes.TakesThreeMessages: CALLED.format("`on_pair`", ""),
    mistakes.TakesOneMessageInALambda: CALLED.format("The lambda", ", here 2"),
    mistakes.FiltersWithoutANode: INPUT,
    mistakes.FiltersInAnotherOrder: INPUT,
    mistakes.SleepsInACallback: "A Rate is a timer of the node: sleep() returns when the thread that spins the node "
    "runs its callback, so it can't be called in a callback of that thread. Let a timer do the next step, or sleep in "
    "another thread.",
}
RIGHT = [
    (mistakes.Pairs,),
    (mistakes.HasOneInput,),
    (mistakes.Localizer,),
    (mistakes.SendsStatically,),
    (mistakes.Localizer, mistakes.LocalizerOfAnotherRobot),
    (mistakes.Predecessor, mistakes.Successor),
    (mistakes.sleeps_beside_its_spinning_thread,),
    (mistakes.makes_its_node_again,),
]


def names(programs):
    return "+".join(each.__name__ for each in programs)


def record(*programs):
    return run(*programs, seconds=3, quiet=True)


@pytest.mark.parametrize("programs", SILENT, ids=names)
def test_what_ros_is_silent_about_is_named(programs):
    recording = record(*programs)
    assert find_fault(recording) is None
    assert find_flaw(recording) == SILENT[programs]


@pytest.mark.parametrize("student", FAULTS, ids=lambda it: it.__name__)
def test_a_mistake_around_filters_and_rates_gets_its_advice(student):
    assert find_fault(record(student)).hint == FAULTS[student]


def test_the_line_of_a_callback_that_a_filter_calls_wrongly_is_named():
    line = mistakes.TakesNoMessage.on_pair.__code__.co_firstlineno
    assert find_fault(record(mistakes.TakesNoMessage)).saw == (
        f"TypeError: TakesNoMessage.on_pair() takes 1 positional argument but 3 were given (in on_pair, line {line}, "
        "at 0.1 s)"
    )


def test_a_callback_that_sleeps_at_a_rate_waits_for_its_timer():
    assert find_fault(record(mistakes.SleepsInACallback)).saw.endswith(
        "It waits for the timer of the Rate, which needs the thread that waits."
    )


@pytest.mark.parametrize("programs", RIGHT, ids=names)
def test_a_right_program_beside_them_has_neither_fault_nor_flaw(programs):
    recording = record(*programs)
    assert (find_fault(recording), find_flaw(recording)) == (None, "")
