"""What became of messages on their way from one host to another."""

from __future__ import annotations

from dataclasses import dataclass

from sim.evidence.rows import Seconds


@dataclass(slots=True)
class Crossing:
    """All messages from one node to another of another host, on one topic.

    What is neither lost nor expired has arrived, or was still under way in the end.
    """

    topic: str
    sender: str  # full names of the two nodes
    listener: str
    sent: int = 0
    lost: int = 0  # they never arrived, or an earlier one had overtaken them
    resent: int = 0  # times that a reliable message was lost, and sent again
    expired: int = 0  # they arrived when their lifespan was over
    late: Seconds = 0.0  # the longest that one was on its way, from publish() to the subscription's queue
