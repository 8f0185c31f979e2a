"""Paths for an arm to follow, one of them beyond its limits and one of them interrupted."""

import functools
import random
from collections.abc import Callable
from typing import NamedTuple

from rclpy.node import Node
from std_msgs.msg import Float64MultiArray
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from grader.companions.schedule import Row, Schedule
from grader.worlds.arms import arm_of

NAMES = ["shoulder_joint", "elbow_joint"]
CRUISE = 0.8  # rad/s, in tasks
BEGIN, LESSON, INTERRUPTION = 0.5, 4.5, 1.0  # s: first path; from path to path; until one is broken off
KINDS = "good", "beyond", "interrupted"


class Path(NamedTuple):
    """Poses to go through, joints in the order of the names."""

    kind: str  # of KINDS
    names: list[str]
    points: list[list[float]]


def paths(seed: int) -> list[Path]:
    """Return one path of each kind for the arm of a seed."""
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
        now = now if kind == "good" else [0.0, 0.0]  # roughly where the arm is afterwards
    return found


def teacher(seed: int) -> list[Callable[[], Node]]:
    """Return a program that requests paths of the arm of `arm_of(seed)` on /path, without times.

    On one of them it sends the arm somewhere else, without its action.
    """
    rows: list[Row] = []
    for number, path in enumerate(paths(seed)):
        begin = BEGIN + number * LESSON
        points = [JointTrajectoryPoint(positions=point) for point in path.points]
        rows.append((begin, "/path", JointTrajectory(joint_names=path.names, points=points)))
        if path.kind == "interrupted":
            rows.append((begin + INTERRUPTION, "/joint_commands", Float64MultiArray(data=[0.0, 0.0])))
    return [functools.partial(Schedule, "teacher", rows)]
