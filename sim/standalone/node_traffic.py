"""The messages that a robot's own nodes publish and receive, observed in the robot's process."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Any, NamedTuple

from sim.ros.messages.codec import type_name
from sim.ros.messages.decoder import decode

RATE_PERIOD = 2.0  # s
OBSERVED = "_ros2_course_observed"  # attribute of a publisher or subscription


class ObservedMessage(NamedTuple):
    """A message with the time (s) of the world when it was published or received.

    content: the message object, or its bytes, which robots publish.
    """

    topic: str
    type: str
    stamp: float
    content: Any

    @property
    def message(self) -> Any:
        """The message object."""
        return decode(self.type, self.content) if isinstance(self.content, bytes) else self.content


class NodeTraffic:
    """Counts the messages of nodes, and passes each on to `on_message`.

    It adds no subscriptions, which other processes would see in the graph.
    """

    def __init__(self, clock: Callable[[], float], on_message: Callable[[ObservedMessage], None]) -> None:
        self._clock, self._on_message = clock, on_message
        self._counts: dict[str, int] = {}
        self._earlier: deque[tuple[float, dict[str, int]]] = deque()  # counts at earlier times

    def observe(self, node: Any) -> None:
        """Observe all publishers and subscriptions that the node has by now."""
        for publisher in node.publishers:
            if not hasattr(publisher, OBSERVED):
                setattr(publisher, OBSERVED, True)
                publisher.publish = self._wrapped(publisher, publisher.publish)
        for subscription in node.subscriptions:
            if not hasattr(subscription, OBSERVED):
                setattr(subscription, OBSERVED, True)
                subscription.callback = self._wrapped(subscription, subscription.callback)

    def _wrapped(self, endpoint: Any, act: Callable[[Any], None]) -> Callable[[Any], None]:
        topic, kind = endpoint.topic_name, type_name(endpoint.msg_type)

        def act_and_note(message: Any) -> None:
            act(message)
            self._counts[topic] = self._counts.get(topic, 0) + 1
            self._on_message(ObservedMessage(topic, kind, self._clock(), message))

        return act_and_note

    def topics(self, kinds: dict[str, str]) -> list[dict[str, Any]]:
        """Name, type, number of messages and rate (Hz) of each topic. kinds: types by name."""
        now = self._clock()
        self._earlier.append((now, dict(self._counts)))
        while len(self._earlier) > 2 and now - self._earlier[1][0] >= RATE_PERIOD:
            self._earlier.popleft()
        since, before = self._earlier[0]
        period = now - since
        return [
            {
                "name": name,
                "type": kind,
                "count": self._counts.get(name, 0),
                "rate": (self._counts.get(name, 0) - before.get(name, 0)) / period if period > 0 else 0.0,
            }
            for name, kind in kinds.items()
        ]
