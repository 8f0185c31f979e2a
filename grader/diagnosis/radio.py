"""What a network between two hosts did to messages: true of right programs, too, which are made for it."""

from __future__ import annotations

from sim.evidence import Crossing, Recording

NOTABLY_LATE = 0.5  # s


def lost_on_the_network(recording: Recording) -> str:
    """Messages that never arrived, though both ends fit."""
    lossy = [row for row in _of_students(recording) if row.lost]
    if not lossy:
        return ""
    row = max(lossy, key=lambda row: row.lost)
    said = (
        f"{row.lost} of {row.sent} messages on {row.topic} from {row.sender} to {row.listener} "
        f"{'were' if row.lost > 1 else 'was'} lost on the network: "
    )
    if _is_reliable(recording, row):
        return said + (
            "both ends are reliable, but newer messages pushed them out of the publisher's history before "
            "they could be sent again. A larger depth keeps them longer."
        )
    return said + (
        "with reliability best_effort at one end, nothing is sent again. Messages that must arrive need "
        "reliable at both ends."
    )


def late_on_the_network(recording: Recording) -> str:
    """Messages that arrived late because earlier ones had to be sent again."""
    late = [row for row in _of_students(recording) if row.resent and row.late >= NOTABLY_LATE]
    if not late:
        return ""
    row = max(late, key=lambda row: row.late)
    return (
        f"On {row.topic} a message from {row.sender} reached {row.listener} {row.late:.1f} s late: the "
        "network lost some, and with reliable at both ends all others wait until these have been sent again. "
        "Where only the newest message counts, use best_effort."
    )


def _of_students(recording: Recording) -> list[Crossing]:
    return [row for row in recording.crossings if not {row.sender, row.listener} <= recording.course_nodes]


def _is_reliable(recording: Recording, row: Crossing) -> bool:
    graph = recording.graph
    ends = [
        *(end for end in graph.publishers(row.topic) if end.node == row.sender),
        *(end for end in graph.subscriptions(row.topic) if end.node == row.listener),
    ]
    return all(end.qos["reliability"] == "reliable" for end in ends)
