"""Whose a topic, service or action is: what our programs publish on or serve is left to them."""

from __future__ import annotations

from typing import NamedTuple

from grader.diagnosis.bundled import bundled_nodes
from sim.evidence import INFRASTRUCTURE_TOPICS, Recording

# Many publish here, each for frames of its own.
COMMON_TOPICS = INFRASTRUCTURE_TOPICS | {"/tf", "/tf_static"}
KINDS = {"publisher": "publisher on", "service": "server of", "action server": "server of"}
LEAVE_IT = "Other nodes can't tell the two apart: use a name of your own, or only subscribe."


class Intrusion(NamedTuple):
    """A student's end where only another program should have one: full names of the nodes, and the words."""

    name: str  # of the topic, service or action
    owner: str
    student: str
    what: str  # "publisher on"


def owned(recording: Recording, kind: str) -> dict[str, str]:
    """Names that the course's programs publish on or serve, each with its node. kind: as in `Endpoint`."""
    bundled = bundled_nodes(recording)
    ends = (
        end
        for end in recording.graph.ends(kind)
        if end.from_course and end.node not in bundled and end.name not in COMMON_TOPICS
    )
    return {end.name: end.node for end in ends}


def intrusions(recording: Recording) -> list[Intrusion]:
    """Return where a student's program publishes or serves what another program does, one for each name."""
    found: dict[str, Intrusion] = {}
    sent = {received.topic for received in recording.published if not received.from_course}
    for kind, what in KINDS.items():
        owners = owned(recording, kind)
        for end in recording.graph.ends(kind):
            silent = kind == "publisher" and end.name not in sent
            if not end.from_course and end.name in owners and not silent:
                found.setdefault(end.name, Intrusion(end.name, owners[end.name], end.node, what))
    return list(found.values())


def two_owners(recording: Recording) -> str:
    """A topic, service or action that a program of the course and one of the student's own."""
    found = intrusions(recording)
    if not found:
        return ""
    name, owner, student, what = found[0]
    return f"Two {what.replace(' ', 's ', 1)} {name}: {owner}, and your {student}. {LEAVE_IT}"
