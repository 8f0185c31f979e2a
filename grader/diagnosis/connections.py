"""Ends of one topic that don't connect."""

from __future__ import annotations

from itertools import product

from sim.evidence import Endpoint, Recording

# Per policy: what the publisher offers and the subscription asks for when they don't match.
_MISMATCHES = (
    ("reliability", "best_effort", "reliable"),
    ("durability", "volatile", "transient_local"),
)


def incompatible_qos(recording: Recording) -> str:
    """A subscription that asks for more than the publisher offers: ROS then connects nothing."""
    for publisher, subscription in _pairs(recording):
        for policy, offered, wanted in _MISMATCHES:
            if _value(publisher, policy) == offered and _value(subscription, policy) == wanted:
                return (
                    f"On {publisher.name} the QoS doesn't fit: {publisher.node} publishes with "
                    f"{policy} {offered}, "
                    f"{subscription.node} asks for {wanted}, so nothing arrives. Use the same "
                    f"{policy} at both ends."
                )
    return ""


def _pairs(recording: Recording) -> list[tuple[Endpoint, Endpoint]]:
    ends = product(recording.graph.publishers(), recording.graph.subscriptions())
    return [
        (publisher, subscription) for publisher, subscription in ends if publisher.name == subscription.name
    ]


def _value(endpoint: Endpoint, policy: str) -> str:
    return str(endpoint.qos.get(policy, "")).lower()
