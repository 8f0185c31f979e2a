"""The log score rewards the cloud that says what can be known, and no other."""

import math

import numpy as np
import pytest
from geometry_msgs.msg import Pose
from nav2_msgs.msg import Particle, ParticleCloud
from rclpy.node import Node

from grader.exercises import localization
from grader.exercises.localization.kidnapped.hall import HALF_LENGTH, HALF_WIDTH, trip, twin
from grader.exercises.localization.kidnapped.log_score import log_score
from grader.geometry import Pose2D
from sim import run

TRUTH, MIDDLE = Pose2D(1.5, 0.2, 3.1), (0.0, 0.0)
DRAW = np.random.default_rng(1)


def _around(pose, spread, count=2000):
    return DRAW.normal(pose, (spread, spread, min(spread, 3.0)), (count, 3))


def _score(poses, truth=TRUTH):
    return log_score(poses, np.full(len(poses), 1 / len(poses)), truth)


def test_a_cloud_that_is_everywhere_has_the_score_0():
    limits = HALF_LENGTH, HALF_WIDTH, math.pi
    poses = DRAW.uniform(np.negative(limits), limits, (40_000, 3))
    assert _score(poses) == pytest.approx(0.0, abs=0.3)


def test_a_cloud_at_the_robot_has_a_high_score_and_one_elsewhere_has_the_lowest():
    assert _score(_around(TRUTH, 0.05)) == pytest.approx(8.2, abs=0.2)
    assert _score(_around(twin(TRUTH, MIDDLE), 0.05)) == pytest.approx(math.log(0.01))


def test_headings_on_both_sides_of_pi_are_near():
    other = Pose2D(TRUTH.x, TRUTH.y, TRUTH.yaw - math.tau)
    assert _score(_around(other, 0.05)) == pytest.approx(8.2, abs=0.2)


def test_very_wide_clouds_are_worth_little():
    assert _score(_around(TRUTH, 10.0)) < 0.0
    assert _score(_around(TRUTH, 1.0)) < 3.5


@pytest.mark.parametrize("wrong", [0.0, 0.02, 0.98, 1.0])
def test_the_score_is_proper_the_true_probabilities_are_best(wrong):
    def expected(share):
        """The mean score if the robot is at each of two places in half of the cases."""
        far = _around(twin(TRUTH, MIDDLE), 0.05)
        poses = np.concatenate([_around(TRUTH, 0.05)[: round(2000 * share)], far[: round(2000 * (1 - share))]])
        return (_score(poses) + _score(poses, twin(TRUTH, MIDDLE))) / 2

    assert expected(wrong) < expected(0.5) - 1.0
    assert expected(0.5) == pytest.approx(7.5, abs=0.3)


def test_weights_count():
    poses = np.array([TRUTH, twin(TRUTH, MIDDLE)])
    scores = [log_score(poses, np.array([share, 1 - share]), TRUTH) for share in (0.1, 0.5, 0.9)]
    assert scores == sorted(scores)
    assert scores[1] - scores[0] == pytest.approx(math.log(5), abs=0.01)


class Certain(Node):
    """Publishes one particle ten times a second: where the robot starts."""

    weight = 2.0

    def __init__(self):
        super().__init__("certain")
        self.publisher = self.create_publisher(ParticleCloud, "/particle_cloud", 10)
        self.create_timer(0.1, self.publish)

    def publish(self):
        x, y, yaw = trip(3).start
        pose = Pose()
        pose.position.x, pose.position.y = x, y
        pose.orientation.z, pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        self.publisher.publish(ParticleCloud(particles=[Particle(pose=pose, weight=self.weight)]))


class WithoutWeight(Certain):
    weight = 0.0


def _run(node, companions, seconds):
    world = localization.carried_hall(3)
    return run(node, companions=companions, world=world, seconds=seconds, seed=3, quiet=True)


def test_the_scores_of_a_run_are_those_at_the_robot_and_at_its_twin():
    first, *_, last = localization.log_scores(_run(Certain, localization.wandering(3), 9.0))
    start = trip(3)
    assert first.stamp == pytest.approx(0.1, abs=0.01)
    assert first.off_middle == pytest.approx(abs(start.start[0] - start.middle[0]), abs=0.02)
    assert first.here > 5.0
    assert first.there == pytest.approx(math.log(0.01))
    assert last.here == pytest.approx(math.log(0.01))  # the robot has left


def test_clouds_that_come_fast_are_not_all_scored():
    recording = _run(Certain, [], 2.05)
    assert len(localization.log_scores(recording)) == 20
    assert [score.stamp for score in localization.log_scores(recording, apart=0.95)] == pytest.approx([0.1, 1.1])


def test_a_cloud_without_weights_is_an_error():
    recording = _run(WithoutWeight, [], 0.5)
    with pytest.raises(ValueError, match=r"^the cloud at 0\.1 s has no particles with a weight$"):
        localization.log_scores(recording)
