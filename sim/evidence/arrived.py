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
    last: dict[tuple[str, str], Nanoseconds] = {}
    found = _kept(run, topic, sent, ends, begin)
    for message in sent:
        if begin and message.stamp <= begin:  # at that very moment, two programs don't know each other yet
            continue
        now = round(message.stamp * SECOND)
        arrivals = [now]
        for end in ends:
            if run.hosts.get(message.sender) != run.hosts.get(end.node):
                continue  # the network between the hosts delays it, and not the order
            _, delay = order.delay(now, message.sender, topic, end.node)
            pair = message.sender, end.node
            last[pair] = max(now + delay, last.get(pair, now))
            arrivals.append(last[pair])
        if max(arrivals) <= round(run.ended.stamp * SECOND):
            found.append(message._replace(stamp=max(arrivals) / SECOND))
    return found


def _kept(
    run: RunData, topic: str, sent: Sequence[Message], ends: Sequence[Endpoint], begin: Seconds
) -> list[Message]:
    """Of the messages until the nodes' start, those that a latched publisher sent them then."""
    if not any(end.qos.get("durability") == LATCHED for end in ends):
        return []
    kept: list[Message] = []
    for publisher in run.graph.publishers(topic):
        if publisher.from_course and publisher.qos.get("durability") == LATCHED:
            own = [row for row in sent if row.sender == publisher.node and row.stamp <= begin]
            kept += own[-(publisher.qos.get("depth") or 1) :]
    return [row._replace(stamp=begin) for row in sorted(kept, key=lambda row: row.stamp)] if begin else []
