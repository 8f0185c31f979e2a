"""`RunData`: everything that a run records, as plain data."""

from __future__ import annotations

from dataclasses import dataclass, field

from sim.evidence.crossings import Crossing
from sim.evidence.exchanges import Call, Goal
from sim.evidence.graph import Graph
from sim.evidence.rows import (
    STILL_RUNNING,
    BusyLoop,
    CallbackError,
    CallbackRun,
    Departure,
    Ended,
    LogLine,
    Message,
    NodeFact,
    ParameterName,
    Pose,
    Seconds,
    UndeliveredMessage,
)
from sim.nanoseconds import EPOCH, Nanoseconds
from sim.network import Network
from sim.world import Contact, PenDrawing, World


@dataclass
class RunData:
    """The data of a run; `Recording` adds how to look at it."""

    world: World | None = None  # None for a run without a robot
    seconds: Seconds = 0.0
    seed: int = 0
    stamp: Seconds = 0.0  # how far the run has come
    published: list[Message] = field(default_factory=list)
    calls: list[Call] = field(default_factory=list)  # of services, in the order of their requests
    goals: list[Goal] = field(default_factory=list)  # of actions, in the order of their requests
    path: list[Pose] = field(default_factory=list)
    # the same of everything else that moves, by the name of its `Body`: other robots, boxes, links
    tracks: dict[str, list[Pose]] = field(default_factory=dict)
    contacts: list[Contact] = field(default_factory=list)
    # the same of the robots beside the first, by name
    other_contacts: dict[str, list[Contact]] = field(default_factory=dict)
    drawing: PenDrawing | None = None  # what pens drew; None without a pen
    logs: list[LogLine] = field(default_factory=list)
    errors: list[CallbackError] = field(default_factory=list)
    callbacks: list[CallbackRun] = field(default_factory=list)
    busy_loops: list[BusyLoop] = field(default_factory=list)
    undelivered: list[UndeliveredMessage] = field(default_factory=list)  # the first of each node and topic
    parameters: list[ParameterName] = field(default_factory=list)  # that nodes are given, or declare
    prints: list[tuple[Seconds, str]] = field(default_factory=list)  # what went to stdout
    stderr: str = ""  # what went there, other than log lines
    graph: Graph = field(default_factory=Graph)
    ended: Ended = STILL_RUNNING
    # when the last of the student's programs had exited; None if one was running at the end
    all_exited_at: Seconds | None = None
    begin: Seconds = 0.0  # later than 0 in what `during` gives
    # full names of the course's nodes: the robot, the world, the companions of a scenario
    course_nodes: set[str] = field(default_factory=set)
    shared: set[str] = field(default_factory=set)  # names that a course node and a student's node both have
    course_errors: list[CallbackError] = field(default_factory=list)  # raised in programs of the course
    end_errors: list[CallbackError] = field(default_factory=list)  # left a main() after the Ctrl-C at the end
    end_prints: list[tuple[Seconds, str]] = field(default_factory=list)  # went to stdout after that
    end_logs: list[LogLine] = field(default_factory=list)  # were written after that
    network: Network | None = None  # between hosts; None where all programs run on one
    hosts: dict[str, str] = field(default_factory=dict)  # of the nodes, where there is a network
    crossings: list[Crossing] = field(default_factory=list)  # what became of messages on the network
    node_facts: list[NodeFact] = field(default_factory=list)  # for the diagnosis; no part of the digest
    order: str = ""  # the text of the `Order` in which it ran; empty for the usual one
    departures: list[Departure] = field(default_factory=list)  # what that order made differently
    epoch: Nanoseconds = EPOCH  # what clocks showed at the start, since 1970: another time if a bag is played
