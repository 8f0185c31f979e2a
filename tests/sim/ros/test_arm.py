"""The arm as a ROS node: positions, frames, and goals of follow_joint_trajectory with all their ends."""

import math
from dataclasses import replace

import pytest
import rclpy

from sim import World, run
from sim.evidence import since_start
from sim.nanoseconds import EPOCH, SECOND
from tests.sim.ros.evidence import logged
from tests.students.machines import arm as students
from tests.students.machines.arm import following, goal, point

TICKS = [tick / 20 for tick in range(41)]
TOO_FAST = (point(0.2, (2.0, 0.0)),)  # 10 rad/s; the shoulder can do 1.5 rad/s


def received(recording):
    """{stamp: (shoulder, elbow, shoulder's rate, elbow's rate)} of every message on /joint_states."""
    states = [(received.stamp, received.message) for received in recording.messages("/joint_states")]
    return {stamp: (*joints.position, *joints.velocity) for stamp, joints in states}


def dialogue(program, seconds=6):
    recording = run(program, world="arm", seconds=seconds, quiet=True)
    assert (recording.errors, recording.stderr) == ([], "")
    return logged(recording)


def test_it_speaks_twenty_times_a_second_and_is_tracked():
    recording = run(world="arm", seconds=2, quiet=True)
    (command,) = recording.graph.subscriptions("/joint_commands")
    assert (command.node, command.type) == ("/arm", "std_msgs/msg/Float64MultiArray")
    for topic, type_ in (("/joint_states", "sensor_msgs/msg/JointState"), ("/tf", "tf2_msgs/msg/TFMessage")):
        assert recording.topics[topic] == type_
        assert [received.stamp for received in recording.messages(topic)] == TICKS
    assert list(recording.messages("/joint_states")[0].message.name) == students.JOINTS
    assert (recording.path, list(recording.tracks)) == ([], ["upper_arm", "forearm"])
    servers = [e for e in recording.graph.endpoints if e.kind == "action server"]
    assert [(e.node, e.name, e.type) for e in servers] == [
        ("/arm", "/arm_controller/follow_joint_trajectory", "control_msgs/action/FollowJointTrajectory")
    ]


def test_what_it_looks_like_is_kept_for_those_who_come_later():
    recording = run(world="arm", seconds=0.1, quiet=True)
    ((stamp, _, type_, *_, text),) = [
        (*h[:3], h.message.data) for h in recording.messages("/robot_description")
    ]
    assert (stamp, type_) == (0.0, "std_msgs/msg/String")
    assert text.startswith('<robot name="arm">') and '<limit lower="-2.4" upper="2.4"' in text
    (end,) = [end for end in recording.graph.publishers() if end.name == "/robot_description"]
    assert (end.qos["durability"], end.qos["depth"]) == ("transient_local", 1)


def test_joint_states_may_name_the_elbow_first():
    world = World.load("arm")
    mirrored = replace(world, machine=replace(world.machine, elbow_first=True))
    recording = run(students.Commander, world=mirrored, seconds=3, quiet=True)
    last = recording.messages("/joint_states")[-1].message
    assert list(last.name) == students.JOINTS[::-1]
    assert list(last.position) == [-0.5, 1.0]
    moving = recording.during(1.0).messages("/joint_states")[0].message
    assert moving.velocity[0] < 0 < moving.velocity[1]


def test_positions_are_gone_to_and_the_frames_follow():
    recording = run(students.Commander, world="arm", seconds=3, quiet=True)
    assert received(recording)[3.0] == (1.0, -0.5, 0.0, 0.0)
    upper, fore, tip = recording.messages("/tf")[-1].message.transforms
    for transform, frames, x, turn in (
        (upper, ("base_link", "upper_arm"), 0.0, 1.0),
        (fore, ("upper_arm", "forearm"), 0.5, -0.5),
        (tip, ("forearm", "tip"), 0.4, 0.0),
    ):
        assert (transform.header.frame_id, transform.child_frame_id) == frames
        assert (transform.transform.translation.x, transform.transform.translation.y) == (x, 0.0)
        rotation = transform.transform.rotation
        assert (rotation.z, rotation.w) == (math.sin(turn / 2), math.cos(turn / 2))
        assert since_start(transform.header.stamp) == 3.0
    assert recording.tracks["forearm"][-1] == pytest.approx((3, 0.5 * math.cos(1), 0.5 * math.sin(1), 0.5))


