"""Nodes are told who comes and goes, messages expire in simulated time, and the rest is refused."""

import pytest

from sim import run
from tests.sim.ros.evidence import raised, said
from tests.students.engine import qos_events

COMING_AND_GOING = [
    (1.0, "publishers 1, 1 (+1)"), (1.0, "subscriptions 1, 1 (+1)"),
    (2.0, "publishers 1, 0 (-1)"), (2.0, "subscriptions 1, 0 (-1)"),
]  # fmt: skip
DEADLINE = (
    "Deadlines aren't simulated, so the deadline callback of count would never be called: in a timer,"
    " look at the time since the last message."
)
LEASE = (
    "Liveliness leases aren't simulated, so the liveliness callback of count would never be called:"
    " the callback `matched` tells who comes and goes."
)


def heard(*programs):
    recording = run(*programs, seconds=4, quiet=True)
    assert (raised(recording), recording.stderr) == ([], "")
    return said(recording)


@pytest.mark.parametrize("guest", [qos_events.Guest, qos_events.leaves])
def test_a_node_is_told_who_comes_and_goes(guest):
    assert heard(qos_events.Watcher, guest) == COMING_AND_GOING
    assert heard(guest, qos_events.Watcher) == COMING_AND_GOING


@pytest.mark.parametrize(
    ("program", "node", "words"),
    [
        (qos_events.Deadline, "/deadline", DEADLINE),
        (qos_events.OfferedDeadline, "/offered", DEADLINE),
        (qos_events.Leased, "/leased", LEASE),
    ],
    ids=["deadline", "offered deadline", "lease"],
)
def test_an_event_that_would_never_come_is_refused(program, node, words):
    errors = raised(run(program, seconds=1, quiet=True))
    assert errors == [(0.0, node, program.__name__, "UnsupportedEventTypeError", words)]


def test_a_node_may_go_on_without_an_event():
    assert heard(qos_events.Careful) == [(float(stamp), "heard 1") for stamp in (1, 2, 3, 4)]


def test_messages_that_wait_expire_in_simulated_time():
    assert heard(qos_events.Talker, qos_events.Sleeper) == [
        (0.5, "heard 0"), (2.25, "heard 2"), (4.0, "heard 6"),
    ]  # fmt: skip


def test_latched_messages_expire_too():
    assert heard(qos_events.latched_talker, qos_events.late) == [
        (2.25, "heard 2"), (2.25, "heard 3"), (2.5, "heard 4"), (3.0, "heard 5"), (3.5, "heard 6"),
        (4.0, "heard 7"),
    ]  # fmt: skip
