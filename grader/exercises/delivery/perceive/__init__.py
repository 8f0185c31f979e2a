"""Perception: the robot's pose, what stands there, and who walks."""

import itertools
import math

import numpy as np

from grader.checks import Missed, publishes
from grader.checks.motion import world_in
from grader.checks.no_data import no_data
from grader.checks.people import near_something
from grader.checks.topics import longest_pause
from grader.companions.blind_drivers import turner
from grader.exercise import Exercise
from grader.exercises.delivery.perceive.crossing import CLOSE, FAR, LATE, crossing, in_view
from grader.geometry import Point, Pose2D
from grader.geometry.floor import away_from, points_of
from grader.responses import from_course, from_student
from sim.evidence import Message, Pose, Recording, Seconds, since_start
from sim.network import Network
from sim.world.clearance import clearance

__all__ = ["crossing", "perceive"]

POSE, PEOPLE, OBSTACLES = "/robot_pose", "/people", "/obstacles"
ARRAY = "geometry_msgs/msg/PoseArray"
PLACED, TURNED = 0.05, 0.06  # m, rad
REACH, EXACT = 0.5, 0.03  # m from the middle of a person or box to a point of it; from a ray's end
BOX, MAPPED = 0.25, 0.1  # m from a box's middle to its points, mostly; what is nearer to the map is on it
BACK, NEW = 10, 0.2  # scans before, half a second; m from what was seen then to what is new
EACH = 3  # every third message is judged: what is in view takes time to compute
WALKS, STANDS = 0.4, 0.05  # m/s
SETTLED = 6.0  # s until what stands is known to stand
FROM_THE_MIDDLE = ("The rays start at the lidar: give points_of the pose of base_scan in map, not that of "
                   "base_link.")
DELAY, PAUSE = 0.03, 2.0  # s from the robot to the laptop, and without news on a topic
OF_NOW = "That is where the robot is when the scan arrives: look up where it was at the scan's stamp."
ALWAYS = "Publish with every other scan from the first one on: a list that is never published stops no robot."

perceive = Exercise("perceive", "Perceive: who is walking?", world=crossing, seconds=20, companions=turner,
                    network=Network(delay=DELAY), seeds=(1,))


@perceive.check(2)
def publishes_all_three(run: Recording) -> None:
    """The node publishes a PoseStamped on /robot_pose, and PoseArrays on /people and /obstacles."""
    publishes(run, POSE, "geometry_msgs/msg/PoseStamped", at_least=20)
    publishes(run, PEOPLE, ARRAY, at_least=20)
    publishes(run, OBSTACLES, ARRAY, at_least=20)


@perceive.check(4, after=publishes_all_three)
def knows_its_place(run: Recording) -> None:
    """/robot_pose is where base_link was at its stamp, in map."""
    hint = "Look up map to base_link for the robot, and map to base_scan for the rays, at the scan's stamp."
    for row in from_student(run, POSE):
        pose = Pose2D.from_message(row.message.pose)
        true, later = (Pose2D(*_nearest(run.path, when)[1:]) for when in (_time(row), row.stamp))
        if not pose.is_near(true, PLACED, TURNED):
            expected = f"the robot at {_text(true)}, turned by {true.yaw:.2f} rad"
            saw = f"{_text(pose)} and {pose.yaw:.2f} rad at {row.stamp:.3g} s"
            raise Missed(expected, saw, OF_NOW if pose.is_near(later, PLACED, TURNED) else hint)


@perceive.check(3, after=knows_its_place)
def stamps_by_the_scan(run: Recording) -> None:
    """All three carry the stamp of the scan they come from, and the frame map, five times a second."""
    stamps = {_nanoseconds(row) for row in run.messages("/scan") if row.from_course}
    hint = "Copy scan.header.stamp, not the current time."
    for topic in (POSE, PEOPLE, OBSTACLES):
        rows = from_student(run, topic)
        wrong = next((row for row in rows if _nanoseconds(row) not in stamps), None)
        if wrong:
            sec, nanosec = _nanoseconds(wrong)
            saw = f"{sec + nanosec / 1e9:.4g} s on {topic} at {wrong.stamp:.4g} s, when no scan was made"
            raise Missed("the stamps of scans", saw, hint)
        if any(row.message.header.frame_id != "map" for row in rows):
            hint = "The header says which frame a point is in: pose_array and pose_stamped write map."
            raise Missed(f"the frame map on {topic}", f"“{rows[0].message.header.frame_id}”", hint)
        count = len(set(map(_nanoseconds, rows)))
        if count < 4 * run.ended.stamp:
            saw = f"those of {count} scans in {run.ended.stamp:.3g} s"
            hint = "Publish with every other scan: a robot that learns of people late brakes too late."
            raise Missed(f"five scans or more each second on {topic}", saw, hint)
        _require_no_pause(run, topic)


