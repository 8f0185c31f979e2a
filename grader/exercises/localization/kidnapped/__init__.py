"""A robot in a hall where it can't know where it is at first, and that is carried away later."""

from typing import NamedTuple

import numpy as np

from grader.checks import Missed, otherwise, publishes, subscribes
from grader.companions.map_messages import pose_2d
from grader.exercise import Exercise
from grader.exercises.localization.kidnapped.hall import ALIKE, carried_hall, trip
from grader.exercises.localization.kidnapped.hall_driver import wandering
from grader.exercises.localization.kidnapped.log_score import LogScores, log_scores
from grader.geometry.near import is_near
from sim.evidence import Message, Recording, Seconds

__all__ = ["carried_hall", "kidnapped", "log_scores", "wandering"]

CLOUD, TOPIC = "nav2_msgs/msg/ParticleCloud", "/particle_cloud"
LOCALIZED = "/localized"
APART: Seconds = 0.5  # clouds that come faster are not all scored
BEGINS: Seconds = 1.0  # by then a node has received the map and the parking places
LIMITS = ALIKE, 4.4  # m from the middle of the hall: up to there it looks the same; from there it doesn't
DECIDES: Seconds = 2.0  # so long after it has come there, a filter has used some scans of it
NOTICES: Seconds = 6.0  # after it was carried away
FOUND: Seconds = 18.0  # after it was carried away
BOTH, HERE, AGAIN = 4.5, 5.0, 3.0  # mean log scores
MARGIN = 3.0  # by which the score at the robot is above that at its twin: 95 % of the weight
LEAST = 0.5  # clouds a second
MOSTLY = 0.8  # of the messages on /localized

kidnapped = Exercise("kidnapped", "Carried away", world=carried_hall, seconds=46, companions=wandering,
                     seeds=(1,))


class TripTimes(NamedTuple):
    """The times when a robot leaves the part that looks the same, is at an end, and is carried away (s)."""

    leaves: Seconds
    at_end: Seconds
    carried: Seconds


def _times(run: Recording) -> TripTimes:
    one = trip(run.seed)
    far = [(pose.stamp, abs(pose.x - one.middle[0])) for pose in run.path]
    leaves, at_end = (next((stamp for stamp, off in far if off > limit), one.carried) for limit in LIMITS)
    return TripTimes(leaves, at_end, one.carried)


@kidnapped.check(1)
def publishes_clouds(run: Recording) -> list[LogScores]:
    """It subscribes to /map, /parking_poses and /scan, and publishes weighted clouds, and /localized."""
    subscribes(run, "/map", "nav_msgs/msg/OccupancyGrid")
    subscribes(run, "/parking_poses", "geometry_msgs/msg/PoseArray")
    subscribes(run, "/scan", "sensor_msgs/msg/LaserScan")
    for row in publishes(run, TOPIC, CLOUD):
        _validate(row)
    publishes(run, LOCALIZED, "std_msgs/msg/Bool")
    return log_scores(run, APART)


def _validate(row: Message) -> None:
    """Raise Missed for a cloud that has no score."""
    frame, particles = row.message.header.frame_id, row.message.particles
    if frame != "map" or not particles:
        saw = f"{len(particles)} in {frame!r} at {row.stamp:.3g} s"
        raise Missed("particles in the frame 'map'", saw, "Set header.frame_id; publish once there are some.")
    weights = np.array([item.weight for item in particles])
    poses = np.array([pose_2d(item.pose) for item in particles])
    if not (np.isfinite(poses).all() and (weights >= 0).all() and is_near(float(weights.sum()), 1.0, 0.01)):
        saw = f"the sum {weights.sum():.3g} at {row.stamp:.3g} s"
        hint = "Subtract the largest log, exp(), and divide by the sum. Of 500 equal ones each has 0.002."
        raise Missed("finite poses, and weights with the sum 1", saw, hint)


def _mean(run: Recording, scores: list[LogScores], begin: Seconds, end: Seconds) -> LogScores:
    """The mean scores of the clouds in this time. Raises Missed for too few."""
    found = [one for one in scores if begin <= one.stamp < end]
    if len(found) < max(1, int(LEAST * (min(end, run.ended.stamp) - begin))):
        hint = "Publish a cloud with every 20th scan, from the first to the last."
        saw = f"{len(found)} from {begin:.3g} s to {end:.3g} s"
        raise Missed("a cloud each second", saw, hint, picture="topics")
    return LogScores(*(float(np.mean(column)) for column in zip(*found, strict=True)))


def _picks_one(run: Recording, mean: LogScores) -> bool:
    return max(mean.here, mean.there) > BOTH


BOTH_PLACES = (
    "All particles are around one of the two places, and no scan has shown which one is right. Begin with "
    "half of them around each; resample only if few particles count, and with evenly spaced marks.")


