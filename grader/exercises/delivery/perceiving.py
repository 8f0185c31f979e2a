"""An exercise on perception: where am I, what stands here, who walks?"""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np

from grader.checks import Missed, hinting, publishes
from grader.checks.no_data import no_data
from grader.exercise import Exercise
from grader.exercises.delivery.floor import Point, far_from, flat, points_of
from grader.exercises.delivery.sights import (
    CLOSE,
    FAR,
    SETTLED,
    at,
    boxes_of,
    crossing,
    in_view,
    person_of,
    speed_at,
    turner,
)
from sim.evidence import Message, Recording, Seconds, since_start
from sim.world.clearance import clearance

POSE, PEOPLE, OBSTACLES = "/robot_pose", "/people", "/obstacles"
ARRAY = "geometry_msgs/msg/PoseArray"
PLACED, TURNED = 0.05, 0.06  # m, rad
REACH = 0.5  # m from somebody's or a box's middle to a point of theirs
BOX = 0.25  # m from a box's middle to its points, mostly
BACK, NEW = 10, 0.2  # scans before, half a second; m from what was seen then to what is new
EACH = 3  # every third message is judged: what is in view takes time to compute
MAPPED = 0.1  # m; what is nearer to the map than this isn't strange
WALKS, STANDS = 0.4, 0.05  # m/s

perceive = Exercise(
    "perceive", "Perceive: who walks?", world=crossing, seconds=20, companions=turner, seeds=(1,)
)


@perceive.check(2)
def tells(run: Recording) -> None:
    """The node publishes a PoseStamped on /robot_pose, and PoseArrays on /people and /obstacles."""
    with hinting(
        guess="It needs /map (with KEPT), /scan and a tf2 listener, and tells with each other scan."
    ):
        publishes(run, POSE, "geometry_msgs/msg/PoseStamped", at_least=20)
        publishes(run, PEOPLE, ARRAY, at_least=20)
        publishes(run, OBSTACLES, ARRAY, at_least=20)


@perceive.check(4, after=tells)
def knows_its_place(run: Recording) -> None:
    """/robot_pose is where base_link was at its stamp, in map."""
    hint = (
        "Look up map to base_link for the robot, and map to base_scan for the rays, both at the scan's stamp."
    )
    for heard in _said(run, POSE):
        x, y, yaw = flat(heard.message.pose)
        true = at(run.path, _when(heard))
        off = math.dist((x, y), true[1:3]), abs(math.remainder(yaw - true.yaw, math.tau))
        if not (off[0] < PLACED and off[1] < TURNED):
            expected = f"the robot at {true.x:.2f}, {true.y:.2f}, turned by {true.yaw:.2f} rad"
            saw = f"{x:.2f}, {y:.2f} and {math.remainder(yaw, math.tau):.2f} rad at {heard.stamp:.3g} s"
            raise Missed(expected, saw, hint)


@perceive.check(3, after=knows_its_place)
def stamps_by_the_scan(run: Recording) -> None:
    """All three carry the stamp of the scan that they come from, and the frame map, five times a second."""
    stamps = {_nanoseconds(heard) for heard in run.messages("/scan") if heard.from_course}
    hint = "Pass scan.header.stamp on, and not the time of now."
    for topic in (POSE, PEOPLE, OBSTACLES):
        said = _said(run, topic)
        wrong = next((one for one in said if _nanoseconds(one) not in stamps), None)
        if wrong:
            saw = f"{_when(wrong):.4g} s on {topic} at {wrong.stamp:.4g} s, when no scan was made"
            raise Missed("the stamps of scans", saw, hint)
        if any(one.message.header.frame_id != "map" for one in said):
            hint = "The header says in which frame a place is: listed and stamped write map."
            raise Missed(f"the frame map on {topic}", f"“{said[0].message.header.frame_id}”", hint)
        if len({_nanoseconds(one) for one in said}) < 4 * run.ended.stamp:
            saw = f"those of {len({_nanoseconds(one) for one in said})} scans in {run.ended.stamp:.3g} s"
            hint = "Tell with every other scan; whoever hears of people late drives on for too long."
            raise Missed(f"five scans or more each second on {topic}", saw, hint)


@perceive.check(4, after=knows_its_place)
def finds_what_stands(run: Recording) -> None:
    """/obstacles has points of the boxes in view, and none of what is on the map."""
    boxes = _boxes_in_view(run)
    for heard in _said(run, OBSTACLES)[::EACH]:
        points = _points(heard)
        hint = "Floor.strange gives the points that the map doesn't explain; publish them all."
        for box in boxes if not _somebody_is_in_view(run, _when(heard)) else []:
            if not _has(points, box):
                expected = f"a point of the box at {_place(box)}"
                raise Missed(expected, f"none within {REACH} m of it at {heard.stamp:.3g} s", hint)
        mapped = _mapped(run, points)
        if mapped:
            saw = f"{_place(mapped[0])} at {heard.stamp:.3g} s, which is on the map"
            raise Missed("points that the map doesn't explain", saw, hint)


