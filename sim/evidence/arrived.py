"""When messages arrived in another order than the usual one, as far as the order alone decides it."""

from __future__ import annotations

from collections.abc import Sequence

from sim.evidence.graph import Endpoint
from sim.evidence.rows import Message, Seconds
from sim.evidence.run_data import RunData
from sim.nanoseconds import SECOND, Nanoseconds
from sim.order import Order

LATCHED = "transient_local"


def arrived(run: RunData, topic: str, sent: Sequence[Message], order: Order, begin: Seconds) -> list[Message]:
    """The course's messages on a topic, with the stamps at which the last node under test received them.

    begin: when those nodes started. What was sent until then is left out, but for what a latched topic keeps.
    It is computed from the order, so that no program can claim that a message came late.
    """
    ends = [end for end in run.graph.subscriptions(topic) if not end.from_course]
    kept = _kept_messages(run, topic, sent, begin)
    last: dict[tuple[str, str], Nanoseconds] = {}
    found = [message._replace(stamp=_kept_at(run, message, ends, order, begin) / SECOND) for message in kept]
    for message in sent:
        if any(message is other for other in kept) or (begin and message.stamp <= begin):
            continue  # what is not kept finds no subscription at that moment
        now = round(message.stamp * SECOND)
        arrivals = [now, _kept_at(run, message, ends, order, begin) if kept else now]
        for end in _same_host(run, message, ends):
            _, delay = order.delay(now, message.sender, topic, end.node)
            pair = message.sender, end.node
            last[pair] = max(now + delay, last.get(pair, now))
            arrivals.append(last[pair])
        found.append(message._replace(stamp=max(arrivals) / SECOND))
    return [message for message in found if message.stamp <= run.ended.stamp]


def _same_host(run: RunData, message: Message, ends: Sequence[Endpoint]) -> list[Endpoint]:
    """The subscriptions on the sender's host: other messages are delayed by the network, not by the order."""
    return [end for end in ends if run.hosts.get(message.sender) == run.hosts.get(end.node)]


def _kept_at(
    run: RunData, message: Message, ends: Sequence[Endpoint], order: Order, begin: Seconds
) -> Nanoseconds:
    """Return when the last of the nodes under test has what this message's sender kept on its topic."""
    delays = [
        order.kept_delay(message.sender, message.topic, end.node)[1] for end in _same_host(run, message, ends)
    ]
    return round(begin * SECOND) + max(delays, default=0)


def _kept_messages(run: RunData, topic: str, sent: Sequence[Message], begin: Seconds) -> list[Message]:
    """Of the messages until the nodes' start, those that a latched publisher sent them then."""
    latched = (
        end.qos.get("durability") == LATCHED for end in run.graph.subscriptions(topic) if not end.from_course
    )
    kept: list[Message] = []
    for publisher in run.graph.publishers(topic) if any(latched) else ():
        if publisher.from_course and publisher.qos.get("durability") == LATCHED:
            own = [row for row in sent if row.sender == publisher.node and row.stamp <= begin]
            kept += own[-(publisher.qos.get("depth") or 1) :]
    return sorted(kept, key=lambda row: row.stamp)
