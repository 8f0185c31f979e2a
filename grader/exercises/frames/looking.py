"""An exercise on lookups: where was it, when it was seen? And what to do where no answer can be had."""

from __future__ import annotations

import math
from typing import Any

from grader.checks import Missed, hinting, publishes, subscribes
from grader.checks.fields import stamp_words
from grader.checks.no_data import no_data
from grader.exercise import Exercise
from grader.exercises.frames.measures import flat
from grader.exercises.frames.partners import Flat
from grader.exercises.frames.team import SIGHTINGS, Team
from sim.evidence import Message, Recording, since_start

POINT, STRING = "geometry_msgs/msg/PointStamped", "std_msgs/msg/String"
SOON, NEAR, LATE = 0.3, 0.05, 0.3  # s, m, m
PART = 0.3  # less than this is none

lookup = Exercise("lookup", "Where was it?", seconds=6, companions=[Team], seeds=(1, 2))


@lookup.check(2)
def hears_sightings(run: Recording) -> None:
    """The node hears /sighting (PointStamped), /tf and /tf_static."""
    with hinting(guess="A TransformListener hears both topics: TransformListener(self.buffer, self)."):
        subscribes(run, "/sighting", POINT)
        subscribes(run, "/tf")
        subscribes(run, "/tf_static")


@lookup.check(6, after=hears_sightings)
def places_them(run: Recording) -> None:
    """Each sighting by a robot on the map comes out on /found (PointStamped): where it was, in map."""
    publishes(run, "/found", POINT)
    judged = [seen for seen in _seen(run) if not _reason(run, seen)]
    faults = [fault for fault in (_fault(run, seen) for seen in judged) if fault]
    if faults:
        wrong = sum(1.0 - fault.credit for fault in faults)
        right = 1.0 - wrong / len(judged)
        raise Missed(
            faults[0].expected,
            faults[0].saw,
            faults[0].hint,
            credit=right if right >= PART else 0.0,
        )


def _fault(run: Recording, seen: Message) -> Missed | None:
    """What is wrong with the answer to a sighting; half right if it was there later."""
    found = [one for one in run.messages("/found") if seen.stamp <= one.stamp < seen.stamp + SOON]
    wanted = _place(run, seen, _seconds(seen.message))
    expected = f"({wanted[0]:.2f}, {wanted[1]:.2f}) m in map, for the sighting at {seen.stamp:.3g} s"
    if len(found) != 1:
        hint = "Publish in the callback: what buffer.transform or do_transform_point gives."
        return Missed(expected, f"{len(found)} messages", hint)
    said = found[0].message.point.x, found[0].message.point.y
    if found[0].message.header.frame_id != "map":
        told = f"a point in {found[0].message.header.frame_id or 'no frame'}"
        return Missed(expected, told, "Target first, then source: buffer.transform(msg, 'map').")
    if not math.dist(said, wanted) <= NEAR:
        moment = 0.5 if math.dist(said, _place(run, seen, seen.stamp)) < LATE else 0.0
        return Missed(expected, f"({said[0]:.2f}, {said[1]:.2f}) m", _why(run, seen, said), credit=moment)
    return None


@lookup.check(5, after=places_them)
def tells_why_not(run: Recording) -> None:
    """Where it can't be had, the exception's name comes out on /refused (String), such as LookupException."""
    publishes(run, "/refused", STRING)
    for seen in _seen(run):
        if not (reason := _reason(run, seen)):
            continue
        told = [
            one.message.data
            for one in run.messages("/refused")
            if seen.stamp <= one.stamp < seen.stamp + SOON
        ]
        if told != [reason]:
            age = run.during(0, seen.stamp).stamp - _seconds(seen.message)
            what = f"{seen.message.header.frame_id}, {age:.1f} s old"
            hint = "type(error).__name__ is the name of its class; TransformException catches all of them."
            raise Missed(
                f"{reason} for the sighting at {seen.stamp:.3g} s ({what})",
                ", ".join(told) or "nothing",
                hint,
            )


