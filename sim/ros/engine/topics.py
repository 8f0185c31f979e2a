"""What is published in a run goes straight into the queues of the run's subscriptions, as bytes.

The middleware knows all ends of topics as well, for the graph and for QoS events. It carries messages only on
topics on which C++ code publishes; and on all where the environment says so, for tests: the same comes of it.
"""

from __future__ import annotations

import os
from collections import Counter, defaultdict, deque
from typing import TYPE_CHECKING, Any, NamedTuple

from rclpy.duration import Duration
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.qos import QoSProfile

from sim.nanoseconds import Nanoseconds
from sim.ros.engine.qos import FOREVER, latches, queue_length, settled, suit
from sim.ros.fibers.fiber import Program
from sim.ros.messages.cdr import canonical
from sim.ros.messages.codec import type_name
from sim.ros.messages.decoder import decode_message

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine
    from sim.ros.engine.processes import SharedContext

MIDDLEWARE = "SIM_MIDDLEWARE"  # with this variable in the environment, the middleware carries all messages
CPP_TOPICS = "/transition_event", "/_service_event"
REPLAY_WAIT = Duration(seconds=2)  # wall time; measured at 0.1 s


class Sent(NamedTuple):
    """A message, or its bytes; when it was sent, its number among those of its publisher, when it expires."""

    message: Any
    stamp: Nanoseconds
    number: int
    expires: Nanoseconds = FOREVER

    def information(self, now: Nanoseconds) -> dict[str, Any]:
        """What a subscription's second argument says of a message that is taken now."""
        return {
            "source_timestamp": self.stamp,
            "received_timestamp": now,
            "publication_sequence_number": self.number,
            "reception_sequence_number": None,
        }


def program_of(engine: Engine) -> Program | None:
    """The program at work, which makes an end; None for what stands for one of another process."""
    return None if engine.current is None else engine.current.process


class Writer:
    """The end of a topic that a publisher is.

    node and handle: what rclpy has below its classes for the node and the publisher. sender: the node's name.
    ours: the program that made it is not the student's.
    context: of the program that has it.
    """

    context: SharedContext

    def __init__(
        self,
        engine: Engine,
        node: Any,
        handle: Any,
        type_: type,
        topic: str,
        profile: QoSProfile,
        sender: str,
        ours: bool = False,
    ) -> None:
        self.engine, self.handle, self.topic = engine, handle, topic
        self.sender, self.ours = sender, ours
        self.type = type_name(type_)
        found = _rclpy.rclpy_get_publishers_info_by_topic
        self.profile = settled(profile, lambda: found(node, topic, False))
        self._lifespan = profile.lifespan.nanoseconds or FOREVER
        self.readers: list[Reader] = []
        self.made, self.program = engine.now, program_of(engine)
        self._all_known_after = engine.now  # from later on, all readers have had time to be discovered
        self._latched: deque[Sent] = deque(maxlen=queue_length(profile) if latches(self.profile) else 0)
        self._count = 0

    def send(self, raw: bytes) -> None:
        """Publish a message's canonical bytes. Raises what rclpy does for a publisher that was destroyed."""
        self._hand_over(raw)
        self.engine.topics.sent[self.topic] += 1
        self.engine.activity += 1

    def _hand_over(self, raw: bytes) -> None:
        self._count += 1
        now = self.engine.now
        sent = Sent(raw, now, self._count, now + self._lifespan)
        self._latched.append(sent)
        for reader in self.readers:
            if now > self._all_known_after or self._knows(reader):
                reader.queue.append(sent)
            else:
                self.engine.recorder.unheard(self.sender, self.topic)

    def _knows(self, reader: Reader) -> bool:
        """Whether this end and that one have discovered each other. Two programs need time for that; what is
        latched is sent as soon as they have.
        """
        time_passed = self.engine.now > max(self.made, reader.made)
        at_home = self.program is not None and self.program is reader.program
        return time_passed or at_home or (latches(self.profile) and latches(reader.profile))

    def meet(self, reader: Reader) -> None:
        """If this end and that one suit each other, messages go there from now on, and the latched ones."""
        if suit(self.profile, reader.profile):
            self.readers.append(reader)
            self._all_known_after = max(self._all_known_after, reader.made)
            reader.queue.extend(self._latched if latches(reader.profile) else ())

    def close(self) -> None:
        """Its publisher was destroyed."""
        self._hand_over = self.handle.publish_raw  # which refuses
        self.engine.topics.remove(self)


