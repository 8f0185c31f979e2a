"""What delivery robots did in a run in a warehouse, as plain data: for checks, and to compare them."""

from __future__ import annotations

import dataclasses
from collections import Counter
from typing import Any, NamedTuple

import numpy as np

from grader.checks.motion import length
from sim.evidence import INFRASTRUCTURE_TOPICS, Recording, Seconds
from sim.world import Contact, World
from sim.world.clearance import clearance

_SHELF = 0.005  # m; a touch this near to a box that stands still is one of a shelf


class Job(NamedTuple):
    """One order: when it came, by when it was wanted, and when it was picked up and over; None is never.

    status: waiting, picked up, delivered, expired or canceled, as it was at the end. robot: who picked it up,
    by name; "" where none did.
    """

    id: int
    requested: Seconds
    deadline: Seconds
    picked_up: Seconds | None
    over: Seconds | None
    status: str
    robot: str = ""


class ShiftProgram(NamedTuple):
    """Actions of one of the student's nodes: messages sent by topic, subscriptions, and errors."""

    sent: dict[str, int]
    subscribes: tuple[str, ...]
    errors: int


class Shift(NamedTuple):
    """A run in a warehouse.

    jobs: all orders, oldest first. touched: how often a robot touched a wall, shelf, box, circle, robot or
    person; met_person: when one first touched a person (s), or None. battery: the first robot's: (stamp,
    share from 0 to 1), once a second. way: what the robots drove together, m. programs: by node. A robot that
    drives on a route of the world's is none of these.
    """

    jobs: tuple[Job, ...]
    touched: dict[str, int]
    met_person: Seconds | None
    battery: tuple[tuple[Seconds, float], ...]
    way: float
    programs: dict[str, ShiftProgram]

    @property
    def delivered(self) -> tuple[Job, ...]:
        """The orders that were delivered, oldest first."""
        return tuple(job for job in self.jobs if job.status == "delivered")

    def to_data(self) -> dict[str, Any]:
        """All of it in dicts, lists, texts and numbers, for JSON."""
        programs = {name: program._asdict() for name, program in self.programs.items()}
        return self._asdict() | {"jobs": [job._asdict() for job in self.jobs], "programs": programs}


def shift(recording: Recording) -> Shift:
    """Return what happened in a warehouse; for orders and batteries, only the world's own messages count.

    Raises ValueError for a run without a warehouse.
    """
    world = recording.world
    if world is None or world.warehouse is None:
        raise ValueError('this run has no warehouse: give run() a world such as World.generate("warehouse")')
    others = [robot.name for robot in world.robots if not robot.route]
    contacts = [*recording.contacts]
    contacts += [contact for name in others for contact in recording.other_contacts.get(name, ())]
    people = [contact.stamp for contact in contacts if contact.what == "person"]
    states = [item for item in recording.messages("/battery_state") if item.from_course]
    return Shift(
        jobs=_jobs(recording),
        touched=dict(sorted(Counter(_touched(world, contact) for contact in contacts).items())),
        met_person=min(people, default=None),
        battery=tuple((item.stamp, item.message.percentage) for item in states),
        way=length(recording.path) + sum(length(recording.tracks.get(name, ())) for name in others),
        programs=_programs(recording),
    )


def _jobs(recording: Recording) -> tuple[Job, ...]:
    jobs: dict[int, Job] = {}
    for item in recording.messages("/orders"):
        if not item.from_course:
            continue
        order, stamp = item.message, item.stamp
        status = _statuses(order)[order.status]
        if status == "waiting":
            left = order.deadline.sec - order.header.stamp.sec
            left += (order.deadline.nanosec - order.header.stamp.nanosec) / 1e9
            jobs[order.id] = Job(order.id, stamp, round(stamp + left, 9), None, None, status)
            continue
        job = jobs[order.id]._replace(status=status, robot=order.robot)
        jobs[order.id] = job._replace(picked_up=stamp) if status == "picked up" else job._replace(over=stamp)
    return tuple(jobs.values())


def _statuses(order: Any) -> dict[int, str]:
    """The values of `status`, in words."""
    names = ("WAITING", "PICKED_UP", "DELIVERED", "EXPIRED", "CANCELED")
    return {getattr(order, name): name.lower().replace("_", " ") for name in names}


def _touched(world: World, contact: Contact) -> str:
    """Return what was touched: boxes that stand still are shelves."""
    if contact.what != "box":
        return contact.what
    shelves = dataclasses.replace(world, walls=(), circles=())
    gap = clearance(shelves, np.array([contact.x]), np.array([contact.y]))[0]
    return "shelf" if gap < _SHELF else "box"


def _programs(recording: Recording) -> dict[str, ShiftProgram]:
    nodes = [name for name in recording.graph.nodes if not recording.is_course_node(name)]
    sent = Counter((item.sender, item.topic) for item in recording.messages() if not item.from_course)
    errors = Counter(error.node for error in recording.errors)
    return {
        node: ShiftProgram(
            sent={topic: count for (sender, topic), count in sorted(sent.items()) if sender == node},
            subscribes=tuple(
                sorted(
                    {
                        end.name
                        for end in recording.graph.endpoints
                        if (end.kind, end.node) == ("subscription", node)
                        and end.name not in INFRASTRUCTURE_TOPICS
                    }
                )
            ),
            errors=errors[node],
        )
        for node in nodes
    }
