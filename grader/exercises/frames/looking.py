"""An exercise on lookups: where was it, when it was seen? And what to do where no answer can be had."""

from __future__ import annotations

import math
import random

from geometry_msgs.msg import PointStamped
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster

from grader.checks import Missed, hinting, publishes, subscribes
from grader.checks.silence import silence
from grader.exercise import Exercise
from grader.exercises.frames.partners import Flat, transform
from sim.evidence import Heard, Recording

POINT, STRING = "geometry_msgs/msg/PointStamped", "std_msgs/msg/String"
BEGIN, PAUSE = 2.0, 0.5  # s; the first sighting, and from one to the next
SOON, NEAR = 0.3, 0.05  # s, m
# In turn: how old each sighting is (s), and who has seen it. "ghost" is in no tree, "island" in another one.
SIGHTINGS = (
    (0.6, "robot1"),
    (1.2, "robot2"),
    (0.5, "ghost"),
    (0.9, "robot2"),
    (60.0, "robot1"),
    (0.7, "island"),
)
REASONS = {"ghost": "LookupException", "island": "ConnectivityException"}
OLD = 10.0  # s; who asks for what is older gets an ExtrapolationException


class Team(Node):
    """Robots that drive round (/tf), their cameras (/tf_static), and what these have seen (/sighting)."""

    def __init__(self) -> None:
        super().__init__("team")
        self.moving, self.static = TransformBroadcaster(self), StaticTransformBroadcaster(self)
        self.publisher = self.create_publisher(PointStamped, "/sighting", 10)
        self.phase = random.uniform(-3.0, 3.0)
        self.count = 0
        cameras = [(f"{name}/base_link", f"{name}/camera", camera) for name, camera in CAMERAS.items()]
        self.static.sendTransform([transform(*one) for one in cameras])
        self.create_timer(0.05, self.move)
        self.begin = self.create_timer(BEGIN, self.start)

    def start(self) -> None:
        """Begin to tell of what was seen."""
        self.begin.cancel()
        self.create_timer(PAUSE, self.see)

    def move(self) -> None:
        """Tell where all robots are."""
        now = self.get_clock().now()
        self.moving.sendTransform(
            [
                transform(
                    "map" if name != "island" else "sea", f"{name}/base_link", self.where(name, now), now
                )
                for name in CAMERAS
            ]
        )

    def where(self, name: str, now: Time) -> Flat:
        """Each on a circle of its own."""
        angle = self.phase + 0.8 * now.nanoseconds / 1e9 + len(name) + 2.0 * (name == "robot2")
        return 3.0 * math.cos(angle), 2.0 * math.sin(angle), math.remainder(angle + 1.5, math.tau)

    def see(self) -> None:
        """Tell of the next thing: a point in the frame of a camera, and when it was there."""
        age, name = SIGHTINGS[self.count % len(SIGHTINGS)]
        self.count += 1
        point = PointStamped()
        now = self.get_clock().now()
        point.header.stamp = (now - Duration(seconds=min(age, now.nanoseconds / 1e9 - 1e-3))).to_msg()
        if age > OLD:  # before anybody said where the robots were
            point.header.stamp = Time(nanoseconds=1).to_msg()
        point.header.frame_id = f"{name}/camera"
        point.point.x, point.point.y = random.uniform(0.5, 2.0), random.uniform(-1.0, 1.0)
        self.publisher.publish(point)


CAMERAS: dict[str, Flat] = {"robot1": (0.2, 0.0, 0.5), "robot2": (-0.1, 0.1, -1.2), "island": (0.0, 0.0, 0.0)}

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
    for seen in _seen(run):
        if _reason(seen):
            continue
        found = [one for one in run.messages("/found") if seen.stamp <= one.stamp < seen.stamp + SOON]
        wanted = _place(run, seen, _seconds(seen.message))
        expected = f"({wanted[0]:.2f}, {wanted[1]:.2f}) m in map, for the sighting at {seen.stamp:.3g} s"
        if len(found) != 1:
            guess = "Publish in the callback: what buffer.transform or do_transform_point gives."
            raise Missed(expected, f"{len(found)} messages", guess=guess)
        point = found[0].message.point
        if found[0].message.header.frame_id != "map":
            told = f"a point in {found[0].message.header.frame_id or 'no frame'}"
            raise Missed(expected, told, "Target first, then source: buffer.transform(msg, 'map').")
        if not math.dist((point.x, point.y), wanted) <= NEAR:
            raise Missed(expected, f"({point.x:.2f}, {point.y:.2f}) m", _why(run, seen, (point.x, point.y)))


@lookup.check(5, after=places_them)
def tells_why_not(run: Recording) -> None:
    """Where it can't be had, the exception's name comes out on /refused (String), such as LookupException."""
    publishes(run, "/refused", STRING)
    for seen in _seen(run):
        if not (reason := _reason(seen)):
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
    known, refused = (
        [one for one in _seen(run) if not _reason(one)],
        [one for one in _seen(run) if _reason(one)],
    )
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
            raise Missed("a stamp of one of the sightings", f"{_seconds(one.message):.3f} s", hint)


def _seen(run: Recording) -> list[Heard]:
    """Our sightings that had time for an answer."""
    seen = [one for one in run.messages("/sighting") if one.ours and one.stamp < run.ended.stamp - SOON]
    if len(seen) < len(SIGHTINGS):
        raise silence(run, "sightings of all kinds", f"{len(seen)}", run.graph.publishers("/sighting"))
    return seen


def _reason(seen: Heard) -> str:
    """Why there is no answer; empty where there is one."""
    name = seen.message.header.frame_id.partition("/")[0]
    too_old = _seconds(seen.message) < 1e-3
    return REASONS.get(name, "ExtrapolationException" if too_old else "")


def _seconds(message: object) -> float:
    return Time.from_msg(message.header.stamp).nanoseconds / 1e9


def _place(run: Recording, seen: Heard, when: float) -> tuple[float, float]:
    """Where the point was in the map, by what the team itself said of its robots."""
    name = seen.message.header.frame_id.partition("/")[0]
    base = _base(run, name, when)
    return _into(base, _into(CAMERAS[name], (seen.message.point.x, seen.message.point.y)))


def _base(run: Recording, name: str, when: float) -> Flat:
    """A robot at a time, between the two transforms around it."""
    poses = []
    for heard in run.messages("/tf"):
        for one in heard.message.transforms if heard.ours else ():
            if one.child_frame_id == f"{name}/base_link":
                yaw = 2 * math.atan2(one.transform.rotation.z, one.transform.rotation.w)
                shift = one.transform.translation
                poses.append((Time.from_msg(one.header.stamp).nanoseconds / 1e9, shift.x, shift.y, yaw))
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


def _why(run: Recording, seen: Heard, said: tuple[float, float]) -> str:
    """The usual reasons for another place."""
    point = seen.message.point
    newest = _place(run, seen, seen.stamp)
    if math.dist(said, newest) < 0.3:
        return (
            "That is where it would be now. The robot has driven on since: ask for the time of the sighting, "
            "msg.header.stamp, and not for the newest, Time()."
        )
    if math.dist(said, (point.x, point.y)) < 1e-6:
        return "That is the point as the camera sees it. It has to be taken into the frame map."
    return "Target first, then source: lookup_transform('map', msg.header.frame_id, msg.header.stamp)."
