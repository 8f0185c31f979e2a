"""Recordings written by hand, for what a check should see."""

from sim import Recording, World
from sim.evidence import Ended, Endpoint, Graph, LogLine, Message, Pose
from sim.ros.messages.codec import encode, type_name
from sim.world import Contact


def recording(*, seconds=10.0, **evidence):
    """A run to the end of its time."""
    return Recording(
        seconds=seconds, stamp=seconds, ended=Ended("time", seconds, "All of it was run."), **evidence
    )


def published(topic, messages, *, seconds=10.0, listeners=()):
    """A run in which /talker sent messages, given as pairs of stamp and message, all of one type."""
    type = type_name(messages[0][1].__class__)
    received = [Message(stamp, topic, type, "/talker", encode(message)) for stamp, message in messages]
    ends = [Endpoint("publisher", "/talker", topic, type, {})]
    ends += [Endpoint("subscription", node, topic, type, {}) for node in listeners]
    return recording(seconds=seconds, published=received, graph=Graph(["/talker", *listeners], ends))


def logged(*lines):
    """A run with log lines, given as (stamp, level, text)."""
    return recording(logs=[LogLine(stamp, level, "talker", text) for stamp, level, text in lines])


def driven(points, *, world="yard", contacts=(), **evidence):
    """A run in which the robot goes through points, one a second."""
    path = [Pose(float(second), x, y, 0.0) for second, (x, y) in enumerate(points)]
    touches = [Contact(*contact) for contact in contacts]
    return recording(world=World.load(world), path=path, contacts=touches, seconds=path[-1].stamp, **evidence)


def exchange(*streams, seconds=10.0):
    """A run in which the course's node and the student's publish.

    Each stream is given as a topic, pairs of stamp and message, and whether they are the course's.
    """
    messages, ends = [], []
    for topic, pairs, from_course in streams:
        type, node = type_name(pairs[0][1].__class__), "/course" if from_course else "/talker"
        other = "/talker" if from_course else "/course"
        ends.append(Endpoint("publisher", node, topic, type, {}, from_course))
        ends.append(Endpoint("subscription", other, topic, type, {}, not from_course))
        messages += [Message(at, topic, type, node, encode(message), from_course) for at, message in pairs]
    messages.sort(key=lambda row: row.stamp)
    return recording(seconds=seconds, published=messages, graph=Graph(["/talker", "/course"], ends))
