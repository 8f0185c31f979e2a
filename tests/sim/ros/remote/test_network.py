"""A simulated network between the two processes gives the same recording as in one process."""

import pytest

from sim import Network, Process, run
from tests.sim.ros.remote import observers
from tests.sim.ros.remote.test_equal import ENGINE, OBSERVERS, evidence, found

RADIO = Network(loss=0.2, delay=0.05, jitter=0.02)
SLOW = Network(delay=0.1)
# The course's program on the robot, in this process; the student's on the laptop, in the other one.
PAIRS = [
    ("services", "Adder", "services", "Customer"),
    ("services", "Customer", "services", "Adder"),
    ("callers", "Flood", "services", "SlowAdder"),
    ("actions", "Server", "actions", "Client"),
    ("actions", "Client", "actions", "Server"),
    ("actions", "Impatient", "actions", "Server"),
    ("actions", "Server", "actions", "Impatient"),
]
LOOKING = [
    ("Burst", "ShortListener"),
    ("ShortListener", "Burst"),
    ("LateTalker", "LateListener"),
    ("LateListener", "LateTalker"),
    ("SloppyTalker", "PickyListener"),
]


EVENTS = [
    ("Punctual", "Waits"),
    ("Waits", "Punctual"),
    ("Manual", "Cares"),
    ("Cares", "Manual"),
    ("Steady", "ListensOnBestEffort"),
]


def same(follower, network, own, module, name, other):
    settings = {"seconds": 8, "quiet": True, "network": network}
    with follower.serving(module, name) as remote:
        there = run(Process(own, host="robot"), remote, **settings)
    here = run(Process(own, host="robot"), other, **settings)
    assert ordered(there) == ordered(here)
    return here


def ordered(recording):
    """The recording. What ends at the same time in both processes, such as a lease, has no order."""
    found = evidence(recording)
    return found | {kind: sorted(found[kind]) for kind in ("logs", "callbacks")}


@pytest.mark.parametrize("network", [SLOW, RADIO], ids=["slow", "radio"])
@pytest.mark.parametrize("pair", PAIRS, ids="-".join)
def test_services_and_actions(follower, network, pair):
    module, name, *other = pair
    same(follower, network, found(module, name), f"{ENGINE}.{other[0]}", other[1], found(*other))


@pytest.mark.parametrize("network", [SLOW, RADIO], ids=["slow", "radio"])
@pytest.mark.parametrize("pair", LOOKING, ids="-".join)
def test_topics(follower, network, pair):
    own, other = pair
    same(follower, network, getattr(observers, own), OBSERVERS, other, getattr(observers, other))


@pytest.mark.parametrize("network", [None, SLOW, RADIO], ids=["none", "slow", "radio"])
@pytest.mark.parametrize("pair", EVENTS, ids="-".join)
def test_deadlines_liveliness_and_losses(follower, network, pair):
    own, other = (found("qos_events", name) for name in pair)
    recording = same(follower, network, own, f"{ENGINE}.qos_events", pair[1], other)
    assert network is not RADIO or recording.logs