@perceive.check(4, after=knows_its_place)
def finds_what_stands(run: Recording) -> None:
    """/obstacles contains points on the boxes in view, and none of anything on the map."""
    boxes = _boxes_in_view(run)
    hint = "Floor.strange returns the points that the map doesn't explain; publish them all."
    for row in from_student(run, OBSTACLES)[::EACH]:
        points, person = _points(row), _nearest(_person(run), _time(row))[1:3]
        person_in_view = in_view(world_in(run), world_in(run).start[:2], person, FAR, 0.0)
        for box in [] if person_in_view else boxes:
            if not _has(points, box):
                expected = f"a point of the box at {_text(box)}"
                hint = FROM_THE_MIDDLE if _begins_at_base_link(run, row) else hint
                raise Missed(expected, f"none within {REACH} m of it at {row.stamp:.3g} s", hint)
        gaps = clearance(world_in(run), *np.array(points).T) if points else np.array([])
        mapped = [point for point, gap in zip(points, gaps, strict=True) if gap < MAPPED]
        if mapped:
            saw = f"{_text(mapped[0])} at {row.stamp:.3g} s, which is on the map"
            raise Missed("points that the map doesn't explain", saw, hint)
        near_something(run, row.stamp, OBSTACLES, points)


@perceive.check(5, after=knows_its_place)
def finds_who_walks(run: Recording) -> None:
    """/people contains one point for each moving person in view, and none for static boxes."""
    rows = from_student(run, PEOPLE)[::EACH]
    seen = [row for row in rows if _is_seen(run, row, 1.0) and _speed_of_person(run, row, 1.0) > WALKS]
    comes = _time(seen[0]) if seen else math.inf
    begin = _time(rows[0]) + SETTLED if rows else math.inf  # what stands there is new to it at first
    before = [row for row in rows if begin < _time(row) <= comes]
    if seen and not before:
        raise Missed(f"messages on {PEOPLE} before the person comes", "none", ALWAYS)
    for row, box in itertools.product(before, _plain_boxes(run, _time(before[-1])) if before else []):
        if any(math.dist(point, box) < BOX for point in _points(row)):
            hint = "What has stood there all along isn't walking: compare with half a second earlier."
            saw = f"the box at {_text(box)} among them at {row.stamp:.3g} s"
            raise Missed("no box on /people that has stood there for six seconds", saw, hint)
    hint = "Points that weren't there half a second earlier are a person's: away_from(strange, before, 0.25)."
    if any(_has(_points(row), _nearest(_person(run), _time(row))[1:3]) for row in seen):
        hint = "Keep the points that moved, each with its time, for five seconds: people go unseen at times."
    for row in seen:
        turned = _begins_at_base_link(run, row)
        _require_person(run, row, "a person who walks", FROM_THE_MIDDLE if turned else hint)
    _require_three(run, seen, "a person who walks")
    for row in rows:
        near_something(run, row.stamp, PEOPLE, _points(row))


@perceive.check(4, after=finds_who_walks)
def remembers_who_stops(run: Recording) -> None:
    """A person who walked and then stops stays on /people for some seconds."""
    rows = from_student(run, PEOPLE)[::EACH]
    seen = [row for row in rows if _is_seen(run, row, 1.2) and _speed_of_person(run, row, 1.2) < STANDS]
    hint = "Keep the points that moved, each with its time, for five seconds."
    for row in seen:
        _require_person(run, row, "a person who walked here, and is standing still now", hint)
    _require_three(run, seen, "a person who stands")


def _plain_boxes(run: Recording, end: Seconds) -> list[Point]:
    """The boxes in view of which all that is seen until `end` was seen half a second before, too.

    The lidar is off the middle of a robot that turns, so a side of a box may come into view as if it walked.
    """
    lidar, scans = world_in(run).lidar, [scan for scan in from_course(run, "/scan") if _time(scan) <= end]
    poses = [lidar.mounted_at(_nearest(run.path, _time(scan))[1:]) for scan in scans]
    hits = [points_of(scan.message, pose).tolist() for scan, pose in zip(scans, poses, strict=True)]

    def is_plain(box: Point) -> bool:
        seen = [[hit for hit in row if math.dist(hit, box) < BOX] for row in hits]
        return not any(away_from(now, before, NEW) for before, now in zip(seen, seen[BACK:], strict=False))

    return [box for box in _boxes_in_view(run) if is_plain(box)]


