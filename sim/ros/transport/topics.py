"""What is published in a run goes straight into the queues of the run's subscriptions, as bytes.

The middleware knows all endpoints as well, for the graph and for QoS events. It carries messages only on
topics on which C++ code publishes; and, for tests, on all if an environment variable is set, with the same
result.
"""

from __future__ import annotations

import os
from collections import defaultdict
from typing import Any

from sim.ros.transport.context import TransportContext
from sim.ros.transport.endpoint import TopicEndpoint
from sim.ros.transport.middleware import MiddlewareReader, MiddlewareWriter
from sim.ros.transport.reader import DataReader
from sim.ros.transport.writer import DataWriter

MIDDLEWARE = "SIM_MIDDLEWARE"  # with this variable in the environment, the middleware carries all messages
CPP_TOPICS = "/transition_event", "/_service_event"
ROSOUT = "/rosout"


class Topics:
    """All endpoints of topics in one run."""

    def __init__(self, run: TransportContext) -> None:
        self._run = run
        self.sent = run.sent
        self.rosout_wanted = False  # a node has subscribed to /rosout
        self._all_by_middleware = MIDDLEWARE in os.environ and run.links is None
        self._writers: dict[str, list[DataWriter]] = defaultdict(list)
        self._readers: dict[str, list[DataReader]] = defaultdict(list)

    def writer(self, *handles: Any, topic: str, **more: Any) -> DataWriter:
        """A new publisher's endpoint; the arguments are those of `DataWriter`."""
        kind = MiddlewareWriter if self._by_middleware(topic) else DataWriter
        writer = kind(self._run, *handles, topic=topic, on_close=self._remove, **more)
        self._writers[topic].append(writer)
        for reader in self._readers[topic]:
            writer.match(reader)
        return writer

    def reader(
        self, *handles: Any, topic: str, kind: type[DataReader] = DataReader, **more: Any
    ) -> DataReader:
        """A new subscription's endpoint; the arguments are those of `DataReader`, or of this kind of it."""
        kind = MiddlewareReader if self._by_middleware(topic) else kind
        reader = kind(self._run, *handles, topic=topic, on_close=self._remove, **more)
        self._readers[topic].append(reader)
        self.rosout_wanted |= topic == ROSOUT
        for writer in self._writers[topic]:
            writer.match(reader)
        return reader

    def reader_of(self, topic: str, handle: Any) -> DataReader | None:
        """The endpoint of the subscription that has this handle."""
        return next((reader for reader in self._readers[topic] if reader.handle is handle), None)

    def _remove(self, endpoint: TopicEndpoint) -> None:
        """Forget an endpoint that was closed; again does nothing."""
        writers = self._writers[endpoint.topic]
        for endpoints in (writers, self._readers[endpoint.topic]):
            if endpoint in endpoints:
                endpoints.remove(endpoint)
        if isinstance(endpoint, DataReader):
            for writer in writers:
                writer.unmatch(endpoint)

    def _by_middleware(self, topic: str) -> bool:
        """Return whether C++ code publishes there: log lines, actions, states of lifecycle nodes, calls."""
        by_cpp = topic == ROSOUT or "/_action/" in topic or topic.endswith(CPP_TOPICS)
        return by_cpp or self._all_by_middleware
