"""What is published in a run goes straight into the queues of the run's subscriptions, as bytes.

The middleware knows all ends of topics as well, for the graph and for QoS events. It carries messages only on
topics on which C++ code publishes; and on all where the environment says so, for tests: the same comes of it.
"""

from __future__ import annotations

import os
from collections import Counter, defaultdict
from typing import TYPE_CHECKING, Any

from sim.ros.transport.middleware import MiddlewareReader, MiddlewareWriter
from sim.ros.transport.reader import Reader
from sim.ros.transport.writer import Writer

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine

MIDDLEWARE = "SIM_MIDDLEWARE"  # with this variable in the environment, the middleware carries all messages
CPP_TOPICS = "/transition_event", "/_service_event"


class Topics:
    """All ends of topics in one run.

    sent: how many messages nodes have published on each topic; those of C++ code are not counted.
    """

    def __init__(self, engine: Engine) -> None:
        self.sent: Counter[str] = Counter()
        self._engine = engine
        self._all_carried = MIDDLEWARE in os.environ and engine.post is None
        self._writers: dict[str, list[Writer]] = defaultdict(list)
        self._readers: dict[str, list[Reader]] = defaultdict(list)

    def writer(self, *end: Any, topic: str, **more: Any) -> Writer:
        """A new publisher's end; the arguments are those of `Writer`."""
        kind = MiddlewareWriter if self._is_carried(topic) else Writer
        writer = kind(self._engine, *end, topic=topic, **more)
        self._writers[topic].append(writer)
        for reader in self._readers[topic]:
            writer.match(reader)
        return writer

    def reader(self, *end: Any, topic: str, kind: type[Reader] = Reader, **more: Any) -> Reader:
        """A new subscription's end; the arguments are those of `Reader`, or of this kind of it."""
        kind = MiddlewareReader if self._is_carried(topic) else kind
        reader = kind(self._engine, *end, topic=topic, **more)
        self._readers[topic].append(reader)
        for writer in self._writers[topic]:
            writer.match(reader)
        return reader

    def reader_of(self, topic: str, handle: Any) -> Reader | None:
        """The end of the subscription that has this handle."""
        return next((reader for reader in self._readers[topic] if reader.handle is handle), None)

    def remove(self, end: Writer | Reader) -> None:
        """Forget an end that was destroyed; again does nothing."""
        writers = self._writers[end.topic]
        for ends in (writers, self._readers[end.topic]):
            if end in ends:
                ends.remove(end)
        if isinstance(end, Reader):
            for writer in writers:
                writer.unmatch(end)

    def _is_carried(self, topic: str) -> bool:
        """Whether C++ code publishes there: log lines, actions, states of lifecycle nodes, calls."""
        by_cpp = topic == "/rosout" or "/_action/" in topic or topic.endswith(CPP_TOPICS)
        return by_cpp or self._all_carried
