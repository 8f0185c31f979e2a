"""Transforms that a listener can't use: without a time, or from two nodes that contradict each other."""

from __future__ import annotations

from itertools import combinations
from typing import NamedTuple

from sim.evidence import Recording, Seconds

_TF = "/tf"


class Sent(NamedTuple):
    """The messages in which a node sent one transform, and whether all had the stamp 0."""

    stamps: list[Seconds]
    unstamped: list[bool]


def zero_stamp(recording: Recording) -> str:
    """A node that sends a moving transform, and never sets its stamp."""
    for (_, parent, child, sender), sent in _transforms(recording).items():
        if sender not in recording.course_nodes and all(sent.unstamped):
            return (
                f"{sender} sends the transform {parent} -> {child} with the stamp 0, so a lookup for any "
                "other time finds none. Set it each time, before sendTransform(): `t.header.stamp = "
                "self.get_clock().now().to_msg()`."
            )
    return ""


def two_broadcasters(recording: Recording) -> str:
    """Two nodes that send the transform to the same child frame in turns."""
    for (one, first), (other, second) in combinations(_transforms(recording).items(), 2):
        (topic, parent, child, sender), (topic_2, parent_2, child_2, sender_2) = one, other
        apart = sender == sender_2 or (topic, child) != (topic_2, child_2)
        if apart or {sender, sender_2} <= recording.course_nodes or not _overlap(first.stamps, second.stamps):
            continue
        which = f"{parent} -> {child}" if parent == parent_2 else f"to {child} (from {parent} and {parent_2})"
        return (
            f"{sender} and {sender_2} both send the transform {which} on {topic}, and listeners get now one, "
            "now the other. Only one node may send the transform of a frame: give the frames of two robots "
            "a prefix, or stop one of the nodes."
        )
    return ""


def _overlap(one: list[Seconds], other: list[Seconds]) -> bool:
    """Return whether each of two nodes went on sending after the other had begun."""
    return one[-1] > other[0] and other[-1] > one[0]


def _transforms(recording: Recording) -> dict[tuple[str, str, str, str], Sent]:
    """Topic, parent frame, child frame and sender of each transform, with its messages."""
    found: dict[tuple[str, str, str, str], Sent] = {}
    topics = {row.topic for row in recording.published if row.topic.endswith(_TF)}
    for message in (message for topic in sorted(topics) for message in recording.messages(topic)):
        for transform in getattr(message.message, "transforms", ()):
            header = transform.header
            key = (message.topic, header.frame_id, transform.child_frame_id, message.sender)
            sent = found.setdefault(key, Sent([], []))
            sent.stamps.append(message.stamp)
            sent.unstamped.append(header.stamp.sec == header.stamp.nanosec == 0)
    return found