@pytest.mark.parametrize("commander", [students.ThreePositions, students.NoNumber])
def test_a_command_of_another_form_is_reported_and_ignored(commander):
    recording = run(commander, world="arm", seconds=1, quiet=True)
    words = "A command is one finite number (rad) for each of the 2 joints; "
    words += f"this one was {list(commander.positions)}: check how it was calculated."
    assert logged(recording) == [(0.5, words)]
    assert received(recording)[1.0] == (0.0, 0.0, 0.0, 0.0)


def test_a_goal_is_followed_and_succeeds_when_its_time_is_over():
    recording = run(students.Follower, world="arm", seconds=4, quiet=True)
    assert logged(recording) == [(0.0, "accepted"), (2.0, "SUCCEEDED 0 The goal was reached.")]
    joints = received(recording)
    assert joints[1.0] == pytest.approx((0.5, -0.5, 0.4, 0.0))
    assert joints[0.5] == pytest.approx((0.5 * 0.5 - 0.4 / 8, -0.25, 0.75 - 0.1, -0.75))
    assert joints[2.0] == joints[4.0] == pytest.approx((1.0, 0.0, 0.0, 0.0))


def test_feedback_comes_twenty_times_a_second_with_desired_actual_and_error():
    recording = run(students.Reporter, world="arm", seconds=4, quiet=True)
    feedback = [(stamp, text) for stamp, text in logged(recording) if text.startswith(tuple("0123456789"))]
    assert [stamp for stamp, _ in feedback] == TICKS[1:]
    assert feedback[19] == (
        1.0, "1 ['shoulder_joint', 'elbow_joint'] "
        "[[0.5, -0.5, 0.4, 0.0], [0.5, -0.5, 0.4, 0.0], [0.0, 0.0, 0.0, 0.0]]",
    )  # fmt: skip


def test_a_main_waits_for_the_result_line_by_line():
    recording = run(students.waiting_client, world="arm", seconds=9, quiet=True)
    assert logged(recording) == [(2.0, "The goal was reached.")]
    assert (recording.ended.reason, recording.stamp) == ("finished", 3.0)


def test_joints_may_be_named_in_any_order():
    swapped = goal(point(1.0, (0.3, 0.6)), names=students.JOINTS[::-1])
    recording = run(following((0.0, swapped)), world="arm", seconds=3, quiet=True)
    assert received(recording)[3.0][:2] == (0.6, 0.3)


def test_a_canceled_goal_stops_the_arm_at_once_and_holds_it():
    recording = run(following((0.0, students.STEADY), cancel_after=0.5), world="arm", seconds=4, quiet=True)
    assert logged(recording) == [
        (0.0, "accepted"), (0.5, "CANCELED 0 The goal was canceled; the arm stops and stays."),
    ]  # fmt: skip
    joints = received(recording)
    shoulder, _, speed, _ = joints[0.5]
    assert joints[1.0] == joints[4.0]
    assert joints[4.0][0] == pytest.approx(shoulder + speed**2 / (2 * 4.0), abs=1e-6)
    assert joints[4.0][2:] == (0.0, 0.0)


def test_a_newer_goal_takes_over_from_where_the_arm_is():
    back = goal(point(1.0, (0.0, 0.0), (0.0, 0.0)))
    recording = run(following((0.0, students.STEADY), (0.5, back)), world="arm", seconds=4, quiet=True)
    assert logged(recording) == [
        (0.0, "accepted"), (0.5, "ABORTED -1 The goal was replaced by a newer one."), (0.5, "accepted"),
        (1.5, "SUCCEEDED 0 The goal was reached."),
    ]  # fmt: skip
    joints = received(recording)
    assert abs(joints[0.55][0] - joints[0.5][0]) < 1.5 * 0.05
    assert joints[4.0] == pytest.approx((0.0, 0.0, 0.0, 0.0))


def test_a_command_on_the_topic_takes_over_too():
    recording = run(students.Follower, students.Commander, world="arm", seconds=4, quiet=True)
    assert logged(recording) == [
        (0.0, "accepted"), (0.5, "ABORTED -1 The goal was replaced by a command on /joint_commands."),
    ]  # fmt: skip
    assert received(recording)[4.0] == (1.0, -0.5, 0.0, 0.0)


