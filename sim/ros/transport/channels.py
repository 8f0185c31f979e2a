"""The way of messages from a publisher of one host to a subscription of another: lost, late, sent again.

What is reliable follows Fast DDS, as ROS sets it up, which was measured on a network that loses packets (see
`tests/sim/ros/middleware_facts.txt`): a subscription that misses a message says so only when a heartbeat asks
it. One goes out every 3 s while something is not acknowledged, and with each message that fills the
publisher's history. Until then nothing of what came later is handed over.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from random import Random
from typing import TYPE_CHECKING

from sim.nanoseconds import SECOND, Nanoseconds, nanoseconds
from sim.network import Network

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine
    from sim.ros.transport.outgoing import History
    from sim.ros.transport.reader import Reader, Sample
    from sim.ros.transport.writer import Writer

MOST_WAITING: Nanoseconds = SECOND  # of data before a narrow link; what comes on top of that is lost
RESPONSE: Nanoseconds = SECOND // 200  # until either side answers the other's heartbeat or request


class HostLink:
    """The way from one host to another, which all messages in this direction share."""

    def __init__(self, network: Network) -> None:
        self.network = network
        self._free_at: Nanoseconds = 0

    def cross(self, chance: Random, size: int, now: Nanoseconds) -> Nanoseconds | None:
        """When something of so many bytes that sets out now arrives; None if it is lost."""
        bandwidth, start = self.network.bandwidth, now
        if bandwidth is not None:
            start = max(now, self._free_at)
            if start - now > MOST_WAITING:
                return None
            start = self._free_at = start + nanoseconds(size / bandwidth)
        return self.travel(chance, start)

    def travel(self, chance: Random, start: Nanoseconds) -> Nanoseconds | None:
        """The same for what is too short to need bandwidth, or sets out only later."""
        network = self.network
        lost, shift = chance.random() < network.loss, chance.uniform(-1, 1) * network.jitter
        return None if lost else start + nanoseconds(max(network.delay + shift, 0.0))


class HostLinks:
    """All ways of one run."""

    def __init__(self, network: Network, seed: int) -> None:
        self._network, self._seed = network, seed
        self._links: dict[tuple[str, str], HostLink] = {}

    def between(self, sender: str, receiver: str) -> HostLink:
        """The way from this host to that one."""
        pair = sender, receiver
        if pair not in self._links:
            self._links[pair] = HostLink(self._network.between(*pair))
        return self._links[pair]

    def chance(self, *names: str) -> Random:
        """A generator for what these names mean: what others send doesn't shift it."""
        return Random(" ".join(("network of run", str(self._seed), *names)))


class Channel:
    """From one publisher to one subscription. This one takes no more care of a message: best effort.

    A message that a later one has overtaken is dropped, as DDS does.
    """

    reliable = False

    def __init__(self, engine: Engine, writer: Writer, reader: Reader) -> None:
        self.engine, self.writer, self.reader = engine, writer, reader
        self.open = True
        self._link = engine.links.between(writer.host, reader.host)
        self._chance = engine.links.chance(writer.sender, writer.topic, reader.subscriber)
        self._row = engine.recorder.crossing(writer.topic, writer.sender, reader.subscriber)
        self._newest = 0  # number of the last message that came through
        self._gap = 0  # messages that are known to be lost, and of which the subscription doesn't know

    def send(self, sample: Sample) -> None:
        """Let a message set out."""
        self._row.sent += 1
        if not self._cross(len(sample.message), partial(self._arrive, sample)):
            self._lost()

    def assert_liveliness(self) -> None:
        """Let a sign of life set out."""

    def _cross(self, size: int, do: Callable[[], None], after: Nanoseconds = 0) -> bool:
        """Do this where and when so many bytes arrive; whether they do."""
        arrival = self._link.cross(self._chance, size, self.engine.now + after)
        if arrival is not None:
            self._at(arrival, do)
        return arrival is not None

    def _at(self, moment: Nanoseconds, do: Callable[[], None]) -> None:
        if moment <= self.engine.now:
            do()
        else:
            self.engine.agenda.schedule_arrival(moment, do)

    def _arrive(self, sample: Sample) -> None:
        if sample.number < self._newest:
            self._lost()
        else:
            self._hand_over(sample)

    def _lost(self) -> None:
        self._row.lost += 1
        self._gap += self._newest > 0 or self.reliable  # before the first, Fast DDS counts none

    def _hand_over(self, sample: Sample) -> None:
        """Put a message that came through into the subscription's queue."""
        now = self.engine.now
        self._newest = sample.number
        if not self.open:
            return
        if sample.expires <= now:
            self._row.expired += 1
            return
        self._row.late = max(self._row.late, (now - sample.stamp) / SECOND)
        if self._gap:
            self.reader.on_lost(self._gap)
            self._gap = 0
        self.reader.receive(sample)
        self._liveliness_arrived()

    def _liveliness_arrived(self) -> None:
        if self.open and self.reader.liveliness is not None:
            self.reader.liveliness.assert_liveliness(self.writer)
        self.engine.activity += 1


