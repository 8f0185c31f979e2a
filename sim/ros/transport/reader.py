"""The end of a topic that a subscription is."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

from rclpy.event_handler import EventHandler
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.qos import QoSProfile

from sim.nanoseconds import EPOCH, Nanoseconds
from sim.network import LAPTOP
from sim.ros.fibers.fiber import Program
from sim.ros.messages.decoder import decode_message
from sim.ros.transport.qos import FOREVER, queue_length, resolved
from sim.ros.transport.qos_events import (
    CHANGED,
    MISSED,
    OF_READER,
    REQUESTED,
    deadline,
    liveliness,
    statuses,
)

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine


class Sample(NamedTuple):
    """A message, or its bytes; when it was sent, its number among those of its publisher, when it expires."""

    message: Any
    stamp: Nanoseconds
    number: int
    expires: Nanoseconds = FOREVER

    def information(self, now: Nanoseconds) -> dict[str, Any]:
        """What a subscription's second argument says of a message that is taken now."""
        return {
            "source_timestamp": EPOCH + self.stamp,
            "received_timestamp": EPOCH + now,
            "publication_sequence_number": self.number,
            "reception_sequence_number": None,
        }


def host_of(program: Program | None) -> str:
    """Where a program runs; what stands for one of another process stands for the student's."""
    return LAPTOP if program is None else program.host


def program_of(engine: Engine) -> Program | None:
    """The program at work, which makes an end; None for what stands for one of another process."""
    return None if engine.current is None else engine.current.process


class Reader:
    """The end of a topic that a subscription is, with the messages that wait there to be taken.

    node and handle: what rclpy has below its classes for the node and the subscription. raw: it takes bytes.
    listener: the node's name. events: as of a Writer.
    """

    def __init__(
        self,
        engine: Engine,
        node: Any,
        handle: Any,
        type_: type,
        topic: str,
        profile: QoSProfile,
        raw: bool,
        subscriber: str = "",
        events: Iterable[EventHandler] = (),
    ) -> None:
        self.engine, self.handle, self.topic, self.raw = engine, handle, topic, raw
        self.message_class, self.subscriber = type_, subscriber
        self.created_at, self.program = engine.now, program_of(engine)
        self.host = host_of(self.program)
        found = _rclpy.rclpy_get_subscriptions_info_by_topic
        self.profile = resolved(profile, lambda: found(node, topic, False))
        self.queue: deque[Sample] = deque(maxlen=queue_length(profile))
        counts = statuses(engine, events, OF_READER)
        self.liveliness = liveliness(engine, self.profile, counts.get(CHANGED))
        self._deadline = deadline(engine, self.profile, counts.get(REQUESTED))
        self._lost_status = counts.get(MISSED)
        self.receive = self.queue.append if self._deadline is None else self._receive_in_time

    def _receive_in_time(self, sample: Sample) -> None:
        self._deadline.begin()
        self.queue.append(sample)

    def on_lost(self, count: int) -> None:
        """So many messages did not come before the one that comes now."""
        if self._lost_status is not None:
            self._lost_status.add(total_count=count)

    def take(self) -> Sample | None:
        """The next message; None if there is none."""
        while self.queue:
            raw, stamp, number, expires = self.queue.popleft()
            if expires <= self.engine.now:
                continue
            if self.raw:
                return Sample(bytes(raw), stamp, number)
            try:
                return Sample(decode_message(self.message_class, raw), stamp, number)
            except _rclpy.RMWError:  # bytes that are no message: ROS drops them, too
                continue
        return None

    def close(self) -> None:
        """Its subscription was destroyed."""
        self.queue.clear()
        if self._deadline is not None:
            self._deadline.end()
        self.engine.topics.remove(self)
