"""What anybody can know of an exercise: its card, drawn from the public runs of a right node."""

from __future__ import annotations

import functools
from dataclasses import dataclass

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from sim.evidence import INFRASTRUCTURE_TOPICS, Endpoint, LogLine, Message, Recording, is_node_service


@dataclass
class Card:
    """What the public runs of a right node show."""

    runs: list[Recording]

    @property
    def run(self) -> Recording:
        """The first of them."""
        return self.runs[0]

    @property
    def name(self) -> str:
        """The full name of the right node."""
        return next((node for node in self.run.graph.nodes if node not in self.run.course_nodes), "/stub")

    def ends(self, kind: str, *, from_course: bool = False) -> dict[str, Endpoint]:
        """Ends of one kind by name: the right node's, or the course's."""
        return {
            end.name: end
            for end in self.run.graph.ends(kind)
            if end.from_course is from_course
            and end.name not in INFRASTRUCTURE_TOPICS
            and not is_node_service(end.name)
        }

    def published(self, *, from_course: bool) -> list[Message]:
        """What was published in the public run."""
        return [published for published in self.run.messages() if published.from_course is from_course]

    @functools.cached_property
    def lines(self) -> list[LogLine]:
        """What the right node logged."""
        return [line for line in self.run.logs if not line.from_course]


def log(node: Node, level: str, text: str) -> None:
    """Log a line, of whatever level; rclpy wants a line of code for each."""
    logger = node.get_logger()
    if level == "DEBUG":
        logger.debug(text)
    elif level == "INFO":
        logger.info(text)
    elif level == "WARN":
        logger.warning(text)
    else:
        logger.error(text)


def profile(end: Endpoint) -> QoSProfile:
    """The QoS profile that an end has, as far as a recording tells."""
    made = QoSProfile(depth=max(end.qos["depth"], 1))
    made.reliability = ReliabilityPolicy[end.qos["reliability"].upper()]
    made.durability = DurabilityPolicy[end.qos["durability"].upper()]
    return made
