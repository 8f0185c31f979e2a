"""What publishers' and subscriptions' endpoints have in common, and the message as it waits at one."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from rclpy.qos import QoSProfile

from sim.nanoseconds import Nanoseconds
from sim.network import LAPTOP
from sim.ros.transport.context import TransportContext
from sim.ros.transport.qos import FOREVER, latches, resolved


class Sample(NamedTuple):
    """A message, or its bytes; when it was sent, its number among those of its publisher, when it expires."""

    message: Any
    stamp: Nanoseconds
    number: int
    expires: Nanoseconds = FOREVER

    def information(self, now: Nanoseconds, epoch: Nanoseconds) -> dict[str, Any]:
        """The MessageInfo, a callback's second argument, of a message that is taken now.

        epoch: what clocks show at the start of the run.
        """
        return {
            "source_timestamp": epoch + self.stamp,
            "received_timestamp": epoch + now,
            "publication_sequence_number": self.number,
            "reception_sequence_number": None,
        }


class TopicEndpoint:
    """One endpoint of a topic.

    run: what it is a part of. node, handle: rclpy's handles of the node and of the endpoint. find: rclpy's
    function that lists such endpoints of a topic. program: that which is running; None for an endpoint that
    represents one in another process. on_close: called with this endpoint once it is closed.
    """

    def __init__(
        self,
        run: TransportContext,
        node: Any,
        handle: Any,
        topic: str,
        profile: QoSProfile,
        find: Callable[..., list[dict]],
        on_close: Callable[[TopicEndpoint], None],
    ) -> None:
        self.run, self.scheduler = run, run.scheduler
        self.handle, self.topic = handle, topic
        self.profile = resolved(profile, lambda: find(node, topic, False))
        fiber = run.scheduler.current
        self.created_at, self.program = run.scheduler.now, None if fiber is None else fiber.process
        self.host = LAPTOP if self.program is None else self.program.host
        self.on_close = on_close

    def has_discovered(self, other: TopicEndpoint) -> bool:
        """Return whether the two know each other. Two programs need time for that, unless both are latched:
        what is latched is sent as soon as they do.
        """
        time_passed = self.scheduler.now > max(self.created_at, other.created_at)
        same_program = self.program is not None and self.program is other.program
        return time_passed or same_program or (latches(self.profile) and latches(other.profile))


class PublisherEndpoint(TopicEndpoint):
    """The part of a publisher's endpoint that the network needs to know. sender: the node's name."""

    sender: str
    count = 0  # messages sent
