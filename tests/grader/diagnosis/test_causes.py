"""What goes wrong without an error: each cause is shown by real nodes and explained by its own sentence."""

import pytest

from grader.companions.service_clients import Tuner
from grader.diagnosis import DIAGNOSES, explain
from grader.exercises.actions import DriveServer, SpinServer
from sim import run
from tests.exercises.actions.square.students import SquareClient
from tests.exercises.settings.parameters import students as parameters
from tests.grader.diagnosis import test_radio, test_reported, test_silent_mistakes
from tests.grader.diagnosis.service_causes import SERVICE_CAUSES
from tests.students import misfits, service_misfits
from tests.students.engine import actions, callers, services

TYPO = "/talker publishes on {}, /listener subscribes to /chatter: two different topics. "
CAUSES = {
    (misfits.MisspeltTopic, misfits.Listener): TYPO.format("/chater")
    + "Is /chater a typo? Did you mean /chatter?",
    (misfits.CapitalTopic, misfits.Listener): TYPO.format("/Chatter")
    + "Capital letters count: write /chatter.",
    (misfits.TopicInNamespace, misfits.Listener): TYPO.format("/robot1/chatter")
    + "Only the namespace differs: write /chatter. A name that starts with a slash is taken as it is; without the "
    "slash the node's namespace is put before it.",
    (misfits.BestEffortTalker, misfits.Listener): "On /chatter the QoS settings are incompatible: /talker publishes with "
    "reliability best_effort, /listener requests reliable, so nothing arrives. An offer has to be at least as strong as the request: offer reliable, or request best_effort.",
    (
        misfits.Talker,
        misfits.LatchedListener,
    ): "On /chatter the QoS settings are incompatible: /talker publishes with durability "
    "volatile, /listener requests transient_local, so nothing arrives. An offer has to be at least as strong as the request: offer transient_local, or request volatile.",
    (
        misfits.Talker,
        misfits.ImpatientListener,
    ): "On /chatter the QoS settings are incompatible: /talker publishes without a deadline, /listener requests 0.5 s, so nothing "
    "arrives. An offer has to be at least as strong as the request: offer deadline 0.5 s or less, or request no "
    "deadline.",
    (
        misfits.Talker,
        misfits.ListenerForTheLiving,
    ): "On /chatter the QoS settings are incompatible: /talker publishes with liveliness automatic, /listener requests "
    "manual_by_topic, so nothing arrives. An offer has to be at least as strong as the request: offer "
    "manual_by_topic, or request automatic.",
    (
        misfits.SleepyTalker,
    ): "The timer of /talker fired 3 times in 10 s; 10 were due. Most likely SleepyTalker.tick "
    "waits (time.sleep, a long loop, a blocking service call) instead of returning: it blocked the node for 3 s. "
    "Let the timer do the waiting.",
    (
        misfits.Listener,
        misfits.TalksInItsConstructor,
    ): "/talker published on /chatter at 0 s, before its subscribers had discovered it: two programs need a moment "
    "to discover each other, and what is sent before that is lost. Create the publisher once, in __init__, and publish from a timer; or latch it (durability transient_local at both ends).",
    (
        misfits.NewPublisherEachTime,
    ): "/talker created 10 publishers on /chatter for 10 messages. Two programs need a moment to discover each "
    "other, and what a new publisher sends right away is lost: create it once, in __init__, and use it for every message.",
    (
        misfits.SilentTalker,
    ): "/talker has a publisher on /chatter, but never publishes. Call publish(msg) on it in "
    "the timer's callback.",
    (
        misfits.RateForPeriod,
    ): "/talker has a publisher on /chatter, but never publishes. Its timer has a period of 100 s, "
    "and the run lasts 10 s. The period is 1 / rate, in seconds.",
    (
        misfits.TalkerWithoutTimer,
    ): "/talker has a publisher on /chatter, but never publishes. It has no timer either: "
    "self.create_timer(seconds, self.callback) calls a method again and again.",
    (
        misfits.Talker,
        misfits.SilentEcho,
    ): "/listener has a publisher on /echo, but never publishes. Call publish(msg) "
    "on it in the callback of the subscription.",
    (misfits.Empty,): "/talker has no publisher, no subscription and no timer: nothing can happen in it.",
    (
        misfits.main_without_spin,
    ): "/talker has a timer, but none of its callbacks ever ran. Callbacks run while the "
    "node spins: call rclpy.spin(node) in main().",
    (
        misfits.main_that_only_sleeps,
    ): "/talker has a timer, but none of its callbacks ever ran. Callbacks run while "
    "the node spins: call rclpy.spin(node) in main().",
    (
        misfits.Talker,
        misfits.main_that_sleeps_over_messages,
    ): "/listener has a subscription with messages waiting, "
    "but none of its callbacks ever ran. Callbacks run while the node spins: call rclpy.spin(node) in main().",
    (
        misfits.main_that_listens_without_spin,
    ): "/listener has a subscription, but none of its callbacks ever ran. "
    "Callbacks run while the node spins: call rclpy.spin(node) in main().",
    (
        misfits.main_that_spins_three_seconds,
    ): "Every program had ended by t = 4 s. The run lasts until t = 10 s. "
    "A node lives as long as something keeps it spinning: rclpy.spin(node) returns only at shutdown.",
    (
        misfits.SleepyOnce,
    ): "The timer of /talker fired once in 10 s; 10 were due. Most likely SleepyOnce.tick waits "
    "(time.sleep, a long loop, a blocking service call) instead of returning: it blocked the node for 8.5 s. "
    "Let the timer do the waiting.",
    **SERVICE_CAUSES,
}


