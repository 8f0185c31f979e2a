"""Indexes a growing list of messages by topic, because `until` reads the same topics many times a second."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

from sim.evidence.rows import Message


class ByTopic:
    """Reads each message once, however often it is queried; another list is read from its start."""

    def __init__(self, messages: Sequence[Message] = ()) -> None:
        self._last: Message | None = None  # the message that was read last
        self._topics: defaultdict[str, list[Message]] = defaultdict(list)
        self._begin(messages)

    def _begin(self, messages: Sequence[Message]) -> None:
        self._messages, self._seen, self._last = messages, 0, None
        self._topics.clear()

    def __reduce__(self) -> tuple[type[ByTopic], tuple[()]]:
        return ByTopic, ()  # a copy of a recording builds its own index

    def of(self, messages: Sequence[Message], topic: str) -> list[Message]:
        """Return a new list of the messages of one topic, in their order."""
        same = messages is self._messages and len(messages) >= self._seen
        if not same or (self._seen and messages[self._seen - 1] is not self._last):
            self._begin(messages)
        for message in messages[self._seen :]:
            self._topics[message.topic].append(message)
        self._seen, self._last = len(messages), messages[-1] if messages else None
        return self._topics.get(topic, []).copy()
