"""The two kinds of ends that a topic has in a run: who publishes, and who listens."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, Any, NamedTuple

from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.qos import QoSProfile

from sim.nanoseconds import Nanoseconds
from sim.network import LAPTOP
from sim.ros.engine.channels import Channel, channel_between
from sim.ros.engine.qos import FOREVER, latches, queue_length, settled, suit
from sim.ros.fibers.fiber import Program
from sim.ros.messages.cdr import canonical
from sim.ros.messages.codec import type_name
from sim.ros.messages.decoder import decode_message

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine
    from sim.ros.engine.processes import SharedContext


# So many messages of a publisher are kept to be sent again, whatever its depth: what Fast DDS has room for.
MOST_KEPT = 5000


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


def host_of(program: Program | None) -> str:
    """Where a program runs; what stands for one of another process stands for the student's."""
    return LAPTOP if program is None else program.host


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
        self.host = host_of(self.program)
        self.channels: list[Channel] = []  # to readers of other hosts
        self._all_known_after = engine.now  # from later on, all readers have had time to be discovered
        self._latched: deque[Sent] = deque(maxlen=queue_length(profile) if latches(self.profile) else 0)
        self._count = 0
        self._keeps_all = queue_length(profile) is None
        self._length = min(queue_length(profile) or MOST_KEPT, MOST_KEPT)

    def publish(self, raw: bytes) -> None:
        """Send a message to the subscriptions of its topic, and write it down."""
        raw = canonical(self.type, raw)
        self.send(raw)
        self.engine.recorder.message(self.topic, self.type, self.sender, raw, self.ours)

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
                reader.receive(sent)
            else:
                self.engine.recorder.unheard(self.sender, self.topic)
        for channel in self.channels:
            if now > self._all_known_after or self._knows(channel.reader):
                channel.send(sent)
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
        if not suit(self.profile, reader.profile):
            return
        self._all_known_after = max(self._all_known_after, reader.made)
        if self.engine.links is None or self.host == reader.host:
            self.readers.append(reader)
            take = reader.receive
        else:
            self.channels.append(channel_between(self.engine, self, reader))
            take = self.channels[-1].send
        for sent in self._latched if latches(reader.profile) else ():
            take(sent)

    def forget(self, reader: Reader) -> None:
        """A subscription was destroyed."""
        if reader in self.readers:
            self.readers.remove(reader)
        for channel in [channel for channel in self.channels if channel.reader is reader]:
            channel.open = False
            self.channels.remove(channel)

    @property
    def history(self) -> range:
        """The numbers of the messages that could be sent again."""
        return range(max(self._count - self._length, 0) + 1, self._count + 1)

    def has_room(self) -> bool:
        """Whether the next message need not wait until one of those in the history has arrived."""
        oldest = self._count + 1 - MOST_KEPT
        return not self._keeps_all or all(
            min(channel.under_way, default=oldest + 1) > oldest
            for channel in self.channels
            if channel.reliable
        )

    def all_have_it(self) -> bool:
        """Whether nothing reliable is under way."""
        return not any(channel.under_way for channel in self.channels if channel.reliable)

    def close(self) -> None:
        """Its publisher was destroyed."""
        self._hand_over = self.handle.publish_raw  # which refuses
        self._length = 0  # what is lost from now on stays lost
        self.engine.topics.remove(self)


class Reader:
    """The end of a topic that a subscription is, with the messages that wait there to be taken.

    node and handle: what rclpy has below its classes for the node and the subscription. raw: it takes bytes.
    listener: the node's name.
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
        listener: str = "",
    ) -> None:
        self.engine, self.handle, self.topic, self.raw = engine, handle, topic, raw
        self.message_class, self.listener = type_, listener
        self.made, self.program = engine.now, program_of(engine)
        self.host = host_of(self.program)
        found = _rclpy.rclpy_get_subscriptions_info_by_topic
        self.profile = settled(profile, lambda: found(node, topic, False))
        self.queue: deque[Sent] = deque(maxlen=queue_length(profile))
        self.receive = self.queue.append

    def missed(self, count: int) -> None:
        """So many messages did not come before the one that comes now."""

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
