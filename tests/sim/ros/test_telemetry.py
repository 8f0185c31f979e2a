"""The numbers that a player shows: of the robot, and of one selected topic."""

from dataclasses import replace

import pytest
from geometry_msgs.msg import Twist
from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import String

from sim import World
from sim.world import LidarModel
from tests.sim.ros.playing import player, to_the_end, watched
from tests.students.machines.arm import ThreePositions


class Circle(Node):
    def __init__(self):
        super().__init__("circle")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.words = self.create_publisher(String, "words", 10)
        self.create_timer(0.1, self.tick)

    def tick(self):
        twist = Twist()
        twist.linear.x, twist.angular.z = 0.4, 0.5
        self.publisher.publish(twist)
        self.words.publish(String(data="round"))


@pytest.fixture(scope="module")
def states():
    """The last state of a run, by selected topic."""
    states = {}
    for topic in ("", "/cmd_vel", "/odom", "/scan", "/words", "/nowhere"):
        made = player(Circle, world="room", seconds=2.0, speed=10.0)
        picture = watched(made)
        picture.on_command({"topic": topic})
        to_the_end(made)
        running = [state for state in picture.states if state["ended"] is None]
        states[topic] = running[-1]
    return states


@pytest.mark.parametrize("yaw", [0.0, 1.0])
def test_the_nearest_hit_is_in_the_robot_s_frame_whatever_the_lidar_s_yaw(yaw):
    room = World.load("room")
    still = replace(room, lidar=LidarModel(yaw=yaw, noise=0))
    made = player(lambda: Node("still"), world=still, seconds=2.0, speed=10.0)
    picture = watched(made)
    to_the_end(made)
    (*_, last) = [numbers for state in picture.states if "nearest" in (numbers := dict(state["numbers"]))]
    assert (last["nearest"], last["at"]) == ("1.37 m", "0.44 rad")


def test_the_robot_s_numbers_are_shown(states):
    numbers = dict(states[""]["numbers"])
    pose, commands = ["x", "y", "yaw", "v", "ω"], ["command v", "command ω"]
    assert list(numbers) == [*pose, *commands, "nearest", "at", "bumper", "goal", "contacts"]
    assert (numbers["v"], numbers["ω"]) == ("0.40 m/s", "0.50 rad/s")
    assert (numbers["command v"], numbers["command ω"]) == ("0.40 m/s", "0.50 rad/s")
    assert (numbers["bumper"], numbers["contacts"]) == ("free", "none")
    assert numbers["goal"].endswith(" m") and numbers["yaw"].endswith(" rad")
    assert numbers["nearest"] > "0.5"


def test_no_topic_is_selected_at_first(states):
    assert states[""]["topic"] is states["/nowhere"]["topic"] is None


def test_a_topic_shows_its_type_its_newest_message_and_changing_values(states):
    topic = states["/odom"]["topic"]
    assert topic["type"] == "nav_msgs/msg/Odometry"
    assert "frame_id: odom" in topic["text"] and ", ... 36 in all]" in topic["text"]
    assert [curve["name"] for curve in topic["curves"]] == ["pose.pose.position.x", "pose.pose.position.y"]
    stamps = [stamp for stamp, _ in topic["curves"][0]["points"]]
    assert stamps == sorted(stamps) and stamps[-1] == topic["stamp"]


def test_numbers_that_never_change_are_drawn_too(states):
    topic = states["/cmd_vel"]["topic"]
    assert topic["text"].startswith("linear:\n  x: 0.4\n")
    assert {value for _, value in topic["curves"][0]["points"]} == {0.4}


def test_a_long_list_is_drawn_along_its_items(states):
    topic = states["/scan"]["topic"]
    (curve,) = topic["curves"]
    assert (curve["name"], curve["along"]) == ("ranges", "item")
    assert "ranges: [" in topic["text"] and ", ... 360 in all]" in topic["text"]


def test_texts_are_shown_and_not_plotted(states):
    assert states["/words"]["topic"]["text"] == "data: round"
    assert states["/words"]["topic"]["curves"] == []


def test_a_run_without_a_robot_has_no_numbers():
    made = player(Circle, seconds=1.0, speed=10.0)
    picture = watched(made)
    to_the_end(made)
    assert picture.states[-2]["numbers"] == []


def test_a_machine_shows_its_joints():
    made = player(lambda: Node("still"), world="cart_pole", seconds=1.0, speed=10.0)
    picture = watched(made)
    to_the_end(made)
    (numbers,) = {tuple(dict(state["numbers"])) for state in picture.states if state["numbers"]}
    assert numbers == ("slider_joint", "pole_joint")
    units = {value.split()[1] for state in picture.states for _, value in state["numbers"]}
    assert units == {"m", "rad"}


class Rams(Circle):
    """Drives into the wall ahead, after 20 s back for 2 s, and stops."""

    ticks = 0

    def tick(self):
        self.ticks += 1
        twist = Twist()
        twist.linear.x = 0.5 if self.ticks < 200 else -0.2 if self.ticks < 220 else 0.0
        self.publisher.publish(twist)


def test_a_contact_shows_as_long_as_it_lasts_and_shortly_after():
    made = player(Rams, world="room", seconds=30.0, speed=10.0)
    picture = watched(made)
    to_the_end(made)
    (touch, *_) = made.recording.contacts
    states = [(state["stamp"], state["touching"]) for state in picture.states if state["ended"] is None]
    assert not any(touching for stamp, touching in states if stamp < touch.stamp)
    assert all(touching for stamp, touching in states if touch.stamp + 0.2 < stamp < 20.0)
    assert not any(touching for stamp, touching in states if stamp > 25.0)
    assert dict(picture.states[-2]["numbers"])["contacts"].startswith("1, at ")


class Gripper(Node):
    """Another driver that publishes on /joint_states, of its own joint only."""

    def __init__(self):
        super().__init__("gripper")
        publisher = self.create_publisher(JointState, "/joint_states", 10)
        state = JointState(name=["gripper_joint"], position=[0.04])
        self.create_timer(0.13, lambda: publisher.publish(state))


def test_joints_are_drawn_by_their_names():
    made = player(ThreePositions, Gripper, world="arm", seconds=6.0, speed=10.0)
    picture = watched(made)
    picture.on_command({"topic": "/joint_states"})
    to_the_end(made)
    curves = [state["topic"]["curves"] for state in picture.states if state["topic"]][-1]
    assert {curve["name"] for curve in curves} == {"elbow_joint position", "shoulder_joint position"}
    assert all(len(curve["points"]) > 10 for curve in curves)
