"""Nodes of ours for 08_joints: who has places to go to, who moves the arm, who teaches it paths."""

from __future__ import annotations

import functools
import random
from collections.abc import Callable
from typing import NamedTuple

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from grader.exercises.joints.places import arm_of, joint_of
from sim.world.machines import JointModel

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
NAMES = ["shoulder_joint", "elbow_joint"]
STATIONS, VISIT = 4, 2.2  # positions; s that the gymnast stays
BEGIN = 0.1  # s
NEAR, FAR = (0.03, 0.07), (0.25, 0.6)  # rad from a limit: near for sure, and not near for sure
CRUISE = 0.8  # rad/s, in tasks
LESSON, INTERRUPTION = 4.5, 1.0  # s, between two paths, and until one is broken off
KINDS = "good", "beyond", "interrupted"


def stations(seed: int) -> list[float]:
    """Positions (rad) for the joint of a seed, far enough apart, and not so far that it takes long."""
    draw, model = random.Random(f"stations {seed}"), joint_of(seed).machine
    places, now = [], 0.0
    while len(places) < STATIONS:
        place = round(draw.uniform(model.lower, model.upper), 2)
        far = abs(place - now) / model.max_velocity  # s
        if 0.8 <= far <= 4.0 and (far > 2.5 or len(places) != 1):  # on one way, two seconds are not enough
            places.append(place)
            now = place
    return places


class Foreman(Node):
    """Says once, for all who come, where the joint is to go: /positions (Float64MultiArray), latched.

    It does so when all programs have found each other: who passes the first position on at once is heard.
    """

    def __init__(self, places: list[float]) -> None:
        super().__init__("foreman")
        self.places = places
        self.publisher = self.create_publisher(Float64MultiArray, "/positions", LATCHED)
        self.begin = self.create_timer(BEGIN, self.tell)

    def tell(self) -> None:
        """Say it."""
        self.begin.cancel()
        self.publisher.publish(Float64MultiArray(data=self.places))


def foreman(seed: int) -> list[Callable[[], Node]]:
    """The foreman of a seed, as companions of a run in `joint_of(seed)`."""
    return [functools.partial(Foreman, stations(seed))]


class Gymnast(Node):
    """Moves the arm from pose to pose (/joint_commands), each for 2.2 s."""

    def __init__(self, poses: list[list[float]]) -> None:
        super().__init__("gymnast")
        self.poses = poses[::-1]
        self.publisher = self.create_publisher(Float64MultiArray, "/joint_commands", 10)
        self.create_timer(VISIT, self.move)

    def move(self) -> None:
        """Take the next pose, if there is one."""
        if self.poses:
            self.publisher.publish(Float64MultiArray(data=self.poses.pop()))


class Gripper(Node):
    """Another driver that speaks on /joint_states, of its own joint only."""

    def __init__(self) -> None:
        super().__init__("gripper")
        self.publisher = self.create_publisher(JointState, "/joint_states", 10)
        self.create_timer(0.13, self.report)

    def report(self) -> None:
        """Say how far the gripper is open (m)."""
        self.publisher.publish(JointState(name=["gripper_joint"], position=[0.04], velocity=[0.0]))


def poses(seed: int) -> list[list[float]]:
    """Six poses for the arm of a seed: each joint is near each of its limits once, and then away again."""
    draw, joints = random.Random(f"poses {seed}"), arm_of(seed).machine.joints
    near = [(index, upper) for index in (0, 1) for upper in (False, True)]
    draw.shuffle(near)
    rows = []
    for index, upper in near:
        row = [_place(draw, joint, draw.random() < 0.5, FAR) for joint in joints]
        row[index] = _place(draw, joints[index], upper, NEAR)
        rows += [row, [_place(draw, joint, draw.random() < 0.5, FAR) for joint in joints]]
    return rows[:-1]


def _place(draw: random.Random, joint: JointModel, upper: bool, margin: tuple[float, float]) -> float:
    away = draw.uniform(*margin)
    return joint.upper - away if upper else joint.lower + away


def gymnast(seed: int) -> list[Callable[[], Node]]:
    """The gymnast of a seed and a gripper, as companions of a run in `arm_of(seed)`."""
    return [functools.partial(Gymnast, poses(seed)), Gripper]


class Path(NamedTuple):
    """Poses to go through, joints in the order of the names."""

    kind: str  # of KINDS
    names: list[str]
    points: list[list[float]]


def paths(seed: int) -> list[Path]:
    """One path of each kind for the arm of a seed: one goes beyond a limit, one is disturbed."""
    draw, joints = random.Random(f"paths {seed}"), arm_of(seed).machine.joints
    found, now = [], [0.0, 0.0]
    for kind in draw.sample(KINDS, 3):
        points = []
        while len(points) < 2:
            point = [round(draw.uniform(joint.lower + 0.1, joint.upper - 0.1), 2) for joint in joints]
            if 0.7 <= max(abs(a - b) for a, b in zip(point, now, strict=True)) <= 1.2:
                points.append(point)
                now = point
        if kind == "beyond":
            index = draw.choice((0, 1))
            points[-1][index] = round(joints[index].upper + draw.uniform(0.1, 0.4), 2)
        first = -1 if arm_of(seed).machine.elbow_first else 1
        order = -first if found else draw.choice((1, -1))  # not the driver's, where it matters
        found.append(Path(kind, NAMES[::order], [point[::order] for point in points]))
        now = now if kind == "good" else list(_start(found))
    return found


def _start(done: list[Path]) -> tuple[float, float]:
    """Where the arm is after these paths, roughly; a disturbed one is sent back to the beginning."""
    last = done[-1]
    if last.kind == "interrupted" or len(done) == 1:
        return (0.0, 0.0)
    if last.kind == "good":
        order = 1 if last.names == NAMES else -1
        return tuple(last.points[-1][::order])
    return _start(done[:-1])


class Teacher(Node):
    """Asks for paths on /path (JointTrajectory without times), and disturbs the arm on one of them."""

    def __init__(self, wishes: list[Path]) -> None:
        super().__init__("teacher")
        self.wishes = wishes[::-1]
        self.publisher = self.create_publisher(JointTrajectory, "/path", 10)
        self.commands = self.create_publisher(Float64MultiArray, "/joint_commands", 10)
        self.trouble = self.create_timer(INTERRUPTION, self.disturb)
        self.trouble.cancel()
        self.begin = self.create_timer(0.5, self.start)

    def start(self) -> None:
        """The first one comes soon."""
        self.begin.cancel()
        self.ask()
        self.create_timer(LESSON, self.ask)

    def ask(self) -> None:
        """Ask for the next path, if there is one."""
        if not self.wishes:
            return
        wish = self.wishes.pop()
        points = [JointTrajectoryPoint(positions=point) for point in wish.points]
        self.publisher.publish(JointTrajectory(joint_names=wish.names, points=points))
        if wish.kind == "interrupted":
            self.trouble.reset()

    def disturb(self) -> None:
        """Send the arm somewhere else, past its action."""
        self.trouble.cancel()
        self.commands.publish(Float64MultiArray(data=[0.0, 0.0]))


def teacher(seed: int) -> list[Callable[[], Node]]:
    """The teacher of a seed, as companions of a run in `arm_of(seed)`."""
    return [functools.partial(Teacher, paths(seed))]
