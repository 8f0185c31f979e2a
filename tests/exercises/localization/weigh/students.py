"""Nodes that weigh guesses: right ones, and wrong ones named after their defect."""

import math

import numpy as np
import rclpy
from geometry_msgs.msg import PoseArray
from nav2_msgs.msg import Particle, ParticleCloud
from nav_msgs.msg import OccupancyGrid
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage
from tf2_ros import Buffer, TransformListener

from tests.exercises.localization.poses import field_of, yaw_of

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Weigher(Node):
    """As in the solution; the others change one thing each."""

    every, sigma, random, power = 12, 0.1, 0.2, 1.0
    most = 0.5  # m

    def __init__(self):
        super().__init__("weigher")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.scan = None
        self.publisher = self.create_publisher(ParticleCloud, "/particle_cloud", 10)
        self.create_subscription(OccupancyGrid, "/map", self.on_map, LATCHED)
        self.create_subscription(LaserScan, "/scan", self.on_scan, qos_profile_sensor_data)
        self.create_subscription(PoseArray, "/candidates", self.on_candidates, 10)

    def on_map(self, msg):
        cells = np.array(msg.data, dtype=np.int8).reshape(msg.info.height, msg.info.width)
        self.resolution = msg.info.resolution
        self.origin = msg.info.origin.position.x, msg.info.origin.position.y
        self.field = field_of(cells, self.resolution, self.most)

    def on_scan(self, msg):
        self.scan = msg

    def on_candidates(self, msg):
        guesses = np.array([(one.position.x, one.position.y, yaw_of(one.orientation)) for one in msg.poses])
        weights = self.weights(guesses)
        particles = [
            Particle(pose=pose, weight=float(weight)) for pose, weight in zip(msg.poses, weights, strict=True)
        ]
        self.publisher.publish(ParticleCloud(header=msg.header, particles=particles))

    def mounting(self):
        found = self.buffer.lookup_transform("base_link", self.scan.header.frame_id, Time()).transform
        return found.translation.x, found.translation.y, yaw_of(found.rotation)

    def hits(self, ranges):
        return np.isfinite(ranges)

    def points(self):
        x, y, yaw = self.mounting()
        ranges = np.array(self.scan.ranges, dtype=float)
        angles = yaw + self.scan.angle_min + np.arange(len(ranges)) * self.scan.angle_increment
        some = self.hits(ranges) & (np.arange(len(ranges)) % self.every == 0)
        return np.column_stack(
            [x + ranges[some] * np.cos(angles[some]), y + ranges[some] * np.sin(angles[some])]
        )

    def ends(self, guesses, points):
        x, y, yaw = guesses.T[:, :, None]
        return (
            x + np.cos(yaw) * points[:, 0] - np.sin(yaw) * points[:, 1],
            y + np.sin(yaw) * points[:, 0] + np.cos(yaw) * points[:, 1],
        )

    def distances(self, x, y):
        column = ((x - self.origin[0]) // self.resolution).astype(int)
        row = ((y - self.origin[1]) // self.resolution).astype(int)
        inside = (row >= 0) & (row < len(self.field)) & (column >= 0) & (column < len(self.field[0]))
        return np.where(inside, self.field[row * inside, column * inside], self.field.max())

    def probabilities(self, guesses):
        distances = self.distances(*self.ends(guesses, self.points()))
        hit = np.exp(-(distances**2) / (2 * self.sigma**2))
        return (1 - self.random) * hit + self.random

    def weights(self, guesses):
        logs = self.power * np.log(self.probabilities(guesses)).sum(axis=1)
        weights = np.exp(logs - logs.max())
        return weights / weights.sum()


class AllRaysSquashed(Weigher):
    """All rays, and a power below 1 of their product."""

    every, power = 1, 0.1


class WideGaussian(Weigher):
    """60 rays, as many as AMCL uses, and its sigma."""

    every, sigma = 6, 0.2


class BeamByBeam(Weigher):
    """Plain Python, a guess and a ray at a time."""

    def weights(self, guesses):
        points, logs = self.points()[::2].tolist(), []
        for x, y, yaw in guesses.tolist():
            total, cos, sin = 0.0, math.cos(yaw), math.sin(yaw)
            for ahead, left in points:
                distance = self.distance(x + cos * ahead - sin * left, y + sin * ahead + cos * left)
                total += math.log(0.9 * math.exp(-((distance / 0.12) ** 2) / 2) + 0.1)
            logs.append(total)
        weights = [math.exp(one - max(logs)) for one in logs]
        return [weight / sum(weights) for weight in weights]

    def distance(self, x, y):
        column, row = (x - self.origin[0]) / self.resolution, (y - self.origin[1]) / self.resolution
        if not (0 <= row < len(self.field) and 0 <= column < len(self.field[0])):
            return 1.0
        return float(self.field[int(row), int(column)])


class MeanDistance(Weigher):
    """A design of its own: the mean distance of all ray ends decides, without any probability."""

    every = 1

    def weights(self, guesses):
        means = np.minimum(self.distances(*self.ends(guesses, self.points())), 0.3).mean(axis=1)
        weights = np.exp(-(means - means.min()) / 0.006)
        return weights / weights.sum()


class HeavyTail(Weigher):
    """A design of its own: a Cauchy distribution, whose tail needs no constant."""

    def probabilities(self, guesses):
        distances = self.distances(*self.ends(guesses, self.points()))
        return 1 / (1 + (distances / 0.1) ** 2)


class CountsHits(Weigher):
    """A design of its own: how many rays end near a wall."""

    every = 4

    def weights(self, guesses):
        near = (self.distances(*self.ends(guesses, self.points())) < 0.12).mean(axis=1)
        weights = np.exp(25.0 * (near - near.max()))
        return weights / weights.sum()


def main_with_static_frames():
    """A design of its own: /tf_static read by hand, and the newest scan's points made once for each scan."""
    rclpy.init()
    node = rclpy.create_node("weigher")
    tools, mounted = Weigher, {}

    class Plain(tools):
        def __init__(self):
            Node.__init__(self, "helper")

        def mounting(self):
            return mounted["base_scan"]

    helper = Plain()
    publisher = node.create_publisher(ParticleCloud, "particle_cloud", 10)

    def on_static(msg):
        for one in msg.transforms:
            move = one.transform
            mounted[one.child_frame_id] = move.translation.x, move.translation.y, yaw_of(move.rotation)

    helper.publisher = publisher
    node.create_subscription(TFMessage, "/tf_static", on_static, LATCHED)
    node.create_subscription(OccupancyGrid, "map", helper.on_map, LATCHED)
    node.create_subscription(LaserScan, "scan", helper.on_scan, qos_profile_sensor_data)
    node.create_subscription(PoseArray, "candidates", helper.on_candidates, 10)
    rclpy.spin(node)


# -- wrong ones --


class Silent(Weigher):
    def on_candidates(self, msg):
        pass


class AnswersOnce(Weigher):
    def on_candidates(self, msg):
        if not hasattr(self, "answered"):
            self.answered = True
            super().on_candidates(msg)


class AllEqual(Weigher):
    def weights(self, guesses):
        return np.full(len(guesses), 1 / len(guesses))


class DenseIsRight(Weigher):
    """Weighs a guess by how many others are near."""

    def weights(self, guesses):
        apart = np.hypot(*(guesses[:, None, :2] - guesses[None, :, :2]).transpose(2, 0, 1))
        near = (apart < 0.1).sum(axis=1).astype(float)
        return near / near.sum()


class ProductUnderflows(Weigher):
    """Multiplies the probabilities of all rays, each for one of a hundred distances."""

    every = 1

    def weights(self, guesses):
        product = np.prod(0.01 * self.probabilities(guesses), axis=1)
        return product / product.sum()


class NotNormalized(Weigher):
    def weights(self, guesses):
        return np.exp(np.log(self.probabilities(guesses)).sum(axis=1))


class RaysAreIndependent(Weigher):
    every = 1


class TooSure(Weigher):
    sigma, random = 0.02, 0.01


class IgnoresTheMounting(Weigher):
    def mounting(self):
        return 0.0, 0.0, 0.0


class OnlyThePlace(Weigher):
    """Uses where the lidar is, but not how it is turned."""

    def mounting(self):
        x, y, _ = super().mounting()
        return x, y, 0.0


class KeepsNan(Weigher):
    def hits(self, ranges):
        return ~np.isinf(ranges)

    def distances(self, x, y):
        with np.errstate(invalid="ignore"):
            known = super().distances(np.nan_to_num(x), np.nan_to_num(y))
        return np.where(np.isnan(x), np.nan, known)


class NoRandomRays(Weigher):
    """No ray may miss: a wall must be near each end, and the field reaches far."""

    every, random, most, sigma = 1, 0.0, 3.0, 0.02

    def probabilities(self, guesses):
        distances = self.distances(*self.ends(guesses, self.points()))
        return np.where(distances < 0.15, 1.0, 0.0) + 0.0

    def weights(self, guesses):
        product = self.probabilities(guesses).prod(axis=1)
        with np.errstate(invalid="ignore"):
            return product / product.sum()


class RowsAndColumnsSwapped(Weigher):
    def distances(self, x, y):
        column = ((x - self.origin[0]) // self.resolution).astype(int)
        row = ((y - self.origin[1]) // self.resolution).astype(int)
        high, wide = self.field.shape
        return self.field[np.clip(column, 0, high - 1), np.clip(row, 0, wide - 1)]


class NormalizesAlongTheWrongAxis(Weigher):
    """Normalizes each ray over all guesses, so that no ray tells more than another."""

    def weights(self, guesses):
        each = self.probabilities(guesses)
        each = each / each.sum(axis=1, keepdims=True)
        logs = np.log(each).sum(axis=1)
        weights = np.exp(logs - logs.max())
        return weights / weights.sum()


class TurnsTheWrongWay(Weigher):
    def ends(self, guesses, points):
        return super().ends(guesses * (1.0, 1.0, -1.0), points)


class OnlyTheBest(Weigher):
    """Publishes the poses that count, the heaviest first."""

    def on_candidates(self, msg):
        guesses = np.array([(one.position.x, one.position.y, yaw_of(one.orientation)) for one in msg.poses])
        weights = self.weights(guesses)
        order = np.argsort(-weights)[:50]
        share = weights[order] / weights[order].sum()
        pairs = zip([msg.poses[int(one)] for one in order], share, strict=True)
        particles = [Particle(pose=pose, weight=float(weight)) for pose, weight in pairs]
        self.publisher.publish(ParticleCloud(header=msg.header, particles=particles))


class Sorted(Weigher):
    def on_candidates(self, msg):
        guesses = np.array([(one.position.x, one.position.y, yaw_of(one.orientation)) for one in msg.poses])
        weights = self.weights(guesses)
        order = np.argsort(-weights)
        pairs = zip([msg.poses[int(one)] for one in order], weights[order], strict=True)
        particles = [Particle(pose=pose, weight=float(weight)) for pose, weight in pairs]
        self.publisher.publish(ParticleCloud(header=msg.header, particles=particles))


class AnglesByHand(Weigher):
    """Takes the number of a ray for its angle in degrees, as if angles were degrees."""

    def points(self):
        ranges = np.array(self.scan.ranges, dtype=float)
        some = np.isfinite(ranges)
        angles = np.arange(len(ranges))[some]
        return np.column_stack([ranges[some] * np.cos(angles), ranges[some] * np.sin(angles)])[::12]