def test_leaving_the_path_tolerance_aborts_and_stops():
    message = goal(*TOO_FAST, path=[("shoulder_joint", 0.3)])
    recording = run(following((0.0, message)), world="arm", seconds=3, quiet=True)
    ((_, first), (stamp, end)) = logged(recording)
    assert (first, stamp) == ("accepted", 0.05)
    assert end == (
        "ABORTED -4 0.05 s after the beginning shoulder_joint was 0.495 rad off its path; "
        "its tolerance is 0.3 rad."
    )
    assert received(recording)[3.0][0] < 0.1


def test_not_being_at_the_goal_in_time_aborts():
    message = goal(*TOO_FAST, end=[("shoulder_joint", 0.2)], patience=0.5)
    assert dialogue(following((0.0, message))) == [
        (0.0, "accepted"),
        (0.7, "ABORTED -5 0.5 s after the end shoulder_joint was 1.23 rad from its goal; "
              "its tolerance is 0.2 rad."),
    ]  # fmt: skip


def test_an_arm_that_still_moves_at_the_end_has_not_arrived():
    """After 0.3 s the shoulder does 0.3 * 4 rad/s."""
    message = goal(*TOO_FAST, end=[("shoulder_joint", 3.0)], patience=0.1)
    assert dialogue(following((0.0, message)))[-1] == (
        0.3, "ABORTED -5 0.1 s after the end the arm was still moving, at 1.2 rad/s.",
    )  # fmt: skip


@pytest.mark.parametrize("cancel_after", [1.95, 2.0, 2.05])
def test_a_cancel_at_the_very_end_is_no_fault(cancel_after):
    logged = dialogue(following((0.0, students.STEADY), cancel_after=cancel_after))
    end = "CANCELED 0 The goal was canceled; the arm stops and stays."
    if cancel_after > 1.95:
        end = "SUCCEEDED 0 The goal was reached."
    assert logged == [(0.0, "accepted"), (min(cancel_after, 2.0), end)]


def test_a_goal_that_was_just_replaced_cannot_be_canceled():
    assert dialogue(students.ChangesItsMind) == [
        (0.0, "accepted"), (0.5, "ABORTED -1 The goal was replaced by a newer one."), (0.5, "canceling 0"),
        (0.5, "accepted"), (2.5, "SUCCEEDED 0 The goal was reached."),
    ]  # fmt: skip


def test_without_a_time_tolerance_a_late_arm_may_arrive():
    """2 rad at 1.5 rad/s and 4 rad/s^2: 1.71 s."""
    assert dialogue(following((0.0, goal(*TOO_FAST)))) == [
        (0.0, "accepted"), (1.75, "SUCCEEDED 0 The goal was reached."),
    ]  # fmt: skip


def test_a_trajectory_can_be_stamped_for_later():
    message = goal(point(1.0, (0.5, 0.5), (0.0, 0.0)))
    message.trajectory.header.stamp.sec = EPOCH // SECOND + 2
    recording = run(following((0.0, message)), world="arm", seconds=4, quiet=True)
    assert logged(recording) == [(0.0, "accepted"), (3.0, "SUCCEEDED 0 The goal was reached.")]
    assert received(recording)[2.0] == (0.0, 0.0, 0.0, 0.0)


