"""Publishers of commands for a robot, and of values of three types."""

import random

from rclpy.node import Node
from std_msgs.msg import Bool, Float64, String

COMMANDS = ("stand", "walk", "stop")
# The first hold a command inside another word: searching for its letters finds it there.
LOOKALIKES = ("moonwalk", "standby", "nonstop", "sidewalk")
OTHER_WORDS = ("dance", "jump", "sing", "swim", "sleep", "climb", "hide")


class CommandSender(Node):
    """Sends words (String) on /robot/command, one a second: each command twice, and three other words."""

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
    """Sends a word on /chatter0, a number on /chatter1 and a yes or no on /chatter2, each at its own rate."""

    def __init__(self) -> None:
        super().__init__("chatterbox")
        self.words = self.create_publisher(String, "/chatter0", 10)
        self.numbers = self.create_publisher(Float64, "/chatter1", 10)
        self.answers = self.create_publisher(Bool, "/chatter2", 10)
        self.create_timer(1.0, lambda: self.words.publish(String(data=random.choice(OTHER_WORDS))))
        self.create_timer(1.3, lambda: self.numbers.publish(Float64(data=random.randint(10, 99) + 0.5)))
        self.create_timer(1.7, lambda: self.answers.publish(Bool(data=random.random() < 0.5)))
