"""Positions and paths for a joint or an arm to go to, and programs that request them or go to them."""

import functools
import random
from collections.abc import Callable
from typing import NamedTuple

from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from grader.companions.qos import LATCHED
from grader.companions.schedule import Row, Schedule
from grader.worlds.arms import arm_of, joint_of
from sim.world.machines import ArmModel, JointModel

STATIONS, VISIT = 4, 2.2  # positions; s from pose to pose
NEAR, FAR = (0.03, 0.07), (0.25, 0.6)  # rad from a limit: near for sure, and not near for sure
AT_LIMIT, AT_MARGIN = (0.0, 0.0), (0.1, 0.1)  # rad: the limit itself, and where the margin of `limits` ends
NAMES = ["shoulder_joint", "elbow_joint"]
CRUISE = 0.8  # rad/s, in tasks
BEGIN, LESSON, INTERRUPTION = 0.5, 4.5, 1.0  # s: first path; from path to path; until one is broken off
KINDS = "good", "beyond", "interrupted"


def stations(seed: int) -> list[float]:
    """Return positions (rad) for the joint of a seed, far enough apart, and near enough to be quick."""
    draw, model = random.Random(f"stations {seed}"), joint_of(seed).machine
    assert isinstance(model, JointModel)
    places: list[float] = []
    now = 0.0
    while len(places) < STATIONS:
        place = round(draw.uniform(model.lower, model.upper), 2)
        far = abs(place - now) / model.max_velocity  # s
        if 0.8 <= far <= 4.0 and (far > 2.5 or len(places) != 1):  # to one, two seconds are not enough
            places.append(place)
            now = place
    return places


def foreman(seed: int) -> list[Callable[[], Node]]:
    """Return a program that publishes the positions for `joint_of(seed)`: latched, on /positions.

    It waits until all programs have discovered each other: a command sent in response is received.
    """
    row = 0.1, "/positions", Float64MultiArray(data=stations(seed))
    return [functools.partial(Schedule, "foreman", [row], LATCHED)]


class Gripper(Node):
    """Another driver that publishes /joint_states, of its own joint only: how far it is open (m)."""

    def __init__(self) -> None:
        super().__init__("gripper")
        publisher = self.create_publisher(JointState, "/joint_states", 10)
        state = JointState(name=["gripper_joint"], position=[0.04], velocity=[0.0])
        self.create_timer(0.13, lambda: publisher.publish(state))


def poses(seed: int) -> list[list[float]]:
    """Return poses for the arm of a seed: each joint is near each of its limits once, and then away again.

    One of them is at a limit. Another, where the joint has time to come to rest, is where the margin ends.
    """
    draw, joints = random.Random(f"poses {seed}"), _arm_of(seed).joints
    near = [(index, upper) for index in (0, 1) for upper in (False, True)]
    draw.shuffle(near)
    margins = [NEAR, *draw.sample([NEAR, AT_LIMIT, AT_MARGIN], 3)]
    rows: list[list[float]] = []
    for (index, upper), margin in zip(near, margins, strict=True):
        row = [_place(draw, joint, draw.random() < 0.5, FAR) for joint in joints]
        row[index] = _place(draw, joints[index], upper, margin)
        if margin == AT_MARGIN:
            rows[-1][index] = _place(draw, joints[index], upper, FAR)
        rows += [row, [_place(draw, joint, draw.random() < 0.5, FAR) for joint in joints]]
    return rows[:-1]


def _arm_of(seed: int) -> ArmModel:
    model = arm_of(seed).machine
    assert isinstance(model, ArmModel)
    return model


def _place(draw: random.Random, joint: JointModel, upper: bool, margin: tuple[float, float]) -> float:
    away = draw.uniform(*margin)
    return joint.upper - away if upper else joint.lower + away


def gymnast(seed: int) -> list[Callable[[], Node]]:
    """Return a program that moves the arm of `arm_of(seed)` from pose to pose, and a gripper."""
    commands = (Float64MultiArray(data=pose) for pose in poses(seed))
    rows = [(number * VISIT, "/joint_commands", command) for number, command in enumerate(commands, start=1)]
    return [functools.partial(Schedule, "gymnast", rows), Gripper]


class Path(NamedTuple):
    """Poses to go through, joints in the order of the names."""

    kind: str  # of KINDS
    names: list[str]
    points: list[list[float]]


def paths(seed: int) -> list[Path]:
    """Return one path of each kind for the arm of a seed."""
    draw, arm = random.Random(f"paths {seed}"), _arm_of(seed)
    found: list[Path] = []
    now = [0.0, 0.0]
    kinds = draw.sample(KINDS, 3)
    if kinds[-1] == "good":  # after it the arm isn't at 0, 0, which the next path shows
        kinds[1:] = kinds[:0:-1]
    for kind in kinds:
        points: list[list[float]] = []
        while len(points) < 2:
            point = [round(draw.uniform(joint.lower + 0.1, joint.upper - 0.1), 2) for joint in arm.joints]
            if 0.7 <= max(abs(a - b) for a, b in zip(point, now, strict=True)) <= 1.2:
                points.append(point)
                now = point
        if kind == "beyond":
            index = draw.choice((0, 1))
            points[-1][index] = round(arm.joints[index].upper + draw.uniform(0.1, 0.4), 2)
        first = -1 if arm.elbow_first else 1
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
