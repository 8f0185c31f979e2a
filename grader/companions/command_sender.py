"""Publishes commands for a robot, and words that only look like one."""

import random

from rclpy.node import Node
from std_msgs.msg import String

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
