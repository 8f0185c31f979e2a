"""The way of messages from a publisher of one host to a subscription of another: lost, late, sent again."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from random import Random
from typing import TYPE_CHECKING

from rclpy.qos import ReliabilityPolicy

from sim.nanoseconds import SECOND, Nanoseconds, nanoseconds
from sim.network import Network

if TYPE_CHECKING:
    from sim.ros.engine.ends import Reader, Sent, Writer
    from sim.ros.engine.engine import Engine

MOST_WAITING: Nanoseconds = SECOND  # of data before a narrow link; what comes on top of that is lost
RESEND_AFTER: Nanoseconds = SECOND // 5


class Link:
    """The way from one host to another, which all messages in this direction share."""

    def __init__(self, network: Network) -> None:
        self.network = network
        self._free_at: Nanoseconds = 0

    def cross(self, chance: Random, size: int, now: Nanoseconds) -> Nanoseconds | None:
        """When something of so many bytes that sets out now arrives; None if it is lost."""
        network = self.network
        lost, shift = chance.random() < network.loss, chance.uniform(-1, 1) * network.jitter
        start = now
        if network.bandwidth is not None:
            start = max(now, self._free_at)
            if start - now > MOST_WAITING:
                return None
            start = self._free_at = start + nanoseconds(size / network.bandwidth)
        return None if lost else start + nanoseconds(max(network.delay + shift, 0.0))


class Links:
    """All ways of one run."""

    def __init__(self, network: Network, seed: int) -> None:
        self._network, self._seed = network, seed
        self._links: dict[tuple[str, str], Link] = {}

    def between(self, sender: str, receiver: str) -> Link:
        """The way from this host to that one."""
        pair = sender, receiver
        if pair not in self._links:
            self._links[pair] = Link(self._network.between(*pair))
        return self._links[pair]

    def chance(self, *names: str) -> Random:
        """A generator for what these names mean: what others send doesn't shift it."""
        return Random(" ".join(("network of run", str(self._seed), *names)))


class Channel:
    """From one publisher to one subscription. This one takes no more care of a message: best effort.

    A message that an earlier one has overtaken is dropped, as DDS does.
    """

    reliable = False

    def __init__(self, engine: Engine, writer: Writer, reader: Reader) -> None:
        self.engine, self.writer, self.reader = engine, writer, reader
        self.open = True
        self._link = engine.links.between(writer.host, reader.host)
        self._chance = engine.links.chance(writer.sender, writer.topic, reader.listener)
        self._row = engine.recorder.crossing(writer.topic, writer.sender, reader.listener)
        self._newest = 0  # number of the last message that came through
        self._gap = 0  # messages that are known to be lost, and of which the subscription doesn't know

    def send(self, sent: Sent) -> None:
        """Let a message set out."""
        self._row.sent += 1
        arrival = self._link.cross(self._chance, len(sent.message), self.engine.now)
        if arrival is None:
            self._lost()
        else:
            self._at(arrival, partial(self._arrive, sent))

    def _at(self, moment: Nanoseconds, do: Callable[[], None]) -> None:
        if moment <= self.engine.now:
            do()
        else:
            self.engine.agenda.arrive(moment, do)

    def _arrive(self, sent: Sent) -> None:
        if sent.number < self._newest:
            self._lost()
        else:
            self.hand_over(sent)

    def _lost(self) -> None:
        self._row.lost += 1
        self._gap += 1

    def hand_over(self, sent: Sent) -> None:
        """Put a message that came through into the subscription's queue."""
        now = self.engine.now
        self._newest = sent.number
        if not self.open:
            return
        if sent.expires <= now:
            self._row.expired += 1
            return
        self._row.late = max(self._row.late, (now - sent.stamp) / SECOND)
        if self._gap:
            self.reader.missed(self._gap)
            self._gap = 0
        self.reader.receive(sent)
        self.engine.activity += 1


class ReliableChannel(Channel):
    """Sends again what was lost, as long as the publisher's history has it; all arrive in order.

    A message counts as acknowledged when it has arrived.
    """

    reliable = True

    def __init__(self, engine: Engine, writer: Writer, reader: Reader) -> None:
        super().__init__(engine, writer, reader)
        self.under_way: dict[int, bool] = {}  # by number, and whether it is lost so far
        self._arrived: dict[int, Sent] = {}  # those that wait for earlier ones

    def send(self, sent: Sent) -> None:
        """As Channel."""
        self._row.sent += 1
        self._try(sent)

    def _try(self, sent: Sent) -> None:
        now = self.engine.now
        arrival = self._link.cross(self._chance, len(sent.message), now)
        self.under_way[sent.number] = arrival is None
        if arrival is None:
            self.engine.agenda.arrive(now + RESEND_AFTER, partial(self._again, sent))
        else:
            self._at(arrival, partial(self._arrive, sent))

    def _again(self, sent: Sent) -> None:
        if sent.number not in self.under_way:
            return
        if self._is_given_up(sent.number) or sent.expires <= self.engine.now:
            self._give_up(sent.number)
            self._release()
        else:
            self._row.resent += 1
            self._try(sent)

    def _arrive(self, sent: Sent) -> None:
        if sent.number in self.under_way:
            del self.under_way[sent.number]
            self._arrived[sent.number] = sent
            self._release()
            self.engine.activity += 1

    def _release(self) -> None:
        """Hand over what waits for no earlier one any more."""
        for number in sorted(self._arrived):
            for earlier in [n for n in self.under_way if n < number]:
                if not (self.under_way[earlier] and self._is_given_up(earlier)):
                    return
                self._give_up(earlier)
            self.hand_over(self._arrived.pop(number))

    def _is_given_up(self, number: int) -> bool:
        return not self.open or number not in self.writer.history

    def _give_up(self, number: int) -> None:
        del self.under_way[number]
        self._lost()


def channel_between(engine: Engine, writer: Writer, reader: Reader) -> Channel:
    """The way of messages between two ends of different hosts that suit each other."""
    ends = writer.profile, reader.profile
    reliable = all(end.reliability is ReliabilityPolicy.RELIABLE for end in ends)
    return (ReliableChannel if reliable else Channel)(engine, writer, reader)
