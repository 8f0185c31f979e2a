"""A list of messages that grows, by topic: `until` asks the same of it many times a second."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

from sim.evidence.rows import Heard


class ByTopic:
    """Looks at each message once, however often it is asked; another list, or one that lost some, anew."""

    def __init__(self, heard: Sequence[Heard] = ()) -> None:
        self._heard, self._seen = heard, 0
        self._last: Heard | None = None  # the message that it has come to
        self._topics: defaultdict[str, list[Heard]] = defaultdict(list)

    def __reduce__(self) -> tuple[type[ByTopic], tuple[()]]:
        return ByTopic, ()  # a copy of a recording looks for itself

    def of(self, heard: Sequence[Heard], topic: str) -> list[Heard]:
        """The messages of one topic, in their order, as a list of its own."""
        same = heard is self._heard and len(heard) >= self._seen
        if not same or (self._seen and heard[self._seen - 1] is not self._last):
            self.__init__(heard)
        for message in heard[self._seen :]:
            self._topics[message.topic].append(message)
        self._seen, self._last = len(heard), heard[-1] if heard else None
        return self._topics.get(topic, []).copy()
