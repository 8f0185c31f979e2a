"""Clouds that move, are weighed and resampled: right ones, and wrong ones named after their defect."""

import copy
import math
import random

import numpy as np
from geometry_msgs.msg import PointStamped, PoseWithCovarianceStamped
from nav2_msgs.msg import Particle, ParticleCloud
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import Range

from tests.exercises.localization.poses import pose_of, yaw_of

PARTS = ("_Guess",)
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Cloud(Node):
    """As in the solution; the others change one thing each."""

    count, along, aside, bend, turns, sigma = 400, 0.02, 0.002, 0.002, 0.01, 0.15

    def __init__(self):
        super().__init__("cloud")
        self.rng = np.random.default_rng()
        self.poses, self.logs = np.zeros((0, 3)), np.zeros(0)
        self.odometry = self.weighed_at = self.beacon = None
        self.publisher = self.create_publisher(ParticleCloud, "/particle_cloud", 10)
        self.create_subscription(PoseWithCovarianceStamped, "/initialpose", self.on_initialpose, 10)
        self.create_subscription(Odometry, "/odom", self.on_odom, 10)
        self.create_subscription(PointStamped, "/beacon", self.on_beacon, LATCHED)
        self.create_subscription(Range, "/range", self.on_range, 10)
        self.create_timer(2.0, self.publish)

    def on_beacon(self, msg):
        self.beacon = msg.point.x, msg.point.y

    def on_initialpose(self, msg):
        position, yaw = msg.pose.pose.position, yaw_of(msg.pose.pose.orientation)
        covariance = np.reshape(msg.pose.covariance, (6, 6))[np.ix_((0, 1, 5), (0, 1, 5))]
        self.draw((position.x, position.y, yaw), covariance)

    def draw(self, pose, covariance):
        self.poses = self.rng.multivariate_normal(pose, covariance, self.count)
        self.logs = np.zeros(self.count)

    def weights(self):
        weights = np.exp(self.logs - self.logs.max())
        return weights / weights.sum()

    def publish(self):
        if not len(self.poses):
            return
        cloud = ParticleCloud()
        cloud.header.frame_id, cloud.header.stamp = "map", self.get_clock().now().to_msg()
        pairs = zip(self.poses.tolist(), self.weights().tolist(), strict=True)
        cloud.particles = [Particle(pose=pose_of(*pose), weight=weight) for pose, weight in pairs]
        self.publisher.publish(cloud)

    def on_odom(self, msg):
        position, yaw = msg.pose.pose.position, yaw_of(msg.pose.pose.orientation)
        before, self.odometry = self.odometry, (position.x, position.y, yaw)
        if before is not None and len(self.poses):
            self.move(before, self.odometry)

    def step(self, before, now):
        dx, dy = now[0] - before[0], now[1] - before[1]
        cos, sin = math.cos(before[2]), math.sin(before[2])
        return cos * dx + sin * dy, cos * dy - sin * dx, math.remainder(now[2] - before[2], math.tau)

    def spreads(self, far, turn):
        return (
            math.sqrt(self.along * far),
            math.sqrt(self.aside * far),
            math.sqrt(self.turns * abs(turn) + self.bend * far),
        )

    def move(self, before, now):
        forward, left, turn = self.step(before, now)
        spreads = self.spreads(math.hypot(forward, left), turn)
        noise = self.rng.normal(size=(3, self.count)) * np.array(spreads)[:, None]
        self.advance(forward + noise[0], left + noise[1], turn + noise[2])

    def advance(self, forward, left, turn):
        cos, sin = np.cos(self.poses[:, 2]), np.sin(self.poses[:, 2])
        self.poses[:, 0] += cos * forward - sin * left
        self.poses[:, 1] += sin * forward + cos * left
        self.poses[:, 2] += turn

    def has_moved(self):
        if self.weighed_at is None:
            return True
        forward, left, turn = self.step(self.weighed_at, self.odometry)
        return math.hypot(forward, left) >= 0.1 or abs(turn) >= 0.1

    def on_range(self, msg):
        if self.odometry is None or self.beacon is None or not len(self.poses) or not self.has_moved():
            return
        self.weighed_at = self.odometry
        self.weigh(msg.range)
        weights = self.weights()
        if self.is_poor(weights):
            self.take(self.chosen(weights))

    def weigh(self, distance):
        distances = np.hypot(*(self.poses[:, :2] - self.beacon).T)
        self.logs = self.logs - (distances - distance) ** 2 / (2 * self.sigma**2)

    def is_poor(self, weights):
        return 1 / (weights**2).sum() < self.count / 2

    def chosen(self, weights):
        marks = (self.rng.random() + np.arange(self.count)) / self.count
        return np.searchsorted(np.cumsum(weights), marks).clip(max=self.count - 1)

    def take(self, chosen):
        self.poses, self.logs = self.poses[chosen], np.zeros(self.count)


class Stratified(Cloud):
    """A random number in each of the equal parts."""

    def chosen(self, weights):
        marks = (self.rng.random(self.count) + np.arange(self.count)) / self.count
        return np.searchsorted(np.cumsum(weights), marks).clip(max=self.count - 1)


class Wheel(Cloud):
    """The resampling wheel, in plain Python."""

    def chosen(self, weights):
        index, total, chosen = 0, weights[0], []
        begin = self.rng.random() / self.count
        for number in range(self.count):
            mark = begin + number / self.count
            while total < mark and index < self.count - 1:
                index += 1
                total += weights[index]
            chosen.append(index)
        return np.array(chosen)


