"""A cloud that moves as the robot does, is weighed, and keeps its variety."""

from typing import NamedTuple

import numpy as np

from grader.checks import Missed, otherwise, publishes, subscribes
from grader.companions.map_messages import pose_2d
from grader.exercise import Exercise
from grader.exercises.localization.resample.reference_filter import Shape, shape_of, shapes_at
from grader.exercises.localization.resample.tour import (
    ENDS,
    LEAVES,
    RANGES,
    STANDS,
    STARTS,
    tour_yard,
    touring,
)
from grader.geometry import Pose2D
from grader.geometry.near import is_near
from grader.variants import Variants
from sim.evidence import Message, Recording, Seconds

__all__ = ["resample", "tour_yard", "touring"]

CLOUD, TOPIC = "nav2_msgs/msg/ParticleCloud", "/particle_cloud"
LEAST = 250  # particles
# By how much a standard deviation may be off either way, as a factor, and a mean, in standard deviations:
# without the beacon and with it. 60 clouds of 400 were off by up to 1.11 and 0.06, and by 1.53 and 0.69.
ALONE, WITH_BEACON = (1.3, 0.3), (2.0, 1.2)
SLACK = 0.02  # m and rad that either may be off besides
UNLUCKY = 0.3  # of the clouds with the beacon may be off more: with 400 particles, one was in 6 of 800 runs
PERIOD: Seconds = 2.0  # of the clouds
SETTLED: Seconds = 3.0  # after which a node has received enough
VARIETY = 0.9  # of the particles that differ
FADED = 0.3  # of all particles: an effective number below this is too late to resample


class Cloud(NamedTuple):
    """A cloud that a node published: poses in rows x, y, yaw, and weights with the sum 1."""

    stamp: Seconds
    poses: np.ndarray
    weights: np.ndarray
    should: Shape

    @property
    def shape(self) -> Shape:
        """The cloud's mean and standard deviations."""
        return shape_of(self.poses, self.weights)

    @property
    def variety(self) -> float:
        """The part of the particles that differ from all before them."""
        return len(np.unique(np.round(self.poses, 9), axis=0)) / len(self.poses)

    @property
    def effective(self) -> float:
        """The effective number of particles, as a part of all."""
        return float(1 / (self.weights @ self.weights) / len(self.weights))


resample = Exercise("resample", "Move, weigh, resample", world=tour_yard, seconds=ENDS, companions=touring,
                    seeds=(1, 2), variants=Variants(
    {"along": (0.02, 0.04)},
    {"turn": (0.01, 0.03)},
    texts=("{along} * d", "{along} * far", "{along} * meters", "{turn} * a", "{turn} * abs"),
))


@resample.check(1)
def publishes_a_cloud(run: Recording) -> None:
    """It subscribes to /initialpose, /odom, /beacon and /range, and publishes a ParticleCloud."""
    subscribes(run, "/initialpose", "geometry_msgs/msg/PoseWithCovarianceStamped")
    subscribes(run, "/odom", "nav_msgs/msg/Odometry")
    subscribes(run, "/beacon", "geometry_msgs/msg/PointStamped")
    subscribes(run, "/range", "sensor_msgs/msg/Range")
    publishes(run, TOPIC, CLOUD)


def _clouds(run: Recording) -> list[Cloud]:
    """All clouds that were published once the node knew where it starts."""
    rows = [row for row in run.messages(TOPIC) if not row.from_course and row.stamp > STARTS + 0.2]
    should = shapes_at(run, [row.stamp for row in rows], resample.drawn.along, resample.drawn.turn)
    return [_cloud(*pair) for pair in zip(rows, should, strict=True)]