@kidnapped.check(4, after=publishes_clouds, hints={
    BOTH_PLACES: _picks_one,
    "The cloud is too wide, or somewhere else, or its weight is. /parking_poses has two poses that are right "
    "within 0.1 m and 0.1 rad: start there, move by the odometry's differences, and weigh by the scans.":
        otherwise,
})
def keeps_both(run: Recording, scores: list[LogScores]) -> list[LogScores]:
    """While no scan can tell the two places apart, the cloud is at both, so its mean log score is high."""
    leaves = _times(run).leaves
    mean = _mean(run, scores, BEGINS, leaves)
    if not (mean.here + mean.there) / 2 >= BOTH:
        expected = f"mean log scores at the robot and at its twin of {BOTH:g} or more up to {leaves:.3g} s"
        raise Missed(expected, f"{mean.here:.1f} and {mean.there:.1f}", about=(mean,), picture="path")
    return scores


@kidnapped.check(3, after=keeps_both)
def decides(run: Recording, scores: list[LogScores]) -> None:
    """2 s after it has come to an end of the hall, the cloud is at the robot, and not at its twin."""
    times = _times(run)
    mean = _mean(run, scores, times.at_end + DECIDES, times.carried)
    if not (mean.here >= HERE and mean.here - mean.there >= MARGIN):
        expected = (f"mean log scores of {HERE:g} or more at the robot, and {MARGIN:g} less at its twin, "
                    f"from {times.at_end + DECIDES:.3g} s on")
        hint = ("At the end a third of the rays differ. Weigh by the scans there, too, and resample: are "
                "some 20 rays used, and does a ray that fits nowhere still have a probability above 0?")
        raise Missed(expected, f"{mean.here:.1f} and {mean.there:.1f}", hint, picture="path")


def _lost(run: Recording, mean: LogScores) -> bool:
    return max(mean.here, mean.there) < -3.0


@kidnapped.check(4, after=publishes_clouds, hints={
    "The cloud stays where the robot isn't. Compare the mean fit of the newest scans with its usual value: "
    "if it falls, particles all over the map are needed, some with each scan or a whole new cloud.": _lost,
    "It is too wide, or comes and goes. Are there enough particles, 3000 of them, is sigma wide enough to "
    "feel a wall that is 0.25 m away, and do random particles stop when the scans fit again?": otherwise,
})
def finds_itself_again(run: Recording, scores: list[LogScores]) -> None:
    """18 s after someone has carried the robot away, the cloud is where it is, or at its twin."""
    begin = _times(run).carried + FOUND
    mean = _mean(run, [one._replace(here=max(one.here, one.there)) for one in scores], begin, run.ended.stamp)
    if not mean.here >= AGAIN:
        expected = f"a mean log score at the robot or at its twin of {AGAIN:g} or more from {begin:.3g} s on"
        raise Missed(expected, f"{mean.here:.1f}", about=(mean,), picture="path")


def _share(run: Recording, begin: Seconds, end: Seconds) -> float:
    """The part of the messages on /localized that say yes, in this time."""
    found = [row.message.data for row in run.messages(LOCALIZED) if begin <= row.stamp < end]
    if not found:
        raise Missed(f"a Bool on {LOCALIZED} each second", f"none from {begin:.3g} s to {end:.3g} s",
                     "Publish it with each scan.", picture="topics")
    return float(sum(found) / len(found))


@kidnapped.check(2, after=keeps_both)
def says_that_it_cannot_know(run: Recording) -> None:
    """/localized is False while both places are possible, and within 6 s after the robot was carried away."""
    times = _times(run)
    share = _share(run, BEGINS, times.leaves)
    if not share <= 1 - MOSTLY:
        hint = "There are two clusters. Say True only while most of the weight is around one place."
        raise Missed(f"False up to {times.leaves:.3g} s", f"True in {share:.0%} of the messages", hint)
    if not _share(run, times.carried, times.carried + NOTICES) < 1.0:
        hint = "A narrow cloud can be in the wrong place: say True only while the newest scans fit, too."
        raise Missed(f"False within {NOTICES:g} s after {times.carried:.3g} s, when it was carried away",
                     "True", hint)


@kidnapped.check(2, after=decides)
def says_that_it_knows(run: Recording) -> None:
    """/localized is True from 2 s after it has come to an end until it is carried away."""
    times = _times(run)
    begin = times.at_end + DECIDES
    share = _share(run, begin, times.carried)
    if not share >= MOSTLY:
        hint = ("One cluster has nearly all the weight here. Publish True if so, and allow for some random "
                "particles elsewhere.")
        expected = f"True from {begin:.3g} s to {times.carried:.3g} s"
        raise Missed(expected, f"in {share:.0%} of the messages", hint)
