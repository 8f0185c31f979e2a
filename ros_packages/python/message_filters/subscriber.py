"""The filter at the beginning of every chain: a subscription."""

from __future__ import annotations

from typing import Any

from message_filters.simple_filter import SimpleFilter

DEFAULT_DEPTH = 10


class Subscriber(SimpleFilter):
    """Passes on each message of a topic. Attributes that a filter lacks are those of the subscription."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        """args: node, message type, topic; kwargs: those of `create_subscription`, with a depth of 10."""
        super().__init__()
        self.node, self.topic = args[0], args[2]
        kwargs.setdefault("qos_profile", DEFAULT_DEPTH)
        self.sub = self.node.create_subscription(*args[1:], self.callback, **kwargs)

    def callback(self, msg: Any) -> None:
        """Pass the message on."""
        self.signalMessage(msg)

    def getTopic(self) -> str:
        """The topic's name, as it was given."""
        return self.topic

    def __getattr__(self, key: str) -> Any:
        if key == "sub":  # not made yet
            raise AttributeError(key)
        return getattr(self.sub, key)
