"""How the navigator of lesson 6b drives on the localization of lesson 14c, while its wheels slip.

python -m tests.bench.localized --worlds 100
"""

import argparse
import itertools
import math
import statistics
import sys
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np
from geometry_msgs.msg import PoseWithCovarianceStamped
from rclpy.node import Node

from grader.exercises import localization, navigator
from sim import Recording, World, run
from tests.bench.navigator import fault
from tests.bench.report import table

COURSE = Path(__file__).parents[2] / "course"
SECONDS, NEAR, BINS = 120, 0.35, (0, 5, 10, 20, 40, 80, 120)  # s, m, s
ROWS = 0, 1, 5  # of a covariance: x, y, yaw


class Click(Node):
    """Sends /initialpose once, about 20 cm and 10 degrees off, as in the lesson."""

    start = (0.0, 0.0, 0.0)

    def __init__(self) -> None:
        super().__init__("rviz")
        self.publisher = self.create_publisher(PoseWithCovarianceStamped, "/initialpose", 10)
        self.timer = self.create_timer(0.5, self.click)

    def click(self) -> None:
        """Publish it, and never again."""
        self.timer.cancel()
        message, (x, y, yaw) = PoseWithCovarianceStamped(), self.start
        message.header.frame_id, message.header.stamp = "map", self.get_clock().now().to_msg()
        pose = message.pose.pose
        pose.position.x, pose.position.y = x + 0.15, y - 0.1
        pose.orientation.z, pose.orientation.w = math.sin((yaw + 0.15) / 2), math.cos((yaw + 0.15) / 2)
        message.pose.covariance[0] = message.pose.covariance[7] = message.pose.covariance[35] = 0.2**2
        self.publisher.publish(message)


def programs() -> tuple[Callable[[], None], Callable[[], None]]:
    """The main() of the lesson's localizer, and that of the navigator."""
    sys.path += [str(COURSE / "14_localization"), str(COURSE / "06_navigator")]
    import localizer
    import whole

    whole.MARGIN = 0.2  # m, as in the lesson: the pose is a few centimeters off
    return localizer.main, whole.main


class Outcome(NamedTuple):
    """How a drive went. estimates: (s, error in m, -log of the density at the true pose)."""

    seed: int
    fault: str
    estimates: list[tuple[float, float, float]]


def drive(seed: int, trusts_odometry: bool) -> Outcome:
    """Send a robot with bad wheels to its goal."""
    world = localization.slippery(World.generate("room", seed=seed, width=8.0, height=6.0, boxes=6))
    localizer, whole = programs()
    map_server, from_odometry = navigator.bringup(world)
    click = navigator.made_for(Click, start=world.start)
    client = navigator.made_for(navigator.GoalClient, goal=world.goal)
    where = [from_odometry] if trusts_odometry else [click, localizer]
    recording = run(
        *(map_server, *where, client, whole), world=world, seconds=SECONDS, seed=seed, quiet=True,
        until=lambda recording: bool(recording.goals) and recording.goals[0].over,
    )  # fmt: skip
    return Outcome(seed, fault(recording, NEAR), estimates(recording))


def estimates(recording: Recording) -> list[tuple[float, float, float]]:
    """For each message on /amcl_pose: when, how far off, and its score."""
    found = []
    for row in recording.messages("/amcl_pose"):
        pose = row.message.pose.pose
        truth = recording.pose_at(row.stamp)
        yaw = 2 * math.atan2(pose.orientation.z, pose.orientation.w)
        off = np.array([pose.position.x - truth.x, pose.position.y - truth.y, 0.0])
        off[2] = math.remainder(yaw - truth.yaw, math.tau)
        covariance = np.reshape(row.message.pose.covariance, (6, 6))[np.ix_(ROWS, ROWS)]
        _, logdet = np.linalg.slogdet(math.tau * covariance)
        score = (off @ np.linalg.solve(covariance, off) + logdet) / 2
        found.append((row.stamp, math.hypot(off[0], off[1]), float(score)))
    return found


def main() -> int:
    """Drive in all of them; the exit status says whether fewer than 95 % arrived without a contact."""
    parser = argparse.ArgumentParser("python -m tests.bench.localized", description=__doc__.splitlines()[0])
    parser.add_argument("--worlds", type=int, default=100, help="how many; default 100")
    parser.add_argument("--odometry", action="store_true", help="trust the odometry in place of the scans")
    given = parser.parse_args()
    outcomes = []
    for seed in range(1000, 1000 + given.worlds):
        outcomes.append(drive(seed, given.odometry))
        print(f"{seed}: {outcomes[-1].fault or 'reached'}", flush=True)
    rows = [row for outcome in outcomes for row in outcome.estimates]
    table(
        ["s", "estimates", "median error, m", "95 % of errors below, m", "median -log density"],
        [
            [f"{low} to {high}", len(errors), *_figures(errors, scores)]
            for low, high in itertools.pairwise(BINS)
            if (errors := [row[1] for row in rows if low <= row[0] < high])
            and (scores := [row[2] for row in rows if low <= row[0] < high])
        ],
    )
    reached = sum(not outcome.fault for outcome in outcomes)
    touched = sum(" touched at " in outcome.fault for outcome in outcomes)
    print(f"reached without a contact: {reached} of {given.worlds} worlds; touched something: {touched}")
    return int(reached < 0.95 * given.worlds)


def _figures(errors: list[float], scores: list[float]) -> list[str]:
    return [
        f"{statistics.median(errors):.3f}",
        f"{np.percentile(errors, 95):.3f}",
        f"{statistics.median(scores):.2f}",
    ]


if __name__ == "__main__":
    sys.exit(main())