class Reader:
    """The end of a topic that a subscription is, with the messages that wait there to be taken.

    node and handle: what rclpy has below its classes for the node and the subscription. raw: it takes bytes.
    """

    def __init__(
        self, engine: Engine, node: Any, handle: Any, type_: type, topic: str, profile: QoSProfile, raw: bool
    ) -> None:
        self.engine, self.handle, self.topic, self.raw = engine, handle, topic, raw
        self.message_class = type_
        self.made, self.program = engine.now, program_of(engine)
        found = _rclpy.rclpy_get_subscriptions_info_by_topic
        self.profile = settled(profile, lambda: found(node, topic, False))
        self.queue: deque[Sent] = deque(maxlen=queue_length(profile))

    def take(self) -> Sent | None:
        """The next message; None if there is none."""
        while self.queue:
            raw, stamp, number, expires = self.queue.popleft()
            if expires <= self.engine.now:
                continue
            if self.raw:
                return Sent(bytes(raw), stamp, number)
            try:
                return Sent(decode_message(self.message_class, raw), stamp, number)
            except _rclpy.RMWError:  # bytes that are no message: ROS drops them, too
                continue
        return None

    def close(self) -> None:
        """Its subscription was destroyed."""
        self.queue.clear()
        self.engine.topics.remove(self)


class CarriedWriter(Writer):
    """A writer whose messages the middleware carries."""

    def _hand_over(self, raw: bytes) -> None:
        self.handle.publish_raw(raw)

    def meet(self, reader: Reader) -> None:
        """Wait, in wall time, for what a late joiner of a latched topic gets."""
        if latches(self.profile) and latches(reader.profile):
            self.handle.wait_for_all_acked(REPLAY_WAIT._duration_handle)


class CarriedReader(Reader):
    """A reader whose messages the middleware carries. It is asked only when one was sent."""

    _seen: int | None = -1

    def take(self) -> Sent | None:
        """As `Reader.take`."""
        sent = self.engine.topics.sent.get(self.topic)  # None: C++ code alone publishes here; nobody counts
        if sent is not None and sent == self._seen:
            return None
        taken = self.handle.take_message(self.message_class, self.raw)
        if taken is None:
            self._seen = sent
            return None
        message, information = taken
        if self.raw:  # DDS leaves what was in memory in gaps and behind the end
            message = canonical(type_name(self.message_class), message)
        stamp = self.engine.time.moment_at(information["source_timestamp"])
        return Sent(message, stamp, information["publication_sequence_number"])


class Topics:
    """All ends of topics in one run.

    sent: how many messages nodes have published on each topic; those of C++ code are not counted.
    """

    def __init__(self, engine: Engine) -> None:
        self.sent: Counter[str] = Counter()
        self._engine = engine
        self._all_carried = MIDDLEWARE in os.environ
        self._writers: dict[str, list[Writer]] = defaultdict(list)
        self._readers: dict[str, list[Reader]] = defaultdict(list)

    def writer(self, *end: Any, topic: str, **more: Any) -> Writer:
        """A new publisher's end; the arguments are those of `Writer`."""
        kind = CarriedWriter if self._is_carried(topic) else Writer
        writer = kind(self._engine, *end, topic=topic, **more)
        self._writers[topic].append(writer)
        for reader in self._readers[topic]:
            writer.meet(reader)
        return writer

    def reader(self, *end: Any, topic: str, **more: Any) -> Reader:
        """A new subscription's end; the arguments are those of `Reader`."""
        kind = CarriedReader if self._is_carried(topic) else Reader
        reader = kind(self._engine, *end, topic=topic, **more)
        self._readers[topic].append(reader)
        for writer in self._writers[topic]:
            writer.meet(reader)
        return reader

    def remove(self, end: Writer | Reader) -> None:
        """Forget an end that was destroyed; again does nothing."""
        writers = self._writers[end.topic]
        for ends in (writers, self._readers[end.topic], *(writer.readers for writer in writers)):
            if end in ends:
                ends.remove(end)

    def _is_carried(self, topic: str) -> bool:
        """Whether C++ code publishes there: log lines, actions, states of lifecycle nodes, calls."""
        by_cpp = topic == "/rosout" or "/_action/" in topic or topic.endswith(CPP_TOPICS)
        return by_cpp or self._all_carried
