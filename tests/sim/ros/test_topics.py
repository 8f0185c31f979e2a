"""Messages are handed over inside a run as the middleware would carry them."""

import pytest
import rclpy
from std_msgs.msg import String
from std_srvs.srv import Trigger

from sim import Recording, run
from sim.ros.transport.topics import MIDDLEWARE
from tests.sim.ros import all_worlds
from tests.sim.ros.remote import observers
from tests.sim.ros.remote.test_equal import ALONE, LOOKING, TOGETHER, evidence, found
from tests.students.engine import topics

PROGRAMS = [
    *([found(module, name)] for module, names in ALONE.items() for name in names),
    *([found(*one), found(*other)] for one, other in TOGETHER),
    # The middleware has one program here, and carries what two would publish before discovery.
    *([getattr(observers, one), getattr(observers, other)] for one, other in LOOKING if one != "Gossip"),
    [topics.EveryProfile],
    [topics.ForgetsEnds],
    [topics.SpeaksAfterItsEnd],
]


def logged(recording: Recording) -> list[str]:
    return [line.text for line in recording.logs]


def late(lines: list[str], topic: str) -> list[str]:
    """The words that a late listener got."""
    begin = f"late on {topic}: "
    return [line.removeprefix(begin).split(",")[0] for line in lines if line.startswith(begin)]


def names(programs: list) -> str:
    """Of programs; a launch file's is that of its file."""
    return "+".join(getattr(one, "__name__", None) or one.name for one in programs)


@pytest.mark.parametrize("programs", PROGRAMS, ids=names)
def test_a_run_is_the_same_with_the_middleware_in_between(monkeypatch, programs):
    inside = run(*programs, seconds=6, quiet=True)
    monkeypatch.setenv(MIDDLEWARE, "1")
    assert evidence(run(*programs, seconds=6, quiet=True)) == evidence(inside)


def test_a_robot_is_the_same_with_the_middleware_in_between(monkeypatch):
    world = all_worlds.World.load("room")
    inside = all_worlds.in_use(world)
    monkeypatch.setenv(MIDDLEWARE, "1")
    assert evidence(all_worlds.in_use(world)) == evidence(inside)


def test_late_listeners_get_what_is_latched_and_no_one_else_does():
    lines = logged(run(topics.EveryProfile, seconds=2, quiet=True))
    assert late(lines, "chat_0") == ["word 2", "last word"]  # both latch, and two fit into the queue
    assert late(lines, "chat_1") == ["last word"]
    assert late(lines, "chat_8") == []  # they don't suit each other


def test_what_a_publisher_has_latched_goes_with_it():
    assert logged(run(topics.ForgetsEnds, seconds=3, quiet=True)) == [
        "of the one that goes",
        "of the one that stays",
        "of the one that stays",
        "to no one",
    ]


def test_bytes_that_are_no_message_reach_no_one():
    recording = run(topics.Garbage, seconds=2.5, quiet=True)
    assert logged(recording) == ["a message", "a message"]
    assert not recording.errors


def test_a_destroyed_publisher_refuses_to_publish():
    (error,) = run(topics.SpeaksAfterItsEnd, seconds=1, quiet=True).errors
    assert error.type == "InvalidHandle"
    assert error.text == "cannot use Destroyable because destruction was requested"


INVALID = "rcl node's context is invalid"
NOT_VALID = "the given context is not valid, either rcl_init() was not called or rcl_shutdown() was called."


@pytest.mark.parametrize(
    ("create", "text"),
    [
        ("create_publisher(String, 'chatter', 10)", f"Failed to create publisher: {INVALID}"),
        ("create_subscription(String, 'chatter', print, 10)", f"Failed to create subscription: {INVALID}"),
        ("create_service(Trigger, 'trigger', print)", f"failed to create service: {INVALID}"),
        ("create_client(Trigger, 'trigger')", f"failed to create client: {INVALID}"),
        ("create_timer(1.0, print)", f"failed to create timer: {NOT_VALID}"),
    ],
)
def test_nothing_is_created_after_shutdown(create, text):
    """rclpy's words, without the place in rcl's sources."""

    def main():
        rclpy.init()
        node = rclpy.create_node("late")
        rclpy.shutdown()
        eval(f"node.{create}", {"node": node, "String": String, "Trigger": Trigger})

    (error,) = run(main, seconds=1, quiet=True).errors
    assert (error.type, error.text) == ("RCLError", text)


@pytest.mark.parametrize("programs", [
    [topics.Receives, topics.SaysItAtOnce], [topics.SaysItAtOnce, topics.Receives],
], ids=["matched before", "matched after"])  # fmt: skip
def test_what_is_said_before_two_programs_have_found_each_other_is_lost(programs):
    recording = run(*programs, seconds=3, quiet=True)
    assert [(line.stamp, line.text) for line in recording.logs] == [
        (stamp, "from a timer") for stamp in (1.0, 2.0, 3.0)
    ]
    lost = [(0.0, "/hasty", "/words"), (1.0, "/hasty", "/more_words")]
    assert [tuple(row) for row in recording.undelivered] == (
        lost if programs[0] is topics.Receives else lost[1:]
    )
    assert len(recording.messages("/more_words")) == 3
    early = [(received.stamp, received.topic) for received in recording.messages() if received.early]
    assert early == [(0.0, "/words"), *((stamp, "/more_words") for stamp in (1.0, 2.0, 3.0))]


def test_what_is_latched_is_not_lost():
    recording = run(topics.ReceivesWhatIsLatched, topics.SaysItAtOnceAndLatches, seconds=1, quiet=True)
    assert logged(recording) == ["in __init__", "from a timer", "in a new one"]
    assert recording.undelivered == []
    assert not any(received.early for received in recording.messages())


def test_nodes_of_one_program_know_each_other_at_once():
    recording = run(topics.both_in_one_program, seconds=1, quiet=True)
    assert logged(recording) == ["in __init__", "from a timer", "in a new one"]
    assert recording.undelivered == []


def test_a_subscription_that_is_as_new_receives_nothing_of_that_moment():
    recording = run(topics.Receives, topics.LateListener, topics.SaysItAtOnce, seconds=2, quiet=True)
    assert [(line.stamp, line.node) for line in recording.logs] == [
        (1.0, "receives"), (2.0, "receives"), (2.0, "late"),
    ]  # fmt: skip


def counts_subscriptions():
    """Counts at once, and again a moment later."""
    rclpy.init()
    node = rclpy.create_node("counts")
    publisher = node.create_publisher(String, "words", 10)
    for _ in range(2):
        node.get_logger().info(str(publisher.get_subscription_count()))
        rclpy.spin_once(node, timeout_sec=0.1)


def test_a_subscription_counts_as_soon_as_messages_reach_it():
    recording = run(topics.Receives, counts_subscriptions, seconds=1, quiet=True)
    assert [(line.stamp, line.text) for line in recording.logs] == [(0.0, "0"), (0.1, "1")]
