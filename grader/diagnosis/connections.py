"""Ends of one topic that don't connect."""

from __future__ import annotations

from collections import Counter
from itertools import product

from sim.evidence import Endpoint, Recording, UndeliveredMessage
from sim.evidence.qos import offer, refusal

STREAM = 10  # more messages of one node on a topic are a stream: the first one is not what others wait for


def incompatible_qos(recording: Recording) -> str:
    """A subscription that requests more than the publisher offers: ROS then connects nothing.

    Between the course's programs it is what the exercise is about.
    """
    for publisher, subscription in product(recording.graph.publishers(), recording.graph.subscriptions()):
        found = refusal(publisher.qos, subscription.qos) if publisher.name == subscription.name else None
        if found is not None and not (publisher.from_course and subscription.from_course):
            policy, offered, wanted = found
            return (
                f"On {publisher.name} the QoS settings are incompatible: {publisher.node} publishes "
                f"{offer(policy, offered)}, {subscription.node} requests {wanted}, so nothing arrives. An "
                f"offer has to be at least as strong as the request: {_fix(publisher, subscription, found)}."
            )
    return ""


def _fix(publisher: Endpoint, subscription: Endpoint, found: tuple[str, str, str]) -> str:
    """Return what the student can change, at one end or at either, so that the two fit."""
    policy, offered, wanted = found
    is_time = wanted.endswith(" s")
    better = f"offer {f'{policy} {wanted} or less' if is_time else wanted}"
    weaker = f"request {f'{offered} or more' if is_time and offered else offered or f'no {policy}'}"
    ends = [(publisher, better), (subscription, weaker)]
    return ", or ".join(change for end, change in ends if not end.from_course)


def publisher_for_each_message(recording: Recording, topic: str | None = None) -> str:
    """Publishers that are made for a message each, most of which come before anybody has found them.

    topic: one, or all. A node that waits before it publishes is received, and is not meant.
    """
    made = Counter((end.node, end.name) for end in recording.graph.publishers(topic) if not end.from_course)
    for (node, name), publishers in made.items():
        messages = recording.messages(name, node)
        lost = sum(received.early for received in messages)
        if publishers > 1 and lost > max(1, len(messages) / 2):
            return (
                f"{node} created {publishers} publishers on {name} for {len(messages)} messages. Two "
                "programs need a moment to discover each other, and what a new publisher sends right away is "
                "lost: create it once, in __init__, and use it for every message."
            )
    return ""


def published_too_early(recording: Recording) -> str:
    """A message that is sent the moment its publisher or a subscription was created, and reaches no node."""
    return _too_early([row for row in recording.undelivered if _is_loss(recording, row)])


def only_message_too_early(recording: Recording) -> str:
    """Work like `published_too_early`, unless the message is the first of a stream."""
    rows = [row for row in recording.undelivered if _is_loss(recording, row)]
    return _too_early([row for row in rows if len(recording.messages(row.topic, row.node)) <= STREAM])


def _too_early(lost: list[UndeliveredMessage]) -> str:
    if not lost:
        return ""
    early = lost[0]
    return (
        f"{early.node} published on {early.topic} at {early.stamp:.3g} s, before its subscribers had "
        "discovered it: two programs need a moment to discover each other, and what is sent before that is "
        "lost. Create the publisher once, in __init__, and publish from a timer; or latch it (durability "
        "transient_local at both ends)."
    )


def _is_loss(recording: Recording, row: UndeliveredMessage) -> bool:
    """Return whether a student's node never repeats what reached no node, not even 20 times a second."""
    if row.node in recording.course_nodes:
        return False
    said = [received for received in recording.messages(row.topic, row.node) if received.stamp >= row.stamp]
    return all(again.raw != said[0].raw for again in said if again.stamp > row.stamp)
