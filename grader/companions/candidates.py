"""Sends right and wrong files to the program that runs a package's tests on them."""

import random
from collections.abc import Iterable, Sequence

from rclpy.node import Node
from std_msgs.msg import String

from grader.companions.qos import LATCHED
from grader.companions.test_runner import CANDIDATES, VERDICTS


def in_order(name: str, seed: int, right: Iterable[str], wrong: Iterable[str]) -> list[tuple[bool, str]]:
    """Return whether it is right, and the text of each candidate, in the order of a seed of an exercise."""
    found = [*((True, text) for text in right), *((False, text) for text in wrong)]
    random.Random(f"{name} {seed}").shuffle(found)
    return found


class Candidates(Node):
    """Publishes one candidate after the other on /candidates, each when the verdict before it has come."""

    def __init__(self, candidates: Sequence[tuple[bool, str]]) -> None:
        super().__init__("candidates")
        self.left = [f"{number}\n{text}" for number, (_, text) in enumerate(candidates, 1)]
        self.publisher = self.create_publisher(String, CANDIDATES, LATCHED)
        self.create_subscription(String, VERDICTS, self.on_verdict, 10)

    def on_verdict(self, verdict: String) -> None:
        """Publish the next candidate."""
        if self.left:
            self.publisher.publish(String(data=self.left.pop(0)))
