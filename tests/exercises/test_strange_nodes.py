"""Nodes that say what is not a number, too little, or all at once and then nothing: no broken check."""

import dataclasses
import math
from typing import NamedTuple

import pytest
from geometry_msgs.msg import PointStamped, PoseStamped, Twist
from nav_msgs.msg import OccupancyGrid, Odometry, Path
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import Imu
from std_msgs.msg import Float64

from grader import Missed
from grader.exercises import guarding, navigator
from grader.exercises.guarding.gyro import does_not_drift
from grader.exercises.navigator.costmap import answers_clicks
from grader.exercises.navigator.plan import answers_a_goal
from grader.programs import LocalPrograms
from sim.evidence import Ended, Graph
from tests.exercises.assignment import first_run
from tests.exercises.score_tables import misses, students
from tests.sim.recordings import published

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def point(value):
    msg = PointStamped()
    msg.point.x = msg.point.y = value
    return msg


def path(value):
    """From the robot to the goal of the first world, by way of nowhere where value is not a number."""
    world, msg = navigator.world_of("room", 3), Path()
    msg.header.frame_id = "map"
    for x, y in (world.start[:2], (value, value), world.goal):
        pose = PoseStamped()
        pose.pose.position.x, pose.pose.position.y = x, y
        msg.poses.append(pose)
    return msg


class Says(NamedTuple):
    """What an exercise's node listens to, with the profile; what it publishes; a number that is none."""

    receives: tuple
    topics: dict
    strange: float
    for_being_there: float  # points


BOTH = dict.fromkeys(("/goal/distance", "/goal/bearing"), Float64)
NODES = {
    guarding.heading: Says(("/odom", Odometry, 10), {"/heading": Float64}, math.inf, 2.0),
    guarding.gyro: Says(("/imu/data", Imu, 10), {"/heading": Float64}, math.inf, 3.0),
    navigator.compass: Says(("/odom", Odometry, 10), BOTH, math.inf, 2.0),
    navigator.costmap: Says(("/map", OccupancyGrid, LATCHED), {"/cell_center": PointStamped}, math.nan, 1.0),
    navigator.plan: Says(("/goal_pose", PoseStamped, 10), {"/plan": Path}, math.nan, 3.0),
}
MAKE = {Float64: lambda value: Float64(data=value), PointStamped: point, Path: path}


class Sayer(Node):
    def __init__(self, exercise):
        super().__init__("sayer")
        (topic, type_, profile), says, *_ = NODES[exercise]
        self.create_subscription(type_, topic, lambda msg: None, profile)
        self.outlets = [(self.create_publisher(kind, topic, 10), MAKE[kind]) for topic, kind in says.items()]

    def say(self, value, times=1):
        for publisher, make in self.outlets * times:
            publisher.publish(make(value))


def always(exercise, value):
    class Always(Sayer):
        def __init__(self):
            super().__init__(exercise)
            self.create_timer(0.05, lambda: self.say(value))

    return Always


def at_once(exercise):
    class AtOnce(Sayer):
        def __init__(self):
            super().__init__(exercise)
            self.say(0.0, times=60)

    return AtOnce


def earned(score):
    assert score.broken == []
    return float(score)


@pytest.mark.parametrize("exercise", NODES, ids=lambda exercise: exercise.name)
def test_what_is_no_number_is_wrong(exercise):
    assert (
        earned(exercise.grade(always(exercise, NODES[exercise].strange))) == NODES[exercise].for_being_there
    )


def test_who_says_all_at_once_should_go_on():
    score = guarding.heading.grade(at_once(guarding.heading))
    assert earned(score) == NODES[guarding.heading].for_being_there
    assert [tuple(miss) for miss in misses(score)] == [(
        "It is the robot's yaw in degrees: 0 along x, 90 to the left, -90 to the right.",
        "messages on /heading until the end, at 20 s",
        "the last one at 0 s",
        "Publish from start to end, in a callback that is called again and again.",
    )]  # fmt: skip


def test_who_never_lets_the_robot_get_free_is_reported():
    class TurnsToTheWall(students("guarding", "guard")["Guard"]):
        left = 14

        def decide(self):
            self.left -= 1
            command = Twist()
            command.angular.z = -3.0 if self.left > 0 else 0.0
            self.publisher.publish(command)

    score = first_run(guarding.guard).judge(LocalPrograms([TurnsToTheWall]), "an instructor's")
    assert earned(score) == 3.0
    assert [tuple(miss)[1:] for miss in misses(score)] == [(
        "0.5 s or more in which all is well and 1 m ahead are clear",
        "0.0 s: the robot never gets there",
        "The driver turns the robot away from walls and drives on: its commands have to get through.",
    )]  # fmt: skip


def test_a_costmap_has_as_many_cells_as_its_map():
    class Short(Node):
        def __init__(self):
            super().__init__("short")
            self.publisher = self.create_publisher(OccupancyGrid, "/global_costmap/costmap", LATCHED)
            self.create_subscription(OccupancyGrid, "/map", self.on_map, LATCHED)

        def on_map(self, msg):
            msg.data = msg.data[:-5]
            self.publisher.publish(msg)

    score = navigator.costmap.grade(Short)
    assert earned(score) == 1.0
    assert misses(score)[0][1:3] == ("17325 cells in data", "17320 cells in data")


@pytest.mark.parametrize(
    ("check", "handed", "due"),
    [
        (does_not_drift, [[(0.0, 0.0)]], "headings from 20 s on"),
        (answers_clicks, [OccupancyGrid()], "messages on /clicked_point"),
        (answers_a_goal, [], "goals on /goal_pose"),
    ],
    ids=lambda value: getattr(value, "name", ""),
)
def test_a_run_that_hangs_before_there_is_something_to_judge_misses(check, handed, due):
    received = [published("/cell_center", [(0.0, PointStamped())]), published("/plan", [(0.0, Path())])]
    cut = dataclasses.replace(
        received[0],
        published=[*received[0].published, *received[1].published],
        graph=Graph(["/talker"], [*received[0].graph.endpoints, *received[1].graph.endpoints]),
        ended=Ended("hang", 0.2, "The callback tick never returned."),
    )
    with pytest.raises(Missed) as caught:
        check(cut, *handed)
    assert caught.value.expected == f"a run that lasts until there are {due}"
    assert caught.value.saw == "The callback tick never returned."
