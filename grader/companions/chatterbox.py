"""Publishes values of three types on three topics."""

import random

from rclpy.node import Node
from std_msgs.msg import Bool, Float64, String

from grader.companions.command_sender import OTHER_WORDS


class Chatterbox(Node):
    """Sends a word on /chatter0, a number on /chatter1 and a yes or no on /chatter2, each at its own rate."""

    def __init__(self) -> None:
        super().__init__("chatterbox")
        self.words = self.create_publisher(String, "/chatter0", 10)
        self.numbers = self.create_publisher(Float64, "/chatter1", 10)
        self.answers = self.create_publisher(Bool, "/chatter2", 10)
        self.create_timer(1.0, lambda: self.words.publish(String(data=random.choice(OTHER_WORDS))))
        self.create_timer(1.3, lambda: self.numbers.publish(Float64(data=random.randint(10, 99) + 0.5)))
        self.create_timer(1.7, lambda: self.answers.publish(Bool(data=random.random() < 0.5)))
