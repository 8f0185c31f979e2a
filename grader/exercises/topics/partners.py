"""Nodes of ours for 02_topics: some talk to the student's node, one is there for the student to start."""

from __future__ import annotations

import random

from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node
from std_msgs.msg import Bool, Float64, String

COMMANDS = ("stand", "walk", "stop")
# The first hold a command inside another word: whoever only looks for letters takes them for it.
LOOKALIKES = ("moonwalk", "standby", "nonstop", "sidewalk")
OTHER_WORDS = ("dance", "jump", "sing", "swim", "sleep", "climb", "hide")


class CommandSender(Node):
    """Sends words (String) on /robot/command, one a second.

    They are each of the three commands twice, and three other words. Order and words come from the seed of
    the run.
    """

    def __init__(self) -> None:
        super().__init__("command_sender")
        self.publisher = self.create_publisher(String, "/robot/command", 10)
        self.words = [*COMMANDS, *COMMANDS, random.choice(LOOKALIKES), *random.sample(OTHER_WORDS, 2)]
        random.shuffle(self.words)
        self.create_timer(1.0, self.send)

    def send(self) -> None:
        """Send the next word, as long as there is one."""
        if self.words:
            self.publisher.publish(String(data=self.words.pop()))


class Chatterbox(Node):
    """Sends a word on /chatter0, a number on /chatter1 and a yes or no on /chatter2, at rates of their own.

    The values come from the run's seed. The first is sent after 0.5 s.
    """

    def __init__(self) -> None:
        super().__init__("chatterbox")
        self.words = self.create_publisher(String, "/chatter0", 10)
        self.numbers = self.create_publisher(Float64, "/chatter1", 10)
        self.answers = self.create_publisher(Bool, "/chatter2", 10)
        self.create_timer(1.0, lambda: self.words.publish(String(data=random.choice(OTHER_WORDS))))
        self.create_timer(1.3, lambda: self.numbers.publish(Float64(data=random.randint(10, 99) + 0.5)))
        self.create_timer(1.7, lambda: self.answers.publish(Bool(data=random.random() < 0.5)))


class OneMetre(Node):
    """Drives one metre straight on: Twist on `velocity` until Odometry on `pose` says that it's there.

    It was written for another robot, where the topics have these names.
    """

    def __init__(self) -> None:
        super().__init__("one_metre")
        self.x = 0.0  # metres, frame odom
        self.publisher = self.create_publisher(Twist, "velocity", 10)
        self.create_subscription(Odometry, "pose", self.on_pose, 10)
        self.create_timer(0.1, self.drive)

    def on_pose(self, msg: Odometry) -> None:
        """Remember how far the robot has come."""
        self.x = msg.pose.pose.position.x

    def drive(self) -> None:
        """Forward, until the metre is done."""
        msg = Twist()
        msg.linear.x = 0.3 if self.x < 0.97 else 0.0
        self.publisher.publish(msg)
