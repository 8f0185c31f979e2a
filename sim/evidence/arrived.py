"""When messages arrived in another order than the usual one, as far as the order alone decides it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from sim.evidence.rows import Message, Seconds
from sim.nanoseconds import SECOND, Nanoseconds
from sim.order import Order


def arrived(
    sent: Sequence[Message], receivers: Iterable[str], order: Order, begin: Seconds, end: Seconds
) -> list[Message]:
    """Messages on one topic, with the stamps at which the last of these nodes received them.

    begin: what is sent until then is left out, for the nodes had not started. end: of the run.
    It is computed from the order, so that no program can claim that a message came late.
    """
    last: dict[tuple[str, str], Nanoseconds] = {}
    found = []
    for message in sent:
        if begin and message.stamp <= begin:  # at that very moment, two programs don't know each other yet
            continue
        now = round(message.stamp * SECOND)
        arrivals = [now]
        for receiver in receivers:
            _, delay = order.delay(now, message.sender, message.topic, receiver)
            pair = message.sender, receiver
            last[pair] = max(now + delay, last.get(pair, now))
            arrivals.append(last[pair])
        if max(arrivals) <= round(end * SECOND):
            found.append(message._replace(stamp=max(arrivals) / SECOND))
    return found
