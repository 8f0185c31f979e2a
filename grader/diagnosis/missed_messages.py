"""Messages that were gone before the node that waits for them could take them."""

from __future__ import annotations

from sim.evidence import SPUN, Endpoint, Message, Recording

_LATCHED = "transient_local"


def sent_before_spinning(recording: Recording) -> str:
    """A subscription whose topic had all its messages before its node existed or spun."""
    took = {run.node for run in recording.callbacks if run.kind == "subscription"}
    spun = {row.node: row.stamp for row in recording.node_facts if row.fact == SPUN}
    for end in recording.graph.subscriptions():
        if end.node in took or end.node not in spun or end.node in recording.course_nodes:
            continue
        messages = [row for row in recording.messages(end.name) if row.sender != end.node]
        if not messages or any(row.from_course for row in messages):
            continue
        last = messages[-1]
        if last.stamp <= spun[end.node]:
            return _sentence(recording, end, messages)
    return ""


def _sentence(recording: Recording, end: Endpoint, messages: list[Message]) -> str:
    last = messages[-1]
    sent = f"the last of {len(messages)} messages" if len(messages) > 1 else "its only message"
    begin = f"{last.sender} sent {sent} on {end.name} at {last.stamp:.3g} s"
    lifespan = _lifespan(recording, end)
    if lifespan:
        return (
            f"{begin}, and it expired before {end.node} received it: the lifespan is {lifespan:g} s. Spin "
            "the node from the start, or use a longer lifespan."
        )
    return (
        f"{begin}, before {end.node} could receive it. What is sent before a subscription exists and is "
        "discovered is lost: publish from a timer, or latch the message (durability transient_local at both "
        "ends)."
    )


def _lifespan(recording: Recording, end: Endpoint) -> float:
    """Return what a message was too old for, s: the subscription, or its latching publisher; else 0."""
    ends = [end]
    if end.qos.get("durability") == _LATCHED:
        ends += [each for each in recording.graph.publishers(end.name) if each.qos["durability"] == _LATCHED]
    limits = [limit for each in ends if (limit := each.qos.get("lifespan")) and limit > 0]
    return min(limits, default=0.0)
