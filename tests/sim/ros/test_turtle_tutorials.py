"""Programs as the official tutorials have them beside turtlesim: tf2's broadcasters and followers."""

import math

import pytest

from sim import Process, run
from tests.sim.ros.evidence import logged
from tests.students.engine import turtles

MIDDLE = 5.544444561004639
TELL = [
    Process(turtles.Broadcaster, name=f"broadcaster{number}", parameters={"turtlename": f"turtle{number}"})
    for number in (1, 2)
]
TO_CARROT = Process(turtles.Follower, parameters={"target_frame": "carrot1"})


def in_pond(*programs, seconds=15):
    recording = run(*TELL, *programs, world="turtlesim", seconds=seconds, quiet=True)
    assert (recording.ended.reason, recording.errors) == ("time", [])
    return recording


def last(recording, name):
    return recording.tracks[name][-1][1:3]


def test_a_driver_swims_in_circles():
    recording = in_pond(turtles.Driver, seconds=10)
    poses = [pose for pose in recording.path if pose.stamp > 1.0]
    center = poses[0].x - 2 * math.sin(poses[0].yaw), poses[0].y + 2 * math.cos(poses[0].yaw)
    assert all(math.dist(pose[1:3], center) == pytest.approx(2.0, abs=0.02) for pose in poses)


def test_a_follower_comes_to_the_turtle():
    recording = in_pond(turtles.Follower)
    assert last(recording, "turtle2") == pytest.approx((5.543863130784561, 5.542526930140358), abs=1e-6)
    assert "Spawning turtle [turtle2] at x=[4.000000], y=[2.000000], theta=[0.000000]" in [
        text for _, text in logged(recording)
    ]


def test_a_follower_comes_to_a_carrot_that_stands_beside_the_turtle():
    recording = in_pond(turtles.Carrot, TO_CARROT)
    assert last(recording, "turtle2") == pytest.approx((5.544001267423232, 7.542353485431651), abs=1e-6)


def test_a_follower_runs_after_a_carrot_that_moves():
    recording = in_pond(Process(turtles.Carrot, parameters={"moves": True}), TO_CARROT)
    assert last(recording, "turtle2") == pytest.approx((6.430766035276113, 5.993904711985892), abs=1e-6)
    late = [pose for pose in recording.tracks["turtle2"] if pose.stamp > 10]
    reach = [math.dist(pose[1:3], (MIDDLE, MIDDLE)) for pose in late]
    assert 0.9 < min(reach) < max(reach) < 1.1  # half as far as the carrot, after which it always is


@pytest.mark.parametrize(("follower", "starts"), [(turtles.Follower, 15.2), (turtles.LateFollower, 20.2)])
def test_a_follower_with_a_delay_of_5_s_goes_to_where_the_turtle_was(follower, starts):
    recording = in_pond(turtles.Nudge, follower, seconds=22)
    begins = [
        received.stamp
        for received in recording.messages("/turtle2/cmd_vel")
        if received.stamp > 14.5 and received.message.linear.x > 0.1
    ]
    assert begins[0] == pytest.approx(starts)
