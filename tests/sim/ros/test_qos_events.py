"""QoS events: matched endpoints, deadlines, liveliness and lost messages; and messages expire."""

import pytest
from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, LivelinessPolicy, ReliabilityPolicy

from sim import Network, Process, run
from tests.sim.ros.evidence import logged, raised
from tests.students.engine import network, qos_events

COMING_AND_GOING = [
    (1.0, "publishers 1, 1 (+1)"), (1.0, "subscriptions 1, 1 (+1)"),
    (2.0, "publishers 1, 0 (-1)"), (2.0, "subscriptions 1, 0 (-1)"),
]  # fmt: skip


def received(*programs):
    recording = run(*programs, seconds=4, quiet=True)
    assert (raised(recording), recording.stderr) == ([], "")
    return logged(recording)


@pytest.mark.parametrize("guest", [qos_events.Guest, qos_events.leaves])
def test_a_node_learns_who_comes_and_goes(guest):
    assert received(qos_events.Watcher, guest) == COMING_AND_GOING
    assert received(guest, qos_events.Watcher) == COMING_AND_GOING


def events_of(*programs, **more):
    """The events of each node, with their times."""
    recording = run(*programs, quiet=True, **more)
    assert (raised(recording), recording.stderr) == ([], "")
    return [(line.stamp, line.node, line.text) for line in recording.logs]


def both(stamp, count):
    return [(stamp, "speaks", f"offered [{count}] [1]"), (stamp, "listens", f"requested [{count}] [1]")]


def test_a_deadline_counts_from_the_first_message_and_again_and_again():
    missed = [1.6, 1.8, 2.0, 2.35, 2.55, 2.75, 2.95]
    expected = [row for count, stamp in enumerate(missed, 1) for row in both(stamp, count)]
    assert events_of(qos_events.Punctual, qos_events.Waits, seconds=3) == expected


def test_a_deadline_passes_when_nothing_else_happens_and_stops_the_robot():
    recording = run(qos_events.Joystick, qos_events.StopsTheRobot, world="room", seconds=3, quiet=True)
    sent = [(row.stamp, row.message.linear.x) for row in recording.messages("/cmd_vel")]
    stops = [(pytest.approx(1.0 + 0.3 * count), 0.0) for count in range(1, 7)]
    assert sent == [(pytest.approx(0.2 * count), 0.3) for count in range(1, 6)] + stops
    assert recording.pose_at(3) == recording.pose_at(2)._replace(stamp=3.0)


def test_signs_of_life_are_missed_and_come_again():
    assert events_of(qos_events.Manual, qos_events.Cares, seconds=4.2) == [
        (1.5, "listens", "changed [1, 0] [1, 0]"),
        (2.3, "speaks", "lost [1] [1]"), (2.3, "listens", "changed [0, 1] [-1, 1]"),
        (3.0, "listens", "changed [1, 0] [1, -1]"),
        (3.5, "speaks", "lost [2] [1]"), (3.5, "listens", "changed [0, 1] [-1, 1]"),
        (4.0, "listens", "changed [1, 0] [1, -1]"),
    ]  # fmt: skip


def test_on_best_effort_only_messages_are_signs_of_life():
    assert events_of(qos_events.SloppyManual, qos_events.CaresLittle, seconds=3) == [
        (1.5, "listens", "changed [1, 0] [1, 0]"),
        (2.0, "listens", "changed [0, 1] [-1, 1]"),
        (2.3, "speaks", "lost [1] [1]"),
    ]


def test_the_lease_of_a_subscription_may_be_longer():
    assert events_of(qos_events.Manual, qos_events.CaresLonger, seconds=3) == [
        (1.5, "listens", "changed [1, 0] [1, 0]"), (2.3, "speaks", "lost [1] [1]"),
        (2.8, "listens", "changed [0, 1] [-1, 1]"), (3.0, "listens", "changed [1, 0] [1, -1]"),
    ]  # fmt: skip


def test_who_is_there_is_alive_by_itself():
    assert events_of(qos_events.steady_for_a_while, qos_events.CaresLonger, seconds=4) == [
        (0.0, "listens", "changed [1, 0] [1, 0]"), (1.5, "listens", "changed [0, 0] [-1, 0]"),
    ]  # fmt: skip


def test_lost_messages_are_reported_with_the_next_one_that_comes():
    radio = Network(loss=0.2, delay=0.05)
    sloppy = Process(network.SloppyCounter, host="robot")
    assert events_of(sloppy, qos_events.ListensOnBestEffort, seconds=3, network=radio) == [
        (0.95, "listens", "missed [1] [1]"), (1.25, "listens", "missed [2] [1]"),
        (2.15, "listens", "missed [4] [2]"), (2.55, "listens", "missed [7] [3]"),
    ]  # fmt: skip


def test_messages_that_wait_expire_in_simulated_time():
    assert received(qos_events.Talker, qos_events.BriefSleeper) == [
        (0.5, "received 0"), (2.25, "received 2"), (4.0, "received 6"),
    ]  # fmt: skip


def test_the_lifespan_of_the_publisher_lets_no_message_expire_that_has_arrived():
    assert received(qos_events.Talker, qos_events.Sleeper) == [
        (0.5, "received 0"), (2.25, "received 1"), (4.0, "received 2"),
    ]  # fmt: skip


def test_latched_messages_expire_too():
    assert received(qos_events.latched_talker, qos_events.late) == [
        (2.25, "received 2"), (2.25, "received 3"), (2.5, "received 4"), (3.0, "received 5"),
        (3.5, "received 6"), (4.0, "received 7"),
    ]  # fmt: skip


SECOND, LONGER = Duration(seconds=1), Duration(seconds=2)


@pytest.mark.parametrize("between", [None, Network(delay=0.5)], ids=["one host", "two hosts"])
@pytest.mark.parametrize(
    ("policy", "offered", "wanted"),
    [
        ("RELIABILITY", {"reliability": ReliabilityPolicy.BEST_EFFORT}, {}),
        ("DURABILITY", {}, {"durability": DurabilityPolicy.TRANSIENT_LOCAL}),
        ("DEADLINE", {"deadline": LONGER}, {"deadline": SECOND}),
        ("DEADLINE", {}, {"deadline": SECOND}),
        ("LIVELINESS", {}, {"liveliness": LivelinessPolicy.MANUAL_BY_TOPIC}),
        ("LIVELINESS", {"liveliness_lease_duration": LONGER}, {"liveliness_lease_duration": SECOND}),
    ],
)
def test_what_does_not_fit_is_said_at_both_ends_in_rclpys_words(policy, offered, wanted, between):
    programs = qos_events.offers(**offered), Process(qos_events.wants(**wanted), host="robot")
    recording = run(*programs, seconds=1, quiet=True, network=between)
    assert {(line.stamp, line.level, line.node, line.text) for line in recording.logs} == {
        (
            0.0, "WARN", "publisher",
            "New subscription discovered on topic 'count', requesting incompatible QoS. "
            f"No messages will be sent to it. Last incompatible policy: {policy}",
        ),
        (
            0.0, "WARN", "subscriber",
            "New publisher discovered on topic 'count', offering incompatible QoS. "
            f"No messages will be received from it. Last incompatible policy: {policy}",
        ),
    }  # fmt: skip