class ReliableChannel(Channel):
    """Sends again what was lost, as long as the publisher's history has it; all are handed over in order."""

    reliable = True

    def __init__(self, engine: Engine, writer: Writer, reader: Reader, history: History) -> None:
        super().__init__(engine, writer, reader)
        self.unacknowledged: set[int] = set()
        self._history = history
        self._back = engine.links.between(reader.host, writer.host)
        self._next: int | None = None  # number of the message that is to be handed over next
        self._early: dict[int, Sample | None] = {}  # those that wait for earlier ones; None for a gap

    def send(self, sample: Sample) -> None:
        """As Channel."""
        self._row.sent += 1
        self.unacknowledged.add(sample.number)
        if self._next is None:
            self._next = sample.number
        self._send(sample, asks=self._history.is_full)

    def assert_liveliness(self) -> None:
        """As Channel; nobody sends it again."""
        self._cross(0, self._liveliness_arrived)

    def ask(self) -> None:
        """Send a heartbeat: which messages there are to have."""
        self._cross(0, partial(self._asked, *self._range()))

    def _range(self) -> tuple[int, int]:
        return self._history.first, self.writer.count

    def _send(self, sample: Sample, asks: bool = False, after: Nanoseconds = 0) -> None:
        question = self._range() if asks else None
        self._cross(len(sample.message), partial(self._arrive_with, sample, question), after)

    def _arrive_with(self, sample: Sample, question: tuple[int, int] | None) -> None:
        self._arrive(sample)
        if question is not None:
            self._asked(*question)

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

    def _asked(self, first: int, last: int) -> None:
        """At the subscription: a heartbeat came. What is not to have any more is lost."""
        if not self.open or self._next is None:
            return
        for number in range(self._next, first):
            self._early.setdefault(number, None)
        self._release()
        missing = [number for number in range(self._next, last + 1) if number not in self._early]
        now = self.engine.now + RESPONSE
        arrival = self._back.cross(self._chance, 0, now)
        if arrival is not None:
            self._at(arrival, partial(self._answered, missing, last))

    def _answered(self, missing: list[int], last: int) -> None:
        """At the publisher: the subscription has all up to `last` but for what it misses.

        What is later than the first of these doesn't count as acknowledged.
        """
        beyond = min(missing, default=last + 1)
        self.unacknowledged = {number for number in self.unacknowledged if number >= beyond}
        for number in missing:
            sample = self._history.kept.get(number)
            if sample is None or sample.expires <= self.engine.now:
                self._cross(0, partial(self._arrive, None, number), RESPONSE)
            else:
                self._row.resent += 1
                self._send(sample, after=RESPONSE)
        self._history.acknowledged()
        self.engine.activity += 1
