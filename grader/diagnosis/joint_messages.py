"""Joints that a message doesn't have: several programs publish on the topic of joint states."""

from __future__ import annotations

import re

from sim.evidence import CallbackError, Message, Recording, Seconds
from sim.evidence.message_text import decoded

JOINT_STATE = "sensor_msgs/msg/JointState"
_LACKS = {
    "IndexError": r"index out of range|is out of bounds for axis",
    "ValueError": r"is not in list|x not in (list|tuple|array)",
    "KeyError": r"",
}


def absent_joint(error: CallbackError, recording: Recording) -> str:
    """A callback failed on a JointState that has fewer joints than another one; "" for other errors."""
    lacks = _LACKS.get(error.type)
    if lacks is None or not re.search(lacks, error.text):
        return ""
    received = _states(recording, error.node, error.stamp)
    names = [list(message.name) for item in received if (message := decoded(item)) is not None]
    if not names or len(names[-1]) >= max(map(len, names)):
        return ""
    absent = {name for row in names for name in row} - set(names[-1])
    if error.type == "KeyError" and error.text.strip("'\"") not in absent:
        return ""  # it isn't the message that lacks this key, but a dictionary of the program
    last, has = received[-1], " and ".join(names[-1])
    return (
        f"The message on {last.topic} at {last.stamp:.3g} s has only {has}: "
        "several programs publish there, each its own joints. Look each joint up by its name: `for name, "
        "position in zip(msg.name, msg.position)`."
    )


def _states(recording: Recording, node: str, until: Seconds) -> list[Message]:
    """The joint states that a node could receive until a stamp."""
    topics = {end.name for end in recording.graph.subscriptions() if end.node == node}
    sent = (item for item in recording.published if item.topic in topics and item.type == JOINT_STATE)
    return [item for item in sent if item.stamp <= until]
