"""When messages arrive in another order than the usual one: some are late, and none overtakes its like."""

from __future__ import annotations

from typing import Protocol

from sim.nanoseconds import SECOND, Nanoseconds
from sim.order import HOST
from sim.ros.fibers.choices import Choices
from sim.ros.fibers.fiber import Program


class PublisherEnd(Protocol):
    """The part of a publisher's endpoint that matters here; as of DataWriter."""

    program: Program | None
    sender: str
    topic: str
    from_course: bool


class SubscriptionEnd(Protocol):
    """The part of a subscription's endpoint that matters here; as of DataReader."""

    program: Program | None
    subscriber: str


class Arrivals:
    """The arrival times of one run's messages between programs on the same side of a network.

    One publisher's messages arrive at one subscription in the order in which they were sent. On one machine
    that holds for all that one node sends to another, whatever the topic.
    """

    def __init__(self, choices: Choices) -> None:
        self._choices = choices
        self._last: dict[tuple[str, ...], Nanoseconds] = {}
        self._kept: dict[tuple[str, ...], Nanoseconds] = {}

    def at(self, writer: PublisherEnd, reader: SubscriptionEnd, now: Nanoseconds) -> Nanoseconds:
        """Return when a message that is sent now arrives."""
        if self._is_fixed(writer, reader):
            return now
        pair = writer.sender, reader.subscriber
        draw, delay = self._choices.order.delay(now, pair[0], writer.topic, pair[1])
        if delay:
            text = f"{writer.topic} of {pair[0]} reaches {pair[1]} {1000 * delay / SECOND:.1f} ms later"
            self._choices.note_departure(draw, pair[1], "message", text)
        key = pair if self._choices.order.level == HOST else (*pair, writer.topic)
        arrival = self._last[key] = max(now + delay, self._last.get(key, now))
        return max(arrival, self._kept.get((*pair, writer.topic), now))

    def kept_at(self, writer: PublisherEnd, reader: SubscriptionEnd, now: Nanoseconds) -> Nanoseconds:
        """Return when what a latched topic has kept arrives at a subscription that is found now.

        It is sent apart from new messages, so that those of other topics may come first.
        """
        if self._is_fixed(writer, reader):
            return now
        pair = writer.sender, reader.subscriber
        draw, delay = self._choices.order.kept_delay(pair[0], writer.topic, pair[1])
        if delay:
            late = f"{1000 * delay / SECOND:.1f} ms later"
            text = f"{writer.topic}, which {pair[0]} has stored, reaches {pair[1]} {late}"
            self._choices.note_departure(draw, pair[1], "message", text)
        arrival = self._kept[*pair, writer.topic] = now + delay
        return arrival

    @staticmethod
    def _is_fixed(writer: PublisherEnd, reader: SubscriptionEnd) -> bool:
        """Return whether no message is late: within one program, and between the course's own."""
        if writer.program is not None and writer.program is reader.program:
            return True
        return writer.from_course and reader.program is not None and reader.program.from_course
