"""What is evidence: what the world, the robot and our nodes did, and what a student's program did to them.

Messages of a student's program on a topic that another program publishes on, and calls and goals between a
student's own nodes, are staged: checks never see them. Nor do they see a log line that is too long to be an
answer: it could have all answers in it.
"""

from __future__ import annotations

from dataclasses import replace

from grader.diagnosis.owners import KINDS, owned
from sim.evidence import Call, Goal, LogLine, Recording

LONGEST_LINE = 400  # characters
TOO_LONG = "(a line too long to be an answer)"


def evidence_of(recording: Recording) -> Recording:
    """The recording without what was staged."""
    names = {kind: owned(recording, kind) for kind in KINDS}
    ends = [
        end for end in recording.graph.endpoints if end.from_course or end.name not in names.get(end.kind, ())
    ]
    return replace(
        recording,
        published=[
            received
            for received in recording.published
            if received.from_course or received.topic not in names["publisher"]
        ],
        calls=[call for call in recording.calls if not _among_themselves(call)],
        goals=[goal for goal in recording.goals if not _among_themselves(goal)],
        logs=_without_long_lines(recording.logs),
        graph=replace(recording.graph, endpoints=ends),
    )


def _without_long_lines(lines: list[LogLine]) -> list[LogLine]:
    """Leave the long ones out; but a node that wrote nothing else must not read that it wrote nothing."""
    short = [line for line in lines if line.from_course or len(line.text) <= LONGEST_LINE]
    if any(not line.from_course for line in short):
        return short
    return [line if line in short else line._replace(text=TOO_LONG) for line in lines]


def _among_themselves(exchange: Call | Goal) -> bool:
    """Return whether a student's node asked, and a student's node took it."""
    return bool(exchange.server) and not (exchange.requested_by_course or exchange.served_by_course)