def _cloud(row: Message, should: Shape) -> Cloud:
    message = row.message
    poses = np.array([pose_2d(item.pose) for item in message.particles]).reshape(-1, 3)
    weights = np.array([item.weight for item in message.particles])
    if message.header.frame_id != "map" or len(poses) < LEAST:
        saw = f"{len(poses)} in {message.header.frame_id!r} at {row.stamp:.3g} s"
        hint = "The task says how many there are."
        raise Missed(f"{LEAST} particles or more in the frame 'map'", saw, hint)
    if not (np.isfinite(poses).all() and (weights >= 0).all() and is_near(float(weights.sum()), 1.0, 0.01)):
        saw = f"the sum {weights.sum():.3g} at {row.stamp:.3g} s, and a pose {Pose2D(*poses[0])}"
        raise Missed("finite poses, and weights with the sum 1", saw,
                     "Keep logs of the weights; subtract the largest, then exp(), then divide by the sum.")
    return Cloud(row.stamp, poses, weights, should)


def _part(clouds: list[Cloud], begin: Seconds, end: Seconds, expected: str) -> list[Cloud]:
    found = [cloud for cloud in clouds if begin < cloud.stamp < end]
    if len(found) < (end - begin) / PERIOD / 2:
        raise Missed(f"a cloud every {PERIOD:g} s {expected}", f"{len(found)} from {begin:g} s to {end:g} s",
                     f"Publish the cloud in the callback of a timer with a period of {PERIOD:g} s.",
                     picture="topics")
    return found


def _ratio(is_: float, should: float) -> float:
    return (is_ + SLACK) / (should + SLACK)


def _has_no_spread(run: Recording, cloud: Cloud) -> bool:
    return max(cloud.shape[1:]) < 0.01


def _is_swapped(run: Recording, cloud: Cloud) -> bool:
    along, across = (_ratio(*pair) for pair in zip(cloud.shape[1:3], cloud.should[1:3], strict=True))
    return (along < 0.9 and across > 1.05) or (along > 1.1 and across < 0.95)


def _is_off(run: Recording, cloud: Cloud) -> bool:
    return not is_near(cloud.shape.mean[:2], cloud.should.mean[:2], 0.3)


def _is_narrow(run: Recording, cloud: Cloud) -> bool:
    return cloud.shape.along < cloud.should.along


@resample.check(4, after=publishes_a_cloud, hints={
    "The particles are elsewhere. Odometry is a difference: subtract the previous /odom message, rotate that "
    "by minus its yaw into the body's frame, and let each particle move so in the direction that it faces.":
        _is_off,
    "All particles are at one point. Draw them with the covariance of /initialpose: [0], [7] and [35] are "
    "the variances of x, y and yaw.": _has_no_spread,
    "Along and across look swapped. The noise belongs to the body: add it to the forward and the left part "
    "of the step first, then rotate by the particle's yaw.": _is_swapped,
    "Too narrow: each particle's own step needs noise of its own, with the variance of the task. normal() "
    "takes the standard deviation, sqrt(0.02 * meters), which is far more than 0.02 * meters.": _is_narrow,
    "Too wide: normal() takes the standard deviation, sqrt(0.02 * meters), and each step has its own meters.":
        otherwise,
})
def moves_with_the_robot(run: Recording) -> list[Cloud]:
    """Until the beacon begins, the cloud's mean and spread are those of the noise in the task."""
    clouds = _clouds(run)
    for cloud in _part(clouds, LEAVES, RANGES, "from the start on"):
        _compare(cloud, *ALONE)
    return clouds


def _compare(cloud: Cloud, factor: float, off: float) -> None:
    """Raise Missed for a cloud with another mean or spread than it should have."""
    is_, should = cloud.shape, cloud.should
    scale = max(should.along, should.across)
    turn = abs(np.remainder(is_.mean[2] - should.mean[2] + np.pi, 2 * np.pi) - np.pi)
    if not (is_near(is_.mean[:2], should.mean[:2], off * scale + SLACK)
            and is_near(float(turn), 0.0, off * should.yaw + SLACK)):
        expected = f"a mean near {Pose2D(*should.mean)} at {cloud.stamp:.3g} s"
        raise Missed(expected, f"{Pose2D(*is_.mean)}", about=(cloud,), picture="path")
    for name, unit, here, there in zip(("along", "across", "yaw"), ("m", "m", "rad"), is_[1:], should[1:],
                                       strict=True):
        if not 1 / factor < _ratio(here, there) < factor:
            where = "of yaw" if name == "yaw" else f"{name} the robot"
            expected = f"a standard deviation {where} of about {there:.2f} {unit} at {cloud.stamp:.3g} s"
            raise Missed(expected, f"{here:.2f} {unit}", about=(cloud,), picture="path")


