"""The cart and its pole as a ROS node, and controllers that balance it or don't."""

import math

import pytest

from sim import run
from sim.evidence import since_start
from sim.world import World, simulate
from tests.sim.ros.evidence import logged
from tests.students.machines import cart_pole as students


def received(recording):
    """(x, angle, v, w) of every message on /joint_states."""
    messages = [received.message for received in recording.messages("/joint_states")]
    return [(*joints.position, *joints.velocity) for joints in messages]


def greatest(recording, index):
    return max(abs(state[index]) for state in received(recording))


@pytest.mark.parametrize("controller", [students.Balancer, students.Steadier, students.Timed])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_good_controller_balances_for_twenty_seconds(controller, seed):
    recording = run(controller, world="cart_pole", seconds=20, seed=seed, quiet=True)
    assert (recording.ended.reason, recording.errors) == ("time", [])
    assert greatest(recording, 1) < 0.2
    assert greatest(recording, 0) < 0.5
    assert abs(received(recording)[-1][1]) < 0.01


@pytest.mark.parametrize("controller", [students.TooSlow, students.WrongSign, students.AngleOnly])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_poor_controller_drops_the_pole(controller, seed):
    recording = run(controller, world="cart_pole", seconds=20, seed=seed, quiet=True)
    assert greatest(recording, 1) > math.pi / 2


def test_without_a_controller_the_pole_falls_and_hangs_at_last():
    recording = run(world="cart_pole", seconds=60, quiet=True)
    angle = received(recording)[-1][1]
    assert abs(angle) == pytest.approx(math.pi, abs=0.6)
    assert greatest(recording, 1) < 2 * math.pi


def test_it_speaks_a_hundred_times_a_second_and_is_tracked_at_twenty():
    recording = run(world="cart_pole", seconds=2, quiet=True)
    assert recording.topics["/joint_states"] == "sensor_msgs/msg/JointState"
    (command,) = recording.graph.subscriptions("/cart_effort")
    assert (command.node, command.type) == ("/cart_pole", "std_msgs/msg/Float64")
    assert [m.stamp for m in recording.messages("/joint_states")] == [t / 100 for t in range(201)]
    assert [m.stamp for m in recording.messages("/clock")] == [t / 20 for t in range(41)]
    joints = recording.messages("/joint_states")[-1].message
    assert (list(joints.name), since_start(joints.header.stamp)) == (["slider_joint", "pole_joint"], 2)
    assert (recording.path, list(recording.tracks)) == ([], ["cart", "pole"])
    x, angle, _, _ = received(recording)[-1]
    assert recording.tracks["cart"][-1] == (2.0, x, 0.0, 0.0)
    turned = math.remainder(angle + math.pi / 2, math.tau)
    assert recording.tracks["pole"][-1] == (2.0, x, 0.0, pytest.approx(turned))


def test_what_is_received_is_the_simulation_under_the_same_pushes():
    """One push at 0.1 s, which lasts for the timeout of 0.2 s."""
    recording = run(students.PushesOnce, world="cart_pole", seconds=1, seed=3, quiet=True)
    scene = simulate(World.load("cart_pole"), 3)
    for tick, state in enumerate(received(recording)):
        scene.advance(tick / 100)
        assert state == tuple(scene.state)
        if tick == 10:
            scene.command(1.0)


def test_an_effort_that_is_no_number_is_reported_once_a_second_and_ignored():
    recording = run(students.PushesNoNumber, world="cart_pole", seconds=2.5, quiet=True)
    words = "Efforts are finite numbers (N); this one was nan: check how it was calculated."
    assert logged(recording) == [(stamp, words) for stamp in (0.1, 1.1, 2.1)]
    assert {(line.level, line.node) for line in recording.logs} == {("ERROR", "cart_pole")}
    assert received(recording) == received(run(world="cart_pole", seconds=2.5, quiet=True))


def test_ten_thousand_efforts_a_second_are_all_received_and_reported_once_a_second():
    recording = run(students.Flood, world="cart_pole", seconds=1, quiet=True)
    assert (recording.ended.reason, recording.errors) == ("time", [])
    assert len(recording.messages("/cart_effort")) == 10_010
    words = "More than 1000 commands arrived in one second; 100 are enough: "
    words += "check the period of the timer that sends them."
    assert logged(recording) == [(0.05, words)]
