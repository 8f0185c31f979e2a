"""The channel of messages from a publisher on one host to a subscription on another: lost, late, sent again.

What is reliable follows Fast DDS, as ROS sets it up, which was measured on a network that loses packets (see
`tests/sim/ros/middleware_facts.txt`): a subscription that misses a message requests it after a heartbeat.
One is sent every 3 s while something is not acknowledged, and with each message that fills the publisher's
history. Until then nothing of what came later is handed over.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from sim.nanoseconds import SECOND, Nanoseconds
from sim.ros.transport.endpoint import PublisherEndpoint, Sample
from sim.ros.transport.history import History
from sim.ros.transport.reader import DataReader

RESPONSE: Nanoseconds = SECOND // 200  # until either side answers the other's heartbeat or request


class Channel:
    """From one publisher to one subscription, best effort: what is lost stays lost.

    A message that a later one has overtaken is dropped, as DDS does.
    """

    reliable = False

    def __init__(self, writer: PublisherEndpoint, reader: DataReader) -> None:
        self.writer, self.reader = writer, reader
        self.open = True
        run = self._run = writer.run
        self._scheduler = writer.scheduler
        self._link = run.links.between(writer.host, reader.host)
        self._random = run.links.random(writer.sender, writer.topic, reader.subscriber)
        self._counts = run.recorder.crossing(writer.topic, writer.sender, reader.subscriber)
        self._newest = 0  # number of the last message that came through
        self._gap = 0  # messages that are known to be lost, and of which the subscription doesn't know

    def send(self, sample: Sample) -> None:
        """Send a message."""
        self._counts.sent += 1
        if not self._cross(len(sample.message), partial(self._arrive, sample)):
            self._lost()

    def assert_liveliness(self) -> None:
        """Send an assertion of liveliness; on best effort it reaches no subscription, as with Fast DDS."""

    def _cross(self, size: int, do: Callable[[], None], after: Nanoseconds = 0) -> bool:
        """Do this where and when so many bytes arrive; whether they do."""
        arrival = self._link.cross(self._random, size, self._scheduler.now + after)
        if arrival is not None:
            self._at(arrival, do)
        return arrival is not None

    def _at(self, moment: Nanoseconds, do: Callable[[], None]) -> None:
        if moment <= self._scheduler.now:
            do()
        else:
            self._run.events.schedule_arrival(moment, do)

    def _arrive(self, sample: Sample) -> None:
        if sample.number < self._newest:
            self._lost()
        else:
            self._hand_over(sample)

    def _lost(self) -> None:
        self._counts.lost += 1
        self._gap += self._newest > 0 or self.reliable  # before the first, Fast DDS counts none

    def _hand_over(self, sample: Sample) -> None:
        """Put a message that came through into the subscription's queue."""
        now = self._scheduler.now
        self._newest = sample.number
        if not self.open:
            return
        if self.reader.is_expired(sample):
            self._counts.expired += 1
            return
        self._counts.late = max(self._counts.late, (now - sample.stamp) / SECOND)
        if self._gap:
            self.reader.on_lost(self._gap)
            self._gap = 0
        self.reader.receive(sample)
        self._liveliness_arrived()

    def _liveliness_arrived(self) -> None:
        if self.open and self.reader.liveliness is not None:
            self.reader.liveliness.assert_liveliness(self.writer)


class ReliableChannel(Channel):
    """Sends lost messages again while the publisher's history has them; hands all of them over in order."""

    reliable = True

    def __init__(self, writer: PublisherEndpoint, reader: DataReader, history: History) -> None:
        super().__init__(writer, reader)
        self.unacknowledged: set[int] = set()
        self._history = history
        self._back = self._run.links.between(reader.host, writer.host)
        self._next: int | None = None  # number of the message that is to be handed over next
        self._early: dict[int, Sample | None] = {}  # those that wait for earlier ones; None for a gap

    def send(self, sample: Sample) -> None:
        """Work like Channel."""
        self._counts.sent += 1
        self.unacknowledged.add(sample.number)
        if self._next is None:
            self._next = sample.number
        self._send(sample, heartbeat=self._history.is_full)

    def assert_liveliness(self) -> None:
        """Work like Channel; it is not sent again."""
        self._cross(0, self._liveliness_arrived)

    def send_heartbeat(self) -> None:
        """Send which messages there are to have; the subscription answers with what it misses."""
        self._cross(0, partial(self._on_heartbeat, *self._range()))

    def _range(self) -> tuple[int, int]:
        return self._history.first, self._history.last

    def _send(self, sample: Sample, heartbeat: bool = False, after: Nanoseconds = 0) -> None:
        available = self._range() if heartbeat else None
        self._cross(len(sample.message), partial(self._arrive_with, sample, available), after)

    def _arrive_with(self, sample: Sample, available: tuple[int, int] | None) -> None:
        self._arrive(sample)
        if available is not None:
            self._on_heartbeat(*available)

    def _arrive(self, sample: Sample | None, number: int | None = None) -> None:
        number = sample.number if sample is not None else number
        if number >= self._next:
            self._early.setdefault(number, sample)
            self._release()

    def _release(self) -> None:
        while self._next in self._early:
            sample = self._early.pop(self._next)
            self._next += 1
            if sample is None:
                self._lost()
            else:
                self._hand_over(sample)

    def _on_heartbeat(self, first: int, last: int) -> None:
        """At the subscription: a heartbeat came. What the publisher no longer has is lost."""
        if not self.open or self._next is None:
            return
        for number in range(self._next, first):
            self._early.setdefault(number, None)
        self._release()
        missing = [number for number in range(self._next, last + 1) if number not in self._early]
        now = self._scheduler.now + RESPONSE
        arrival = self._back.cross(self._random, 0, now)
        if arrival is not None:
            self._at(arrival, partial(self._on_acknowledgment, missing, last))

    def _on_acknowledgment(self, missing: list[int], last: int) -> None:
        """At the publisher: the subscription has all up to `last` except what it misses.

        What is later than the first of these doesn't count as acknowledged.
        """
        beyond = min(missing, default=last + 1)
        self.unacknowledged = {number for number in self.unacknowledged if number >= beyond}
        for number in missing:
            sample = self._history.stored.get(number)
            if sample is None or sample.expires <= self._scheduler.now:
                self._cross(0, partial(self._arrive, None, number), RESPONSE)
            else:
                self._counts.resent += 1
                self._send(sample, after=RESPONSE)
        self._history.acknowledged()
