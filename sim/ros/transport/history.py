"""What a publisher stores of its messages, to send it again to subscriptions on other hosts."""

from __future__ import annotations

from typing import Protocol

from sim.nanoseconds import SECOND, Nanoseconds
from sim.ros.transport.endpoint import PublisherEndpoint, Sample
from sim.ros.transport.qos import latches, queue_length

HEARTBEAT: Nanoseconds = 3 * SECOND
MOST_STORED = 5000  # messages that Fast DDS has room for in a history without a limit


class Acknowledging(Protocol):
    """The reliable channel of one subscription, as far as the history needs it."""

    unacknowledged: set[int]  # numbers of messages

    def send_heartbeat(self) -> None:
        """Send which messages there are to have."""


class History:
    """The messages of a publisher that could be sent again.

    Of one that is not latched, these are the ones that are not acknowledged.
    """

    def __init__(self, writer: PublisherEndpoint) -> None:
        self._writer, self._run = writer, writer.run
        self._length = min(queue_length(writer.profile) or MOST_STORED, MOST_STORED)
        self._keeps_all = queue_length(writer.profile) is None
        self._latches = latches(writer.profile)
        self._scheduled = False
        self.stored: dict[int, Sample] = {}
        self.channels: list[Acknowledging] = []

    @property
    def first(self) -> int:
        """The number of the oldest message that is stored."""
        return next(iter(self.stored), self.last + 1)

    @property
    def last(self) -> int:
        """The number of the publisher's newest message."""
        return self._writer.count

    @property
    def is_full(self) -> bool:
        """Return whether the next message replaces the oldest one, or has to wait."""
        return len(self.stored) >= self._length

    def has_room(self) -> bool:
        """Return whether the next message need not wait."""
        return not (self._keeps_all and self.is_full)

    def all_acknowledged(self) -> bool:
        """Return whether every subscription is known to have everything."""
        return not any(channel.unacknowledged for channel in self.channels)

    def add(self, sample: Sample) -> None:
        """Store a message that is sent now."""
        if self.is_full:
            del self.stored[self.first]
        self.stored[sample.number] = sample
        self._schedule()

    def restore(self, latched: list[Sample]) -> None:
        """Store these earlier ones, too."""
        self.stored = {sample.number: sample for sample in latched} | self.stored
        self._schedule()

    def acknowledged(self) -> None:
        """Drop what every subscription has."""
        if not self._latches:
            wanted = set().union(*(channel.unacknowledged for channel in self.channels))
            self.stored = {number: sample for number, sample in self.stored.items() if number in wanted}

    def clear(self) -> None:
        """The publisher was destroyed: what is lost from now on stays lost."""
        self.stored.clear()
        self.channels.clear()

    def _schedule(self) -> None:
        if not self._scheduled:
            self._scheduled = True
            now = self._run.scheduler.now
            self._run.events.schedule_arrival(now + HEARTBEAT, self._send_heartbeats)

    def _send_heartbeats(self) -> None:
        self._scheduled = False
        waiting = [channel for channel in self.channels if channel.unacknowledged]
        for channel in waiting:
            channel.send_heartbeat()
        if waiting:
            self._schedule()