LIMITS = "its limits are -2.4 and 2.4 rad."
REFUSALS = {
    "other names": (
        goal(point(1.0, (0.0, 0.0)), names=["shoulder", "elbow"]),
        "INVALID_JOINTS: its joint_names are ['shoulder', 'elbow']; "
        "name each of shoulder_joint, elbow_joint once, in any order.",
    ),
    "one name": (
        goal(point(1.0, (0.0,)), names=["elbow_joint"]),
        "INVALID_JOINTS: its joint_names are ['elbow_joint']; "
        "name each of shoulder_joint, elbow_joint once, in any order.",
    ),
    "no points": (
        goal(),
        "INVALID_GOAL: it has no points; give it at least one, with positions and time_from_start.",
    ),
    "another length": (
        goal(point(1.0, (0.0, 0.0)), point(2.0, (0.0, 0.0, 0.0))),
        "INVALID_GOAL: the positions of point 2 are [0.0, 0.0, 0.0]; "
        "give one finite number (rad) for each joint.",
    ),
    "no positions": (
        goal(point(1.0, ())),
        "INVALID_GOAL: the positions of point 1 are []; give one finite number (rad) for each joint.",
    ),
    "nan": (
        goal(point(1.0, (0.0, math.nan))),
        "INVALID_GOAL: the positions of point 1 are [0.0, nan]; give one finite number (rad) for each joint.",
    ),
    "too few velocities": (
        goal(point(1.0, (0.0, 0.0), (0.0,))),
        "INVALID_GOAL: the velocities of point 1 are [0.0]; "
        "give none, or one finite number (rad/s) for each joint.",
    ),
    "infinite velocity": (
        goal(point(1.0, (0.0, 0.0), (0.0, math.inf)), point(2.0, (0.0, 0.0))),
        "INVALID_GOAL: the velocities of point 1 are [0.0, inf]; "
        "give none, or one finite number (rad/s) for each joint.",
    ),
    "times that do not rise": (
        goal(point(1.0, (0.0, 0.0)), point(1.0, (0.1, 0.0))),
        "INVALID_GOAL: time_from_start of point 2 is 1 s; make it more than 1 s, that of point 1.",
    ),
    "a time before the start": (
        goal(point(-1.0, (0.0, 0.0))),
        "INVALID_GOAL: time_from_start of point 1 is -1 s; make it 0 or more.",
    ),
    "beyond a limit": (
        goal(point(1.0, (0.0, 2.5))),
        f"INVALID_GOAL: point 1 has elbow_joint at 2.5 rad; {LIMITS}",
    ),
    "beyond a limit on the way": (
        goal(point(1.0, (0.0, 0.0), (0.0, -3.0)), point(2.0, (0.0, 0.0))),
        "INVALID_GOAL: point 1 has elbow_joint at -3 rad/s; its limit is 2 rad/s.",
    ),
    "a moving end": (
        goal(point(1.0, (0.0, 0.0), (0.1, 0.0))),
        "INVALID_GOAL: its last point has velocities; the arm stays there, so make them 0 or leave them out.",
    ),
    "a tolerance for another joint": (
        goal(point(1.0, (0.0, 0.0)), end=[("wrist_joint", 0.1)]),
        "INVALID_JOINTS: goal_tolerance names 'wrist_joint'; the joints are shoulder_joint, elbow_joint.",
    ),
    "a tolerance that is not a number": (
        goal(point(1.0, (0.0, 0.0)), path=[("elbow_joint", math.nan)]),
        "INVALID_GOAL: path_tolerance of elbow_joint is nan; give a number of radians.",
    ),
}


@pytest.mark.parametrize("name", REFUSALS)
def test_a_goal_that_cannot_be_followed_is_rejected_with_the_reason(name):
    message, reason = REFUSALS[name]
    assert dialogue(following((0.5, message)), 2) == [(0.5, f"Goal rejected, {reason}"), (0.5, "rejected")]


def test_a_trajectory_that_is_over_by_its_stamp_is_rejected():
    message = goal(point(0.5, (0.0, 0.0)))
    message.trajectory.header.stamp.sec = EPOCH // SECOND + 1
    assert dialogue(following((3.0, message)), 4) == [
        (3.0, "Goal rejected, OLD_HEADER_TIMESTAMP: by its header.stamp it ended 1.5 s ago; "
              "give it a stamp of 0 to begin at once."),
        (3.0, "rejected"),
    ]  # fmt: skip


def test_a_rejected_goal_leaves_the_one_under_way_alone():
    program = following((0.0, students.STEADY), (0.5, goal()))
    assert [text for _, text in dialogue(program)][-1] == "SUCCEEDED 0 The goal was reached."


def test_a_tolerance_below_zero_means_any():
    message = goal(*TOO_FAST, end=[("shoulder_joint", -1.0)], patience=2.0)
    assert dialogue(following((0.0, message)))[-1][1] == "SUCCEEDED 0 The goal was reached."


def test_a_client_that_goes_away_leaves_the_arm_to_its_goal():
    def leaves():
        rclpy.init()
        node = students.Follower()
        rclpy.spin_once(node)
        node.destroy_node()
        rclpy.shutdown()

    recording = run(leaves, students.Reporter, world="arm", seconds=6, quiet=True)
    assert recording.errors == []
    assert received(recording)[6.0] == pytest.approx((1.0, 0.0, 0.0, 0.0))