def _always_resamples(run: Recording, cloud: Cloud) -> bool:
    return bool(np.ptp(cloud.weights) < 1e-9)


def _fades(run: Recording, cloud: Cloud) -> bool:
    return cloud.effective < FADED


@resample.check(4, after=moves_with_the_robot, hints={
    "Resample once the effective number, 1 / sum(w^2), is below half of the particles: one particle has "
    "nearly all the weight.": _fades,
    "Particles are equal, though each has its own noise: has resampling put the same object into the list "
    "twice? Copy it, or use an array.": lambda run, cloud: cloud.variety < VARIETY,
    "The weights are equal in every cloud, so a range changes nothing, or each one is followed by "
    "resampling. Multiply the weights (add the logs), and resample below half of the particles only.":
        _always_resamples,
    "Compare each particle's distance to the beacon with the range; sigma is 0.15 m. A range counts when the "
    "robot has moved by 0.1 m or 0.1 rad since the last one that did; after resampling weights are equal.":
        otherwise,
})
def weighs_and_resamples(run: Recording, clouds: list[Cloud]) -> list[Cloud]:
    """With the beacon, mean and spread follow; it resamples only when few particles count."""
    driving = _part(clouds, RANGES + SETTLED, STANDS, "with the beacon")
    for cloud in driving:
        if cloud.effective < FADED:
            expected = f"an effective number above {FADED:.0%} of the particles at {cloud.stamp:.3g} s"
            raise Missed(expected, f"{cloud.effective:.0%}", about=(cloud,))
    usual = sorted(driving, key=lambda cloud: cloud.variety)[len(driving) // 2]
    if usual.variety < VARIETY:  # just after resampling, two particles may be equal
        expected = f"{VARIETY:.0%} of the particles different while the robot drives, in most clouds"
        raise Missed(expected, f"{usual.variety:.0%} at {usual.stamp:.3g} s", about=(usual,))
    if all(_always_resamples(run, cloud) for cloud in driving):
        raise Missed("weights that differ, in some cloud", "equal weights in all", about=(driving[0],))
    misses = [miss for cloud in driving if (miss := _missed(cloud, *WITH_BEACON))]
    if len(misses) > UNLUCKY * len(driving):
        raise misses[0]
    return clouds


def _missed(cloud: Cloud, factor: float, off: float) -> Missed | None:
    """What a cloud misses, if its mean or spread isn't what it should be."""
    try:
        _compare(cloud, factor, off)
    except Missed as miss:
        return miss
    return None


@resample.check(3, after=weighs_and_resamples)
def keeps_its_variety(run: Recording, clouds: list[Cloud]) -> None:
    """While the robot stands for a minute, the cloud stays as it is."""
    standing = _part(clouds, STANDS + 1.0, ENDS, "while the robot stands")
    hint = ("Each range repeats the last one while the robot stands, so it adds nothing: weigh and resample "
            "only when it has moved by 0.1 m or 0.1 rad since the last time.")
    first = standing[0]
    for cloud in standing[1:]:
        if not cloud.variety >= VARIETY * first.variety:
            expected = f"{first.variety:.0%} of the particles different, as at {first.stamp:.3g} s"
            raise Missed(expected, f"{cloud.variety:.0%} at {cloud.stamp:.3g} s", hint)
        for is_, was in zip(cloud.shape[1:], first.shape[1:], strict=True):
            if not is_near(is_, was, 0.1 * was + 1e-3):
                expected = f"a standard deviation of {was:.2f}, as at {first.stamp:.3g} s"
                raise Missed(expected, f"{is_:.2f} at {cloud.stamp:.3g} s", hint)