class Multinomial(Cloud):
    """Random draws, which are noisier than the wheel."""

    count = 600

    def chosen(self, weights):
        return self.rng.choice(self.count, self.count, p=weights)


class KeepsWeights(Cloud):
    """Weights instead of their logarithms, normalized after each range."""

    def weigh(self, distance):
        distances = np.hypot(*(self.poses[:, :2] - self.beacon).T)
        likelihood = np.exp(-((distances - distance) ** 2) / (2 * self.sigma**2)) + 1e-12
        weights = self.weights() * likelihood
        self.logs = np.log(weights / weights.sum())


class TurnsHalfFirst(Cloud):
    """A design of its own: half of the turn, the drive, the other half."""

    def advance(self, forward, left, turn):
        self.poses[:, 2] += turn / 2
        super().advance(forward, left, 0 * turn)
        self.poses[:, 2] += turn / 2


class Lumped(Cloud):
    """A design of its own: steps are collected until the robot has moved by 2 cm or 0.05 rad."""

    def __init__(self):
        super().__init__()
        self.begun = None

    def move(self, before, now):
        self.begun = self.begun or before
        forward, left, turn = self.step(self.begun, now)
        if math.hypot(forward, left) > 0.02 or abs(turn) > 0.05:
            super().move(self.begun, now)
            self.begun = None


class _Guess:
    """One particle of a list."""

    def __init__(self, x, y, yaw):
        self.x, self.y, self.yaw = x, y, yaw

    def advance(self, forward, left, turn):
        self.x += math.cos(self.yaw) * forward - math.sin(self.yaw) * left
        self.y += math.sin(self.yaw) * forward + math.cos(self.yaw) * left
        self.yaw += turn


class Objects(Cloud):
    """A design of its own: a list of objects, which are copied when they are drawn again."""

    def draw(self, pose, covariance):
        deviations = np.sqrt(np.diag(covariance))
        self.guesses = [_Guess(*map(random.gauss, pose, deviations)) for _ in range(self.count)]
        self.logs = np.zeros(self.count)

    @property
    def poses(self):
        return np.array([(one.x, one.y, one.yaw) for one in self.guesses])

    @poses.setter
    def poses(self, rows):
        self.guesses = [_Guess(*row) for row in rows]

    def advance(self, forward, left, turn):
        for one, *step in zip(self.guesses, forward, left, turn, strict=True):
            one.advance(*step)

    def take(self, chosen):
        self.guesses, self.logs = [self.copied(self.guesses[one]) for one in chosen], np.zeros(self.count)

    def copied(self, guess):
        return copy.copy(guess)


# -- wrong ones --


class Silent(Cloud):
    def publish(self):
        pass


class StopsPublishing(Cloud):
    """Publishes three clouds."""

    left = 3

    def publish(self):
        if self.left:
            self.left -= 1
            super().publish()


class TooFew(Cloud):
    count = 50


class SameObjectTwice(Objects):
    def copied(self, guess):
        return guess


class AsAPose(Cloud):
    """Takes the odometry's step along the axes of odom."""

    def step(self, before, now):
        return now[0] - before[0], now[1] - before[1], math.remainder(now[2] - before[2], math.tau)

    def advance(self, forward, left, turn):
        self.poses += np.column_stack([forward, left, turn])


class WorldsAxes(Cloud):
    """Adds the noise along the axes of the map."""

    def move(self, before, now):
        forward, left, turn = self.step(before, now)
        spreads = self.spreads(math.hypot(forward, left), turn)
        self.advance(forward, left, turn)
        self.poses += self.rng.normal(size=(self.count, 3)) * spreads


class NoNoise(Cloud):
    along = aside = bend = turns = 0.0


class OneNoiseForAll(Cloud):
    def move(self, before, now):
        forward, left, turn = self.step(before, now)
        spreads = self.spreads(math.hypot(forward, left), turn)
        noise = self.rng.normal(size=3) * spreads
        self.advance(forward + noise[0], left + noise[1], turn + noise[2])


class VarianceIsDeviation(Cloud):
    """Passes the variance to normal() as if it were the standard deviation."""

    def spreads(self, far, turn):
        return self.along * far, self.aside * far, self.turns * abs(turn) + self.bend * far


class NoisePerMessage(Cloud):
    """Adds the noise of a whole meter with each message, also while the robot stands."""

    def spreads(self, far, turn):
        return math.sqrt(self.along), math.sqrt(self.aside), math.sqrt(self.bend)


class AllAtOnePoint(Cloud):
    along = aside = bend = turns = 0.0

    def draw(self, pose, covariance):
        super().draw(pose, covariance * 0)


class ResamplesEachTime(Cloud):
    def is_poor(self, weights):
        return True


class NeverResamples(Cloud):
    def is_poor(self, weights):
        return False


class KeepsOldWeights(Cloud):
    """Draws by the weights, and counts them again."""

    def take(self, chosen):
        self.poses, self.logs = self.poses[chosen], self.logs[chosen]


class WeighsWhileStanding(Cloud):
    def has_moved(self):
        return True


class ProductUnderflows(Cloud):
    sigma = 0.002

    def weights(self):
        with np.errstate(invalid="ignore"):
            weights = np.exp(self.logs)
            return weights / weights.sum()

    def is_poor(self, weights):
        return bool(np.isfinite(weights).all()) and super().is_poor(weights)