def names(students):
    return "+".join(student.__name__ for student in students)


@pytest.mark.parametrize("students, sentence", CAUSES.items(), ids=map(names, CAUSES))
def test_a_cause_is_explained(students, sentence):
    assert explain(run(*students, seconds=10, quiet=True)) == sentence


@pytest.mark.parametrize(
    "students, world",
    [
        ((misfits.Talker,), None),
        ((misfits.Talker, misfits.Listener), None),
        ((misfits.Listener, misfits.SaysItAgain), None),
        ((misfits.NewPublisherThatLatches,), None),
        ((misfits.NewPublisherForTheNextMessage, misfits.Listener), None),
        ((misfits.Listener, misfits.Talker), "yard"),
        ((misfits.Talker,), "room"),
        ((services.Adder, services.done_callback), "yard"),
        ((services.SlowAdder, services.many_calls), None),
        ((services.SlowAdder, callers.gives_up), None),
        ((callers.two_servers, services.done_callback), None),
        ((services.Adder, services.single_exclusive), None),
        ((services.Wheel, services.parameter_services), None),
        ((service_misfits.launch_with_parameters,), None),
        ((service_misfits.launch_of_a_taker,), None),
        ((service_misfits.launch_of_a_declarer,), None),
        ((service_misfits.launch_of_an_unconfigured_node,), None),
        ((service_misfits.launch_of_a_configured_node,), None),
        ((actions.Server, actions.Client), None),
        ((actions.Server, actions.Greedy), None),
        ((actions.Aborting, actions.Client), None),
        ((actions.parallel_server, actions.Impatient), None),
        ((DriveServer, SpinServer, SquareClient), "yard"),  # awaits its goals, and holds no one up
    ],
)
def test_nodes_that_do_well_are_left_alone_and_so_is_the_robot(students, world):
    assert explain(run(*students, world=world, seconds=10, quiet=True)) == ""


def test_the_name_that_isnt_the_course_is_the_misspelt_one():
    misspelt = run(misfits.MisspeltTopic, companions=[misfits.Listener], quiet=True)
    assert explain(misspelt).endswith("Is /chater a typo? Did you mean /chatter?")
    misheard = run(misfits.Listener, companions=[misfits.MisspeltTopic], quiet=True)
    assert explain(misheard).endswith("Is /chatter a typo? Did you mean /chater?")
    called = run(services.done_callback, companions=[service_misfits.MisspeltService], quiet=True)
    assert explain(called).endswith("Did you mean /ad?")


def test_a_coroutine_takes_what_it_awaits_and_the_course_may_answer_with_zeros():
    recording = run(service_misfits.AwaitsTwice, companions=[services.SlowAdder], seconds=5, quiet=True)
    assert [call.response.sum for call in recording.calls] == [0, 0]
    assert explain(recording) == ""
    companions = [service_misfits.NoOneReceives]
    assert explain(run(services.SlowAdder, companions=companions, seconds=5, quiet=True)) == ""


def namesakes():
    return run(misfits.Listener, companions=[misfits.Talker, misfits.Listener], seconds=10, quiet=True)


def test_a_name_that_one_of_the_course_has_is_reported():
    assert explain(namesakes()) == (
        "Two nodes are called /listener, yours and one that takes part in this exercise, and ROS can't tell "
        "them apart: give yours a name of its own, in super().__init__('...')."
    )


TUNED = {
    parameters.ParameterMisspelt: "/tuner requests the parameter `speed` of /cruiser, which declares `Speed`: spell it the same way everywhere.",
    parameters.WholeNumberMadeReal: "The parameter `speed` of /cruiser takes only whole numbers, because its default is one, and ROS refuses 0.41. Write the default with a decimal point: 0.0, not 0.",
    parameters.Cruiser: "",
    parameters.NoCallback: "",
}


def tuned(cruiser):
    """What the course sets its parameter in."""
    return run(cruiser, companions=[Tuner], world="yard", seconds=4, seed=1, quiet=True)


@pytest.mark.parametrize(("cruiser", "sentence"), TUNED.items(), ids=lambda it: getattr(it, "__name__", ""))
def test_a_parameter_that_the_course_ask_for_in_vain_is_explained(cruiser, sentence):
    assert explain(tuned(cruiser)) == sentence


def test_every_diagnosis_is_earned_by_some_students():
    recordings = [run(*students, seconds=10, quiet=True) for students in CAUSES]
    recordings += [namesakes(), run(misfits.Talker, companions=[misfits.Talker], quiet=True)]
    recordings += map(tuned, TUNED)
    recordings += [test_silent_mistakes.record(*programs) for programs in test_silent_mistakes.SILENT]
    recordings += map(test_reported.record, test_reported.FLAWS)
    recordings += [test_radio.record(*case[:3]) for case in test_radio.SENTENCES]
    unearned = [d.__name__ for d in DIAGNOSES if not any(d(recording) for recording in recordings)]
    assert unearned == []