@perceive.check(5, after=knows_its_place)
def finds_who_walks(run: Recording) -> None:
    """/people has a point of whoever walks in view, and of no box that stands there from the beginning."""
    track, said = person_of(run), _said(run, PEOPLE)[::EACH]
    in_sight = [one for one in said if _is_seen(run, _when(one), 1.0)]
    seen = [one for one in in_sight if speed_at(track, _when(one), 1.0) > WALKS]
    comes = _when(seen[0]) if seen else math.inf
    _must_not_be_boxes(run, [one for one in said if SETTLED < _when(one) <= comes])
    for heard in seen:
        hint = "Whose points were not there half a second before walks: far_from(strange, before, 0.25)."
        _must_be_told(run, heard, "somebody who walks", hint)
    _must_have(run, len(seen), "somebody who walks")


@perceive.check(4, after=finds_who_walks)
def remembers_who_stops(run: Recording) -> None:
    """Whoever walked, and stops, is told of for some seconds more."""
    track, judged = person_of(run), 0
    for heard in _said(run, PEOPLE)[::EACH]:
        when = _when(heard)
        if _is_seen(run, when, 1.2) and speed_at(track, when, 1.2) < STANDS:
            judged += 1
            hint = "Keep the points that moved, each with its time, for five seconds."
            _must_be_told(run, heard, "somebody who walked here, and stands now", hint)
    _must_have(run, judged, "somebody who stands")


def _must_not_be_boxes(run: Recording, said: list[Message]) -> None:
    boxes = _plain_boxes(run, _when(said[-1])) if said else []
    for heard, box in itertools.product(said, boxes):
        if any(math.dist(point, box) < BOX for point in _points(heard)):
            hint = "What has stood there all the time doesn't walk: compare with half a second before."
            saw = f"the box at {_place(box)} among them at {heard.stamp:.3g} s"
            raise Missed("no box on /people that has stood there for six seconds", saw, hint)


def _plain_boxes(run: Recording, end: Seconds) -> list[Point]:
    """The boxes in view of which all that is seen until `end` was seen half a second before, too.

    The lidar is off the middle of a robot that turns, so a side of a box may come into view as if it walked.
    """
    hits = []
    for scan in [one for one in run.messages("/scan") if one.from_course and _when(one) <= end]:
        pose = run.world.lidar.mounted_at(at(run.path, _when(scan))[1:])
        hits.append(points_of(scan.message, pose).tolist())

    def is_plain(box: Point) -> bool:
        seen = [[hit for hit in row if math.dist(hit, box) < BOX] for row in hits]
        return not any(far_from(now, before, NEW) for before, now in zip(seen, seen[BACK:], strict=False))

    return [box for box in _boxes_in_view(run) if is_plain(box)]


def _must_be_told(run: Recording, heard: Message, whom: str, hint: str) -> None:
    there = at(person_of(run), _when(heard))[1:3]
    if not _has(_points(heard), there):
        saw = f"no point of /people within {REACH} m of that at {heard.stamp:.3g} s"
        raise Missed(f"{whom}, at {_place(there)}", saw, hint)
    if len(_points(heard)) > 300:
        hint = "Publish the points that moved as they are, each of them once."
        saw = f"{len(_points(heard))} points at {heard.stamp:.3g} s"
        raise Missed("at most 300 points of people", saw, hint)


def _must_have(run: Recording, judged: int, whom: str) -> None:
    if judged < 3:
        raise no_data(run, f"messages on {PEOPLE} with {whom} in view", f"{judged}", [])


def _is_seen(run: Recording, when: Seconds, lasting: Seconds) -> bool:
    """Whether the person has been in view for a while."""
    there = [at(person_of(run), when - back)[1:3] for back in (lasting, lasting / 2, 0.0)]
    return all(in_view(run.world, _here(run), place, FAR - 0.5) for place in there)


def _somebody_is_in_view(run: Recording, when: Seconds, reach: float = FAR) -> bool:
    return in_view(run.world, _here(run), at(person_of(run), when)[1:3], reach, 0.0)


def _mapped(run: Recording, points: list[Point]) -> list[Point]:
    """Those that are on the map."""
    if not points:
        return []
    gaps = clearance(run.world, *np.array(points).T)
    return [point for point, gap in zip(points, gaps, strict=True) if gap < MAPPED]


def _boxes_in_view(run: Recording) -> list[Point]:
    here, world = _here(run), run.world
    return [box for box in boxes_of(run) if math.dist(here, box) > CLOSE and in_view(world, here, box, FAR)]


def _has(points: list[Point], there: Point) -> bool:
    return any(math.dist(point, there) < REACH for point in points)


def _points(heard: Message) -> list[Point]:
    return [flat(pose)[:2] for pose in heard.message.poses]


def _here(run: Recording) -> Point:
    return run.world.start[:2]


def _said(run: Recording, topic: str) -> list[Message]:
    return [heard for heard in run.messages(topic) if not heard.from_course]


def _when(heard: Message) -> Seconds:
    return since_start(heard.message.header.stamp)


def _nanoseconds(heard: Message) -> tuple[Any, Any]:
    stamp = heard.message.header.stamp
    return stamp.sec, stamp.nanosec


def _place(place: Point) -> str:
    return f"{place[0]:.2f}, {place[1]:.2f}"
