"""Synchronizers of message_filters that never had a set of messages whose stamps match."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import Any


def unmatched_topics(node: Any) -> Iterator[list[str]]:
    """The topics of each synchronizer of a node that got messages of all of them, and passed none on."""
    filters = sys.modules.get("message_filters")
    found: dict[int, tuple[Any, list[str]]] = {}
    for subscription in node.subscriptions if filters is not None else ():
        source = getattr(subscription.callback, "__self__", None)
        for callback, _ in source.callbacks.values() if isinstance(source, filters.Subscriber) else ():
            synchronizer = getattr(callback, "__self__", None)
            if isinstance(synchronizer, filters.TimeSynchronizer):
                topics = found.setdefault(id(synchronizer), (synchronizer, []))[1]
                topics.append(subscription.topic_name)
    for synchronizer, topics in found.values():
        inputs = synchronizer.queues
        if len(topics) == len(inputs) and all(inputs) and not synchronizer.passed_on:
            yield topics
