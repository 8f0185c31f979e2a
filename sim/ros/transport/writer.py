"""The end of a topic that a publisher is."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from rclpy.event_handler import EventHandler
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.qos import QoSProfile, ReliabilityPolicy

from sim.ros.messages.cdr import canonical
from sim.ros.messages.codec import type_name
from sim.ros.transport.outgoing import OutgoingChannels
from sim.ros.transport.qos import FOREVER, are_compatible, latches, queue_length, resolved
from sim.ros.transport.qos_events import LOST, OF_WRITER, OFFERED, deadline, liveliness_lease, statuses
from sim.ros.transport.reader import Reader, Sample, host_of, program_of

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine
    from sim.ros.engine.processes import SharedContext


class Writer:
    """The end of a topic that a publisher is.

    node and handle: what rclpy has below its classes for the node and the publisher. sender: the node's name.
    ours: the program that made it is not the student's.
    context: of the program that has it. events: what is told of what happens to it.
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
        from_course: bool = False,
        events: Iterable[EventHandler] = (),
    ) -> None:
        self.engine, self.handle, self.topic = engine, handle, topic
        self.sender, self.from_course = sender, from_course
        self.type = type_name(type_)
        found = _rclpy.rclpy_get_publishers_info_by_topic
        self.profile = resolved(profile, lambda: found(node, topic, False))
        counts = statuses(engine, events, OF_WRITER)
        self._deadline = deadline(engine, self.profile, counts.get(OFFERED))
        self._promise = liveliness_lease(engine, self.profile, counts.get(LOST))
        self._lifespan = profile.lifespan.nanoseconds or FOREVER
        self.readers: list[Reader] = []
        self.created_at, self.program = engine.now, program_of(engine)
        self.host = host_of(self.program)
        self.outgoing = None if engine.links is None else OutgoingChannels(self)  # to other hosts
        self._all_known_after = engine.now  # from later on, all readers have had time to be discovered
        self._latched: deque[Sample] = deque(maxlen=queue_length(profile) if latches(self.profile) else 0)
        self.count = 0

    def publish(self, raw: bytes) -> None:
        """Send a message to the subscriptions of its topic, and write it down."""
        raw = canonical(self.type, raw)
        self.send(raw)
        early = self.engine.now == self.created_at and not latches(self.profile)
        self.engine.recorder.message(self.topic, self.type, self.sender, raw, self.from_course, early)

    def send(self, raw: bytes) -> None:
        """Publish a message's canonical bytes. Raises what rclpy does for a publisher that was destroyed."""
        self._hand_over(raw)
        self.engine.topics.sent[self.topic] += 1
        self.engine.activity += 1

    def _hand_over(self, raw: bytes) -> None:
        self.count += 1
        now = self.engine.now
        if self._deadline is not None:
            self._deadline.begin()
        if self._promise is not None:
            self._promise.begin()
        if not self.readers and self._latched.maxlen == 0 and self.outgoing is None:
            return
        sample = Sample(raw, now, self.count, now + self._lifespan)
        self._latched.append(sample)
        for reader in self.readers:
            if now > self._all_known_after or self.has_discovered(reader):
                reader.receive(sample)
                if reader.liveliness is not None:
                    reader.liveliness.assert_liveliness(self)
            else:
                self.engine.recorder.undelivered(self.sender, self.topic)
        if self.outgoing is not None:
            self.outgoing.send(sample)

    def has_discovered(self, reader: Reader) -> bool:
        """Whether this end and that one have discovered each other. Two programs need time for that; what is
        latched is sent as soon as they have.
        """
        time_passed = self.engine.now > max(self.created_at, reader.created_at)
        at_home = self.program is not None and self.program is reader.program
        return time_passed or at_home or (latches(self.profile) and latches(reader.profile))

    def match(self, reader: Reader) -> None:
        """If this end and that one suit each other, messages go there from now on, and the latched ones."""
        elsewhere = self.program is None and reader.program is None  # where they meet by themselves
        if elsewhere or not are_compatible(self.profile, reader.profile):
            return
        self._all_known_after = max(self._all_known_after, reader.created_at)
        if reader.liveliness is not None:
            reader.liveliness.matched(self)
        latched = self._latched if latches(reader.profile) else ()
        if self.outgoing is None or self.host == reader.host:
            self.readers.append(reader)
            for sample in latched:
                reader.receive(sample)
        else:
            self.outgoing.connect(reader, list(latched))

    def _matched_readers(self) -> list[Reader]:
        """Those that hear it, wherever they are."""
        channels = () if self.outgoing is None else self.outgoing.channels
        return [*self.readers, *(channel.reader for channel in channels)]

    def assert_liveliness(self) -> None:
        """Its publisher says that it is alive. On best effort that reaches nobody, as with Fast DDS."""
        if self._promise is not None:
            self._promise.begin()
        if self.engine.link is not None and self.program is not None:
            self.engine.link.alive(self.sender, self.topic)
        if self.profile.reliability is ReliabilityPolicy.RELIABLE:
            for reader in self.readers:
                if reader.liveliness is not None:
                    reader.liveliness.assert_liveliness(self)
            for channel in () if self.outgoing is None else self.outgoing.channels:
                channel.assert_liveliness()

    def unmatch(self, reader: Reader) -> None:
        """A subscription was destroyed."""
        if reader in self.readers:
            self.readers.remove(reader)
        if self.outgoing is not None:
            self.outgoing.unmatch(reader)

    def close(self) -> None:
        """Its publisher was destroyed."""
        self._hand_over = self.handle.publish_raw  # which refuses
        if self.outgoing is not None:
            self.outgoing.close()
        for limit in filter(None, (self._deadline, self._promise)):
            limit.end()
        for reader in self._matched_readers():
            if reader.liveliness is not None:
                reader.liveliness.unmatched(self)
        self.engine.topics.remove(self)
