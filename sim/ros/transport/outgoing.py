"""What of a publisher's messages goes to other hosts, and what it keeps to send it again."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.qos import ReliabilityPolicy

from sim.nanoseconds import SECOND, Nanoseconds
from sim.ros.transport.channels import Channel, ReliableChannel
from sim.ros.transport.qos import latches, queue_length

if TYPE_CHECKING:
    from sim.ros.transport.reader import Reader, Sample
    from sim.ros.transport.writer import Writer

HEARTBEAT: Nanoseconds = 3 * SECOND
MOST_KEPT = 5000  # messages that Fast DDS has room for in a history without a limit


class History:
    """The messages of a publisher that could be sent again.

    Of one that doesn't latch, these are the ones that are not acknowledged.
    """

    def __init__(self, writer: Writer) -> None:
        self._writer, self._engine = writer, writer.engine
        self._length = min(queue_length(writer.profile) or MOST_KEPT, MOST_KEPT)
        self._keeps_all = queue_length(writer.profile) is None
        self._latches = latches(writer.profile)
        self._scheduled = False
        self.kept: dict[int, Sample] = {}
        self.channels: list[ReliableChannel] = []

    @property
    def first(self) -> int:
        """The number of the oldest message that is kept."""
        return next(iter(self.kept), self._writer.count + 1)

    @property
    def is_full(self) -> bool:
        """Whether the next message pushes the oldest one out, or has to wait."""
        return len(self.kept) >= self._length

    def has_room(self) -> bool:
        """Whether the next message need not wait."""
        return not (self._keeps_all and self.is_full)

    def all_acknowledged(self) -> bool:
        """Whether every subscription is known to have everything."""
        return not any(channel.unacknowledged for channel in self.channels)

    def add(self, sample: Sample) -> None:
        """Keep a message that is sent now."""
        if self.is_full:
            del self.kept[self.first]
        self.kept[sample.number] = sample
        self._plan()

    def restore(self, latched: list[Sample]) -> None:
        """Keep these earlier ones, too."""
        self.kept = {sample.number: sample for sample in latched} | self.kept
        self._plan()

    def acknowledged(self) -> None:
        """What all have need not be kept any more."""
        if not self._latches:
            wanted = set().union(*(channel.unacknowledged for channel in self.channels))
            self.kept = {number: sample for number, sample in self.kept.items() if number in wanted}

    def clear(self) -> None:
        """The publisher was destroyed: what is lost from now on stays lost."""
        self.kept.clear()
        self.channels.clear()

    def _plan(self) -> None:
        if not self._scheduled:
            self._scheduled = True
            self._engine.agenda.schedule_arrival(self._engine.now + HEARTBEAT, self._send_heartbeats)

    def _send_heartbeats(self) -> None:
        self._scheduled = False
        waiting = [channel for channel in self.channels if channel.unacknowledged]
        for channel in waiting:
            channel.ask()
        if waiting:
            self._plan()


class OutgoingChannels:
    """The ways from one publisher to subscriptions of other hosts."""

    def __init__(self, writer: Writer) -> None:
        self._writer = writer
        self._history = History(writer)
        self.has_room, self.all_acknowledged = self._history.has_room, self._history.all_acknowledged
        self.channels: list[Channel] = []

    def connect(self, reader: Reader, latched: list[Sample]) -> None:
        """Send what is published to this subscription, too, and these messages at once."""
        writer = self._writer
        ends = writer.profile, reader.profile
        if all(end.reliability is ReliabilityPolicy.RELIABLE for end in ends):
            channel = ReliableChannel(writer.engine, writer, reader, self._history)
            self._history.channels.append(channel)
        else:
            channel = Channel(writer.engine, writer, reader)
        self.channels.append(channel)
        alive = [sample for sample in latched if sample.expires > writer.engine.now]
        if alive:
            self._history.restore(alive)
        for sample in alive:
            channel.send(sample)

    def send(self, sample: Sample) -> None:
        """Let a message set out to all."""
        if self._history.channels:
            self._history.add(sample)
        for channel in self.channels:
            if self._writer.has_discovered(channel.reader):
                channel.send(sample)
            else:
                self._writer.engine.recorder.undelivered(self._writer.sender, self._writer.topic)

    def unmatch(self, reader: Reader) -> None:
        """A subscription was destroyed."""
        for channel in [channel for channel in self.channels if channel.reader is reader]:
            channel.open = False
            self.channels.remove(channel)
            if channel in self._history.channels:
                self._history.channels.remove(channel)
        self._history.acknowledged()

    def close(self) -> None:
        """The publisher was destroyed."""
        self._history.clear()