@lookup.check(3, after=tells_why_not)
def goes_on(run: Recording) -> None:
    """Nothing else is said, and the node goes on to the end."""
    known = [one for one in _seen(run) if not _reason(run, one)]
    refused = [one for one in _seen(run) if _reason(run, one)]
    end = run.ended.stamp - SOON
    for topic, wanted in (("/found", known), ("/refused", refused)):
        said = [one for one in run.messages(topic) if one.stamp < end]
        if len(said) > len(wanted):
            hint = "A sighting gives a place or a refusal: publish the one in try, the other in except."
            raise Missed(f"{len(wanted)} messages on {topic}", f"{len(said)}", hint)


@lookup.check(2, after=places_them)
def keeps_the_stamp(run: Recording) -> None:
    """The place on the map has the stamp of its sighting: it was there then."""
    stamps = {_seconds(seen.message) for seen in _seen(run)}
    for one in run.messages("/found"):
        if (
            one.stamp < run.ended.stamp - SOON
            and min(abs(_seconds(one.message) - known) for known in stamps) > 1e-6
        ):
            hint = "buffer.transform keeps it; what do_transform_point gives has the stamp of the lookup."
            raise Missed("a stamp of one of the sightings", stamp_words(one.message.header.stamp), hint)


def _seen(run: Recording) -> list[Message]:
    """Our sightings that had time for an answer."""
    seen = [
        one for one in run.messages("/sighting") if one.from_course and one.stamp < run.ended.stamp - SOON
    ]
    if len(seen) < len(SIGHTINGS):
        raise no_data(run, "sightings of all kinds", f"{len(seen)}", run.graph.publishers("/sighting"))
    return seen


def _reason(run: Recording, seen: Message) -> str:
    """Why there is no answer; empty where there is one."""
    trees = {one.header.frame_id for one in _told(run, "/tf", f"{_robot(seen)}/base_link")}
    if "map" not in trees:
        return "ConnectivityException" if trees else "LookupException"
    return "ExtrapolationException" if _seconds(seen.message) < 0 else ""


def _robot(seen: Message) -> str:
    """The name of the robot that has seen it."""
    return seen.message.header.frame_id.partition("/")[0]


def _told(run: Recording, topic: str, child: str) -> list[Any]:
    """What our team said of where a frame is."""
    ours = [one for heard in run.messages(topic) if heard.from_course for one in heard.message.transforms]
    return [one for one in ours if one.child_frame_id == child]


def _seconds(message: object) -> float:
    return since_start(message.header.stamp)


def _place(run: Recording, seen: Message, when: float) -> tuple[float, float]:
    """Where the point was in the map, by what the team itself said of its robots."""
    camera = flat(_told(run, "/tf_static", f"{_robot(seen)}/camera")[-1].transform)
    base = _base(run, _robot(seen), when)
    return _into(base, _into(camera, (seen.message.point.x, seen.message.point.y)))


def _base(run: Recording, name: str, when: float) -> Flat:
    """A robot at a time, between the two transforms around it."""
    poses = []
    for one in _told(run, "/tf", f"{name}/base_link"):
        poses.append((since_start(one.header.stamp), *flat(one.transform)))
    before = max((pose for pose in poses if pose[0] <= when), default=poses[0])
    after = min((pose for pose in poses if pose[0] > when), default=before)
    ratio = (when - before[0]) / (after[0] - before[0]) if after[0] > before[0] else 0.0
    turn = math.remainder(after[3] - before[3], math.tau)
    x, y = (b + ratio * (a - b) for b, a in zip(before[1:3], after[1:3], strict=True))
    return x, y, before[3] + ratio * turn


def _into(frame: Flat, point: tuple[float, float]) -> tuple[float, float]:
    x, y, yaw = frame
    cos, sin = math.cos(yaw), math.sin(yaw)
    return x + cos * point[0] - sin * point[1], y + sin * point[0] + cos * point[1]


def _why(run: Recording, seen: Message, said: tuple[float, float]) -> str:
    """The usual reasons for another place."""
    point = seen.message.point
    newest = _place(run, seen, seen.stamp)
    if math.dist(said, newest) < LATE:
        return (
            "That is where it would be now. The robot has driven on since: ask for the time of the sighting, "
            "msg.header.stamp, and not for the newest, Time()."
        )
    if math.dist(said, (point.x, point.y)) < 1e-6:
        return "That is the point as the camera sees it. It has to be taken into the frame map."
    return "Target first, then source: lookup_transform('map', msg.header.frame_id, msg.header.stamp)."
