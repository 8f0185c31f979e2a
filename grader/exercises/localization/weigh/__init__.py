"""Weights of guesses about where the robot is: how well each of them explains a scan."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from grader.checks import Missed, otherwise, publishes, subscribes
from grader.checks.motion import world_in
from grader.companions.map_messages import pose_2d
from grader.exercise import Exercise, Scenario
from grader.exercises.localization.weigh.guesses import CLUSTER, Guess, guessing, is_close, visited
from grader.geometry.near import is_near
from grader.responses import from_course
from sim.evidence import Message, Recording, Seconds

__all__ = ["guessing", "visited", "weigh"]

CLOUD, TOPIC = "nav2_msgs/msg/ParticleCloud", "/particle_cloud"
PATIENCE = 1.0  # s after the guesses
FOUND = 15  # of the 20 heaviest guesses that are where the robot is
SHARED = 5.0  # effective number of the guesses that share the weight
SAME = 1e-6  # m, and in a quaternion


class Weighed(NamedTuple):
    """Guesses and the weights that a node gave them: arrays with a row for each guess."""

    stamp: Seconds
    guesses: list[Guess]
    weights: np.ndarray
    close: np.ndarray  # whether each guess is where the robot is

    @property
    def heaviest(self) -> np.ndarray:
        """The indices of the 20 heaviest guesses, the heaviest first."""
        return np.argsort(-self.weights, kind="stable")[:CLUSTER]

    @property
    def top(self) -> Guess:
        """The heaviest guess."""
        return self.guesses[int(self.heaviest[0])]


weigh = Exercise("weigh", "Weigh your guesses", scenarios=[
    Scenario(lambda seed: visited(seed)[0], 7, seed, guessing) for seed in (1, 2, 4)
])


@weigh.check(1)
def publishes_a_cloud(run: Recording) -> list[Message]:
    """The node subscribes to /candidates and /scan, and publishes a ParticleCloud on /particle_cloud."""
    subscribes(run, "/candidates", "geometry_msgs/msg/PoseArray")
    subscribes(run, "/scan", "sensor_msgs/msg/LaserScan")
    return publishes(run, TOPIC, CLOUD)


def _is_no_number(run: Recording, weights: np.ndarray) -> bool:
    return not np.isfinite(weights).all() or bool((weights == 0).all())


@weigh.check(2, after=publishes_a_cloud, hints={
    "0 / 0: the product of hundreds of probabilities is smaller than the smallest number, so it is 0. Add "
    "their logarithms; subtract the largest sum from all of them; then exp() of it. Is a ray inf or nan?":
        _is_no_number,
    "Divide each weight by the sum of all: weights / weights.sum().": otherwise,
})
def weighs_each(run: Recording) -> list[Weighed]:
    """For each /candidates it publishes the same poses in the same order; their weights add up to 1."""
    sets = from_course(run, "/candidates", at_least=2, what="guesses")
    return [_weighed(run, row) for row in sets if row.stamp + PATIENCE < run.ended.stamp]


def _weighed(run: Recording, row: Message) -> Weighed:
    sent = row.message
    clouds = [cloud.message for cloud in run.messages(TOPIC) if 0 <= cloud.stamp - row.stamp <= PATIENCE]
    if not clouds:
        hint = "Publish one ParticleCloud in the callback of /candidates, with that message's header."
        raise Missed(f"a cloud after the poses at {row.stamp:.3g} s", "none within 1 s", hint)
    cloud = clouds[0]
    guesses, poses = [pose_2d(pose) for pose in sent.poses], [item.pose for item in cloud.particles]
    if len(poses) != len(sent.poses):
        raise Missed(f"{len(sent.poses)} particles, one for each pose", f"{len(poses)}",
                     "Make one Particle(pose=..., weight=...) of each pose, heavy or not.")
    if cloud.header != sent.header or not np.allclose(_array(poses), _array(sent.poses), rtol=0, atol=SAME):
        raise Missed(f"the header and the poses of /candidates at {row.stamp:.3g} s", "others",
                     "Copy msg.header, and keep the order of the poses: who reads the cloud compares them.")
    weights = np.array([item.weight for item in cloud.particles])
    if not ((weights >= 0).all() and is_near(float(weights.sum()), 1.0, 0.01)):
        raise Missed("weights from 0 to 1 with the sum 1", f"the sum {weights.sum():.3g}", about=(weights,))
    truth = world_in(run).start
    return Weighed(row.stamp, guesses, weights, np.array([is_close(guess, truth) for guess in guesses]))


def _array(poses: Sequence[Any]) -> np.ndarray:
    rows = [(pose.position.x, pose.position.y, pose.orientation.z, pose.orientation.w) for pose in poses]
    return np.array(rows)


def _are_equal(run: Recording, found: Weighed) -> bool:
    return bool(np.ptp(found.weights) < 1e-9)


def _ignores_the_mounting(run: Recording, found: Weighed) -> bool:
    return is_close(found.top, world_in(run).lidar.mounted_at(world_in(run).start))


@weigh.check(6, after=weighs_each, hints={
    "All weights are equal, so the scan has changed nothing.": _are_equal,
    "The heaviest poses are where base_link would be if the lidar were in its middle and faced forward. The "
    "rays start at the lidar: look up scan.header.frame_id in base_link, and move the points there first.":
        _ignores_the_mounting,
    "Rotate the points by the pose's yaw, then add its position. The field's row comes from y, and its "
    "column from x. Leave out rays that are inf, -inf or nan.": otherwise,
})
def finds_the_robot(run: Recording, found: list[Weighed]) -> list[Weighed]:
    """Of the 20 heaviest poses, at least 15 are within some centimeters of the robot."""
    for one in found:
        right = int(one.close[one.heaviest].sum())
        if not right >= FOUND:
            x, y, yaw = one.top
            expected = f"at least {FOUND} of the 20 heaviest poses near the robot at {one.stamp:.3g} s"
            saw = f"{right}; the heaviest is x {x:.2f} m, y {y:.2f} m, yaw {yaw:.2f} rad"
            raise Missed(expected, saw, about=(one,))
    return found


@weigh.check(3, after=finds_the_robot)
def is_not_overconfident(run: Recording, found: list[Weighed]) -> None:
    """It can't tell poses apart that differ by 3 cm: those near the robot share the weight."""
    for one in found:
        near = one.weights[one.close]
        effective = float(near.sum() ** 2 / (near**2).sum())
        if not effective >= SHARED:
            expected = (f"an effective number, sum(w)^2 / sum(w^2), of at least {SHARED:g} for the "
                        f"{len(near)} poses near the robot")
            hint = ("The map's cells are 5 cm wide, so no scan decides between poses 3 cm apart. Neighboring "
                    "rays repeat one another's errors, so 360 rays aren't 360 proofs: use about 30 of them, "
                    "spread evenly, or divide the sum of logs by 10; and a sigma of 0.1 m or more.")
            raise Missed(expected, f"{effective:.2g} at {one.stamp:.3g} s", hint)