def _begins_at_base_link(run: Recording, row: Message) -> bool:
    """Return whether the obstacles of a scan are where its rays would end, did they begin at base_link."""
    scan, sent = (next((one for one in rows if _nanoseconds(one) == _nanoseconds(row)), None)
                  for rows in (from_course(run, "/scan"), from_student(run, OBSTACLES)))
    if not (scan and sent and _points(sent)):
        return False
    robot = _nearest(run.path, _time(row))[1:]
    off = [_off(_points(sent), points_of(scan.message, pose))
           for pose in (robot, world_in(run).lidar.mounted_at(robot))]
    return off[0] < EXACT < off[1]


def _off(points: list[Point], rays: np.ndarray) -> float:
    """The mean distance (m) of points from the nearest of the rays' ends."""
    gaps = np.linalg.norm(np.array(points)[:, None] - rays[None], axis=2)
    return float(gaps.min(axis=1).mean())


def _require_person(run: Recording, row: Message, who: str, hint: str) -> None:
    """Raises Missed where the person isn't on /people, or is there with far too many points."""
    there, points = _nearest(_person(run), _time(row))[1:3], _points(row)
    if not _has(points, there):
        saw = f"no point of /people within {REACH} m of that at {row.stamp:.3g} s"
        raise Missed(f"{who}, at {_text(there)}", saw, hint)
    if len(points) > 300:
        hint = "Publish the points that moved unchanged, each of them once."
        raise Missed("at most 300 points of people", f"{len(points)} points at {row.stamp:.3g} s", hint)


def _require_no_pause(run: Recording, topic: str) -> None:
    """Raises Missed where a topic has no news for longer than `PAUSE`."""
    stamps = sorted(map(_time, from_student(run, topic)))
    pause, since = longest_pause([run.started_at, *stamps, run.ended.stamp])
    if pause > PAUSE:
        raise Missed(f"messages on {topic} throughout", f"none for {pause:.3g} s from {since:.3g} s", ALWAYS)


def _require_three(run: Recording, judged: list[Message], who: str) -> None:
    if len(judged) < 3:
        raise no_data(run, f"messages on {PEOPLE} with {who} in view", f"{len(judged)}", [])


def _person(run: Recording) -> list[Pose]:
    return run.tracks["person_1"]


def _nearest(track: list[Pose], stamp: Seconds) -> Pose:
    """The pose of a track that is nearest in time."""
    return min(track, key=lambda pose: abs(pose.stamp - stamp))


def _speed_of_person(run: Recording, row: Message, lasting: Seconds) -> float:
    """Their mean speed in the time until the stamp of a message, m/s."""
    before, now = (_nearest(_person(run), _time(row) - back) for back in (lasting, 0.0))
    return math.dist(before[1:3], now[1:3]) / lasting


def _is_seen(run: Recording, row: Message, lasting: Seconds) -> bool:
    """Return whether the person has been in view for a while."""
    there = (_nearest(_person(run), _time(row) - back)[1:3] for back in (lasting, lasting / 2, 0.0))
    return all(in_view(world_in(run), world_in(run).start[:2], place, FAR - 0.5) for place in there)


def _boxes_in_view(run: Recording) -> list[Point]:
    here, world = world_in(run).start[:2], world_in(run)
    boxes = [(track[0].x, track[0].y) for name, track in run.tracks.items() if name.startswith("box")]
    return [box for box in boxes if CLOSE < math.dist(here, box) < FAR and in_view(world, here, box, FAR)]


def _has(points: list[Point], there: Point) -> bool:
    return any(math.dist(point, there) < REACH for point in points)


def _points(row: Message) -> list[Point]:
    return [Pose2D.from_message(pose)[:2] for pose in row.message.poses]


def _time(row: Message) -> Seconds:
    """The message's stamp; if it is newer than a scan can be, the time of the scan that had just come."""
    stamp = since_start(row.message.header.stamp)
    return stamp if stamp < row.stamp - LATE / 2 else stamp - LATE - DELAY


def _nanoseconds(row: Message) -> tuple[int, int]:
    return row.message.header.stamp.sec, row.message.header.stamp.nanosec


def _text(place: Point | Pose2D) -> str:
    return f"{place[0]:.2f}, {place[1]:.2f}"
