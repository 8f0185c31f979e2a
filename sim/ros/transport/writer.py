"""The endpoint of a publisher."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any, Protocol

from rclpy.event_handler import EventHandler
from rclpy.qos import QoSProfile, ReliabilityPolicy

from sim.nanoseconds import Nanoseconds
from sim.ros.attached import Attached
from sim.ros.messages.cdr import canonical
from sim.ros.messages.codec import type_name
from sim.ros.rclpy_cpp import cpp
from sim.ros.transport.context import TransportContext
from sim.ros.transport.endpoint import PublisherEndpoint, Sample, TopicEndpoint
from sim.ros.transport.outgoing import OutgoingChannels
from sim.ros.transport.qos import FOREVER, are_compatible, latches, queue_length
from sim.ros.transport.qos_events import (
    LIVELINESS_LOST,
    OF_WRITER,
    OFFERED,
    deadline_lease,
    event_counts,
    liveliness_lease,
)
from sim.ros.transport.reader import DataReader


class ContextHandle(Protocol):
    """The context of a program, as far as its publishers need it."""

    alive: bool  # not shut down


class DataWriter(PublisherEndpoint):
    """The endpoint of a publisher.

    from_course: the program that made it is the course's, not the student's. context: that program's. events:
    handlers of what happens to it. The other arguments are those of TopicEndpoint.
    """

    context: ContextHandle

    def __init__(
        self,
        run: TransportContext,
        node: Any,
        handle: Any,
        type_: type,
        topic: str,
        profile: QoSProfile,
        sender: str,
        on_close: Callable[[TopicEndpoint], None],
        from_course: bool = False,
        events: Iterable[EventHandler] = (),
    ) -> None:
        find = cpp.rclpy_get_publishers_info_by_topic
        super().__init__(run, node, handle, topic, profile, find, on_close)
        self.sender, self.from_course = sender, from_course
        self.type = type_name(type_)
        counts = event_counts(run, events, OF_WRITER)
        self._deadline = deadline_lease(run, self.profile, counts.get(OFFERED))
        self._liveliness = liveliness_lease(run, self.profile, counts.get(LIVELINESS_LOST))
        self._lifespan = profile.lifespan.nanoseconds or FOREVER
        self.readers: list[DataReader] = []
        self.outgoing = None if run.links is None else OutgoingChannels(self)  # to other hosts
        self._all_known_after = self.created_at  # from later on, all readers have had time to be discovered
        self._latched: deque[Sample] = deque(maxlen=queue_length(profile) if latches(self.profile) else 0)

    def publish(self, raw: bytes) -> None:
        """Send a message to the subscriptions of its topic, and record it."""
        raw = canonical(self.type, raw)
        self.send(raw)
        early = self.scheduler.now == self.created_at and not latches(self.profile)
        self.run.recorder.message(self.topic, self.type, self.sender, raw, self.from_course, early)

    def send(self, raw: bytes) -> None:
        """Send a message's canonical bytes. Raises what rclpy does for a publisher that was destroyed."""
        self._hand_over(raw)
        self.run.sent[self.topic] += 1

    def _hand_over(self, raw: bytes) -> None:
        self.count += 1
        now = self.scheduler.now
        if self._deadline is not None:
            self._deadline.renew()
        if self._liveliness is not None:
            self._liveliness.renew()
        if not self.readers and self._latched.maxlen == 0 and self.outgoing is None:
            return
        sample = Sample(raw, now, self.count, now + self._lifespan)
        self._latched.append(sample)
        for reader in self.readers:
            if now > self._all_known_after or self.has_discovered(reader):
                self._arrive_at(self._arrival(reader, now), sample, reader)
            else:
                self.run.recorder.undelivered(self.sender, self.topic)
        if self.outgoing is not None:
            self.outgoing.send(sample)

    def _arrival(self, reader: DataReader, now: Nanoseconds) -> Nanoseconds:
        """Return when a message sent now arrives; at the subscription's creation, as a latched one."""
        if self.run.arrivals is None:
            return now
        known = now > max(self.created_at, reader.created_at)
        return (self.run.arrivals.at if known else self.run.arrivals.kept_at)(self, reader, now)

    def _arrive_at(self, arrival: Nanoseconds, sample: Sample, reader: DataReader) -> None:
        if arrival == self.scheduler.now:
            self._arrive(sample, reader)
        else:
            self.run.events.schedule_arrival(arrival, partial(self._arrive, sample, reader))

    def _arrive(self, sample: Sample, reader: DataReader) -> None:
        if reader.closed:
            return
        reader.receive(sample)
        if reader.liveliness is not None:
            reader.liveliness.assert_liveliness(self)

    def match(self, reader: DataReader) -> None:
        """Send messages to a subscription from now on, if it is compatible, and the latched ones at once."""
        both_elsewhere = self.program is None and reader.program is None  # they match in the other process
        if both_elsewhere or not are_compatible(self.profile, reader.profile):
            return
        self._all_known_after = max(self._all_known_after, reader.created_at)
        if reader.liveliness is not None:
            reader.liveliness.matched(self)
        now, latching = self.scheduler.now, latches(reader.profile)
        latched = [sample for sample in self._latched if latching and sample.expires > now]
        if self.outgoing is None or self.host == reader.host:
            self.readers.append(reader)
            arrival = self._arrival(reader, now) if latched else now
            for sample in latched:
                self._arrive_at(arrival, sample, reader)
        else:
            self.outgoing.connect(reader, latched)

    def _matched_readers(self) -> list[DataReader]:
        """Those on this host and on others."""
        channels = () if self.outgoing is None else self.outgoing.channels
        return [*self.readers, *(channel.reader for channel in channels)]

    def undiscovered(self) -> int:
        """Return how many matched subscriptions a message wouldn't reach yet, as they were just created."""
        elsewhere = [
            reader
            for reader in self.run.elsewhere.get(self.topic, ())
            if reader.reader is None and are_compatible(self.profile, reader.profile)
        ]
        return sum(not self.has_discovered(reader) for reader in (*self._matched_readers(), *elsewhere))

    def assert_liveliness(self) -> None:
        """Its publisher is alive. On best effort that reaches no subscription, as with Fast DDS."""
        if self._liveliness is not None:
            self._liveliness.renew()
        if self.run.peer is not None and self.program is not None:
            self.run.peer.alive(self.sender, self.topic)
        if self.profile.reliability is ReliabilityPolicy.RELIABLE:
            for reader in self.readers:
                if reader.liveliness is not None:
                    reader.liveliness.assert_liveliness(self)
            for channel in () if self.outgoing is None else self.outgoing.channels:
                channel.assert_liveliness()

    def unmatch(self, reader: DataReader) -> None:
        """A subscription was destroyed."""
        if reader in self.readers:
            self.readers.remove(reader)
        if self.outgoing is not None:
            self.outgoing.disconnect(reader)

    def close(self) -> None:
        """Its publisher was destroyed."""
        self._hand_over = self.handle.publish_raw  # which refuses
        if self.outgoing is not None:
            self.outgoing.close()
        for lease in filter(None, (self._deadline, self._liveliness)):
            lease.cancel()
        for reader in self._matched_readers():
            if reader.liveliness is not None:
                reader.liveliness.unmatched(self)
        self.on_close(self)


WRITER = Attached[DataWriter]()  # of a Publisher
