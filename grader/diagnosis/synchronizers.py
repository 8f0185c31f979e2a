"""Synchronizers of message_filters that never call their callback."""

from __future__ import annotations

from sim.evidence import UNMATCHED, Recording, Seconds, since_start
from sim.ros.messages.codec import message_class


def never_met(recording: Recording) -> str:
    """A synchronizer that got messages of all its inputs, but never a set whose stamps match."""
    row = next((row for row in recording.node_facts if row.fact.startswith(UNMATCHED)), None)
    if row is None or row.node in recording.course_nodes:
        return ""
    topics = row.fact.removeprefix(UNMATCHED).split()
    names = " and ".join(topics)
    begin = f"The callback of {row.node}'s synchronizer never ran: the stamps of {names} never meet."
    stamps = {topic: _stamps(recording, topic) for topic in topics}
    unset = [topic for topic, found in stamps.items() if not any(found)]
    if unset:
        return (
            f"{begin} Those of {' and '.join(unset)} are 0: set them before you publish, with "
            "`msg.header.stamp = self.get_clock().now().to_msg()`, or copy the stamp of the message that "
            "yours is made from."
        )
    return (
        f"{begin} The nearest two are {_nearest(list(stamps.values())):.3g} s apart: "
        "ApproximateTimeSynchronizer([a, b], 10, slop) accepts stamps that differ by less than slop, in "
        "seconds."
    )


def _stamps(recording: Recording, topic: str) -> list[Seconds]:
    """The stamps of a topic's messages since the start; 0 for one that was never set."""
    messages = recording.messages(topic)
    if not messages or "header" not in message_class(messages[0].type).get_fields_and_field_types():
        return []
    stamps = [message.message.header.stamp for message in messages]
    return [since_start(stamp) if stamp.sec or stamp.nanosec else 0.0 for stamp in stamps]


def _nearest(stamps: list[list[Seconds]]) -> Seconds:
    """The smallest difference between stamps of the first topic and of another one, s."""
    first, *others = stamps
    return min((abs(one - other) for one in first for each in others for other in each), default=0.0)
