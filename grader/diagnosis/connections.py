"""Ends of one topic that don't connect."""

from __future__ import annotations

from itertools import product

from sim.evidence import Recording
from sim.evidence.qos import offer, refusal


def incompatible_qos(recording: Recording) -> str:
    """A subscription that asks for more than the publisher offers: ROS then connects nothing."""
    for publisher, subscription in product(recording.graph.publishers(), recording.graph.subscriptions()):
        found = refusal(publisher.qos, subscription.qos) if publisher.name == subscription.name else None
        if found is not None:
            policy, offered, wanted = found
            return (
                f"On {publisher.name} the QoS doesn't fit: {publisher.node} publishes "
                f"{offer(policy, offered)}, {subscription.node} asks for {wanted}, so nothing arrives. "
                f"Use the same {policy} at both ends."
            )
    return ""
