"""The joint as a ROS node, and nodes that move it."""

import itertools

import pytest

from sim import run
from sim.evidence import since_start
from sim.world import World
from tests.sim.ros.evidence import logged
from tests.students.machines import joint as students

MODEL = World.load("joint").machine
TICKS = [tick / 20 for tick in range(41)]


def received(recording):
    """Stamp, angle and rate of every message on /joint_states."""
    joints = [(received.stamp, received.message) for received in recording.messages("/joint_states")]
    return [(stamp, joint.position[0], joint.velocity[0]) for stamp, joint in joints]


@pytest.fixture(scope="module")
def seven():
    return run(students.Seven, world="joint", seconds=20, quiet=True)


def test_it_speaks_twenty_times_a_second_and_is_tracked():
    recording = run(world="joint", seconds=2, quiet=True)
    assert recording.topics["/joint_states"] == "sensor_msgs/msg/JointState"
    (command,) = recording.graph.subscriptions("/joint_commands")
    assert (command.node, command.type) == ("/joint", "std_msgs/msg/Float64")
    for topic in ("/joint_states", "/clock"):
        assert [received.stamp for received in recording.messages(topic)] == TICKS
    (joint, *_) = [received.message for received in recording.messages("/joint_states")][-1:]
    assert (list(joint.name), since_start(joint.header.stamp), joint.header.frame_id) == (["joint"], 2, "")
    assert (recording.path, list(recording.tracks)) == ([], ["link"])
    assert [pose.stamp for pose in recording.tracks["link"]] == TICKS


def test_it_goes_to_each_position_cut_to_its_limits(seven):
    places = {stamp: angle for stamp, angle, _ in received(seven)}
    reached = [places[2.0 * number + 1.95] for number in (1, 2, 3, 4, 7)]
    assert reached == [0.5, -0.5, 1.5, 2.0, 0.0]
    # 4 rad take 4 / 1.5 + 1.5 / 3 = 3.2 s, so after 2 s it turns back on the way, braking from 1.5 rad/s
    assert places[12.0] == pytest.approx(2.0 - 1.5**2 / (2 * 3) - 1.5 * 1.5)
    assert min(places.values()) == pytest.approx(places[12.0] - 1.5**2 / (2 * 3))
    assert max(abs(rate) for _, _, rate in received(seven)) == 1.5


def test_the_profile_on_the_topic_is_the_trapezoid(seven):
    """From 2 s on to 0.5: 0.5 s up to speed and at once down again, peak sqrt(0.5 * 3) rad/s."""
    profile = {stamp: (angle, rate) for stamp, angle, rate in received(seven)}
    assert profile[2.0] == (0.0, 0.0)
    assert profile[2.4] == pytest.approx((3 * 0.4**2 / 2, 1.2))
    assert profile[2.85] == (0.5, 0.0)


@pytest.mark.parametrize("program", [students.seven_and_done, students.SevenThenGone])
def test_a_program_that_ends_leaves_the_joint_at_its_last_command(program):
    recording = run(program, world="joint", seconds=30, quiet=True)
    assert len(recording.messages("/joint_commands")) == 7
    assert (recording.ended.reason, recording.errors) == ("finished", [])
    assert recording.stamp == 15.0


def test_new_positions_midway_keep_to_the_limits():
    recording = run(students.Swinger, world="joint", seconds=20, quiet=True)
    joints = received(recording)
    assert all(MODEL.lower <= angle <= MODEL.upper and abs(rate) <= 1.5 for _, angle, rate in joints)
    steps = [abs(b[2] - a[2]) for a, b in itertools.pairwise(joints)]
    assert max(steps) <= MODEL.max_acceleration * 0.05 + 1e-9


def test_a_command_that_is_no_number_is_reported_once_a_second_and_ignored():
    recording = run(students.NoNumber, world="joint", seconds=2.5, quiet=True)
    words = "Joint commands are finite numbers (rad); this one was inf: check how it was calculated."
    assert logged(recording) == [(stamp, words) for stamp in (0.1, 1.1, 2.1)]
    assert {(line.level, line.node) for line in recording.logs} == {("ERROR", "joint")}
    assert (recording.errors, received(recording)[-1]) == ([], (2.5, 0.0, 0.0))


def test_ten_thousand_commands_a_second_are_all_received_and_reported_once_a_second():
    recording = run(students.Flood, world="joint", seconds=2, quiet=True)
    assert (recording.ended.reason, recording.errors) == ("time", [])
    assert len(recording.messages("/joint_commands")) == 20_001
    words = "More than 1000 commands arrived in one second; 100 are enough: "
    words += "check the period of the timer that sends them."
    assert logged(recording) == [(stamp, words) for stamp in (0.05, 1.05)]
    assert received(recording)[-1] == (2.0, 1.0, 0.0)
