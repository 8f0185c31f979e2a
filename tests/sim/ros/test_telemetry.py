"""What a player tells in numbers: the robot's, and of one topic that somebody looks at."""

from dataclasses import replace

import pytest
from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_msgs.msg import String

from sim import World
from sim.world import LidarModel
from tests.sim.ros.playing import player, to_the_end, watched


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
def told():
    """The last state of a run for each topic that somebody looks at."""
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
def test_the_nearest_is_told_as_the_robot_sees_it_wherever_its_lidar_looks(yaw):
    room = World.load("room")
    still = replace(room, lidar=LidarModel(yaw=yaw, noise=0))
    made = player(lambda: Node("still"), world=still, seconds=2.0, speed=10.0)
    picture = watched(made)
    to_the_end(made)
    told = [dict(state["numbers"]).get("Nearest") for state in picture.states]
    assert [words for words in told if words][-1] == "1.37 m, at 0.44 rad"


def test_the_robots_numbers_are_told(told):
    numbers = dict(told[""]["numbers"])
    assert list(numbers) == ["Pose", "Speed", "Last command", "Nearest", "Bumper", "Goal"]
    assert numbers["Speed"] == "0.40 m/s, turning 0.50 rad/s"
    assert numbers["Last command"].startswith("0.40 m/s, turning 0.50 rad/s, 0.")
    assert numbers["Bumper"] == "free"
    assert numbers["Goal"].endswith(" m away")
    assert numbers["Nearest"].split(" m, at ")[0] > "0.5"


def test_nobody_looks_at_a_topic_until_somebody_does(told):
    assert told[""]["topic"] is told["/nowhere"]["topic"] is None


def test_a_topic_tells_its_type_its_newest_message_and_what_changes_over_time(told):
    topic = told["/odom"]["topic"]
    assert topic["type"] == "nav_msgs/msg/Odometry"
    assert "frame_id: odom" in topic["text"] and ", ... 36 in all]" in topic["text"]
    assert [curve["name"] for curve in topic["curves"]] == ["pose.pose.position.x", "pose.pose.position.y"]
    stamps = [stamp for stamp, _ in topic["curves"][0]["points"]]
    assert stamps == sorted(stamps) and stamps[-1] == topic["stamp"]


def test_numbers_that_never_change_are_drawn_too(told):
    topic = told["/cmd_vel"]["topic"]
    assert topic["text"].startswith("linear:\n  x: 0.4\n")
    assert {value for _, value in topic["curves"][0]["points"]} == {0.4}


def test_a_long_list_is_drawn_along_its_items(told):
    topic = told["/scan"]["topic"]
    (curve,) = topic["curves"]
    assert (curve["name"], curve["along"]) == ("ranges", "item")
    assert "ranges: [" in topic["text"] and ", ... 360 in all]" in topic["text"]


def test_words_are_told_and_not_drawn(told):
    assert told["/words"]["topic"]["text"] == "data: round"
    assert told["/words"]["topic"]["curves"] == []


def test_a_run_without_a_robot_has_no_numbers():
    made = player(Circle, seconds=1.0, speed=10.0)
    picture = watched(made)
    to_the_end(made)
    assert picture.states[-2]["numbers"] == []
