"""Localizations that notice when the robot is carried away: right ones, and wrong ones named after their defect."""

import math

import numpy as np
from geometry_msgs.msg import PoseArray
from nav2_msgs.msg import Particle, ParticleCloud
from nav_msgs.msg import OccupancyGrid, Odometry
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Bool

from tests.exercises.localization.poses import field_of, pose_of, step, yaw_of

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Kidnapped(Node):
    """Random particles, as many as the fit has fallen; the others change one thing each."""

    count, rays, shown = 3000, 20, 500
    sigma, spread, frame = 0.25, 0.1, "map"

    def __init__(self):
        super().__init__("kidnapped")
        self.rng = np.random.default_rng(1)
        self.field = self.poses = self.odometry = self.before = self.weighed_at = self.places = None
        self.scans, self.slow, self.fast, self.one = 0, 0.95, 0.95, False
        self.clouds = self.create_publisher(ParticleCloud, "/particle_cloud", 10)
        self.flags = self.create_publisher(Bool, "/localized", 10)
        self.create_subscription(OccupancyGrid, "/map", self.on_map, LATCHED)
        self.create_subscription(PoseArray, "/parking_poses", self.on_parking, LATCHED)
        self.create_subscription(Odometry, "/odom", self.on_odom, 10)
        self.create_subscription(LaserScan, "/scan", self.on_scan, qos_profile_sensor_data)

    def on_map(self, msg):
        cells = np.array(msg.data, dtype=np.int8).reshape(msg.info.height, msg.info.width)
        self.resolution = msg.info.resolution
        self.origin = np.array([msg.info.origin.position.x, msg.info.origin.position.y])
        self.free, self.field = np.argwhere(cells == 0), field_of(cells, self.resolution)

    def on_parking(self, msg):
        self.places = [(one.position.x, one.position.y, yaw_of(one.orientation)) for one in msg.poses]
        self.begin(self.around(self.places))

    def around(self, places):
        return np.concatenate([self.rng.normal(one, self.spread, (self.count // 2, 3)) for one in places])

    def begin(self, poses):
        self.poses, self.logs = poses, np.zeros(len(poses))

    def on_odom(self, msg):
        position = msg.pose.pose.position
        self.odometry = position.x, position.y, yaw_of(msg.pose.pose.orientation)
        self.before = self.before or self.odometry

    def on_scan(self, msg):
        if self.field is None or self.poses is None or self.odometry is None:
            return
        self.move(*step(self.before, self.odometry))
        self.before = self.odometry
        if self.has_moved():
            self.weighed_at = self.odometry
            self.seen = self.points(msg)
            self.update(self.seen)
        self.scans += 1
        if self.scans % 20 == 1:
            self.publish(msg.header.stamp)
        self.flag()

    def has_moved(self):
        if self.weighed_at is None:
            return True
        forward, left, turn = step(self.weighed_at, self.odometry)
        return math.hypot(forward, left) > 0.1 or abs(turn) > 0.1

    def points(self, scan):
        ranges, number = np.array(scan.ranges), np.arange(len(scan.ranges))
        hit = np.isfinite(ranges) & (number % (len(ranges) // self.rays) == 0)
        angles = scan.angle_min + number[hit] * scan.angle_increment
        return np.column_stack([ranges[hit] * np.cos(angles), ranges[hit] * np.sin(angles)])

    def anywhere(self, count):
        cells = self.free[self.rng.integers(len(self.free), size=count)]
        places = self.origin + (cells[:, ::-1] + self.rng.random((count, 2))) * self.resolution
        return np.column_stack([places, self.rng.uniform(-math.pi, math.pi, count)])

    def move(self, forward, left, turn):
        far, noise = math.hypot(forward, left), self.rng.normal(size=(3, len(self.poses)))
        forward = forward + math.sqrt(0.01 * far) * noise[0]
        left = left + math.sqrt(0.002 * far) * noise[1]
        cos, sin = np.cos(self.poses[:, 2]), np.sin(self.poses[:, 2])
        self.poses[:, 0] += cos * forward - sin * left
        self.poses[:, 1] += sin * forward + cos * left
        self.poses[:, 2] += turn + math.sqrt(0.01 * abs(turn) + 0.005 * far) * noise[2]

    def likelihood(self, poses, points):
        x, y, yaw = poses.T[:, :, None]
        ends_x = x + np.cos(yaw) * points[:, 0] - np.sin(yaw) * points[:, 1]
        ends_y = y + np.sin(yaw) * points[:, 0] + np.cos(yaw) * points[:, 1]
        column = ((ends_x - self.origin[0]) // self.resolution).astype(int)
        row = ((ends_y - self.origin[1]) // self.resolution).astype(int)
        inside = (row >= 0) & (row < len(self.field)) & (column >= 0) & (column < len(self.field[0]))
        gaps = np.where(inside, self.field[row * inside, column * inside], self.field.max())
        return 0.8 * np.exp(-(gaps**2) / (2 * self.sigma**2)) + 0.2

    def weights(self):
        weights = np.exp(self.logs - self.logs.max())
        return weights / weights.sum()

    def weigh(self, points):
        """Weighs the particles; sets the recent fit, and whether one place has nearly all the weight."""
        probabilities = self.likelihood(self.poses, points)
        self.logs += 0.3 * np.log(probabilities).sum(axis=1)
        weights = self.weights()
        fit = float(weights @ probabilities.mean(axis=1))
        self.slow += 0.002 * (fit - self.slow)
        self.fast += 0.3 * (fit - self.fast)
        off = self.poses - self.poses[weights.argmax()]
        near = (np.hypot(off[:, 0], off[:, 1]) < 0.5) & (np.cos(off[:, 2]) > 0.8)
        self.one = weights[near].sum() > 0.9

    def update(self, points):
        self.weigh(points)
        self.resample()
        lost = self.rng.random(len(self.poses)) < self.random_share()
        self.poses[lost] = self.guesses(lost.sum())

    def guesses(self, count):
        """Poses anywhere, most of them where the newest scan fits."""
        poses = self.anywhere(3000)
        fits = np.exp(0.3 * np.log(self.likelihood(poses, self.seen)).sum(axis=1))
        return poses[self.rng.choice(len(poses), count, p=fits / fits.sum())]

    def random_share(self):
        return 1 - self.fast / self.slow

    def resample(self):
        weights = self.weights()
        if len(weights) == self.count and 1 / (weights @ weights) > self.count / 2:
            return
        marks = (self.rng.random() + np.arange(self.count)) / self.count
        chosen = np.searchsorted(np.cumsum(weights), marks).clip(max=len(weights) - 1)
        self.begin(self.poses[chosen])

    def is_localized(self):
        return bool(self.one and self.fast > 0.8)

    def some(self):
        """What is published: poses and weights."""
        chosen = self.rng.choice(len(self.poses), self.shown, p=self.weights())
        return self.poses[chosen], np.full(self.shown, 1 / self.shown)

    def publish(self, stamp):
        cloud = ParticleCloud()
        cloud.header.frame_id, cloud.header.stamp = self.frame, stamp
        cloud.particles = [
            Particle(pose=pose_of(*pose), weight=float(weight)) for pose, weight in zip(*self.some(), strict=True)
        ]
        self.clouds.publish(cloud)

    def flag(self):
        self.flags.publish(Bool(data=self.is_localized()))


class FixedShare(Kidnapped):
    """A design of its own: with each scan, a twentieth of the particles are anywhere."""

    def random_share(self):
        return 0.05

    def guesses(self, count):
        return self.anywhere(count)


class SensorResetting(Kidnapped):
    """A design of its own: how many are random depends on the fit itself, not on its average."""

    def random_share(self):
        return 1 - self.fast / 0.92


class Replaces(Kidnapped):
    """A design of its own: 8000 particles all over the map replace the cloud once scans no longer fit."""

    count, many, patience = 2000, 8000, 20

    def update(self, points):
        self.weigh(points)
        self.patience -= 1
        if self.fast < 0.85 and self.patience < 0:
            self.patience = type(self).patience
            self.begin(self.all_over())
        else:
            self.resample()

    def all_over(self):
        return self.anywhere(self.many)


class BeginsAgain(Replaces):
    """A design of its own: begins again at places and their twins, which the two parking places tell."""

    count, many = 2500, 4000

    def all_over(self):
        poses = super().all_over()
        middle = np.mean(self.places, axis=0)[:2]
        return np.concatenate([poses, np.column_stack([2 * middle - poses[:, :2], poses[:, 2] + math.pi])])


class WholeCloud(Replaces):
    """A design of its own: always 4000 particles; some of them are published, with their own weights."""

    count = many = 4000

    def some(self):
        weights = self.weights()[:: self.count // self.shown]
        return self.poses[:: self.count // self.shown], weights / weights.sum()


class Hypotheses(Kidnapped):
    """A design of its own: a few hypotheses, each matched with each scan, and a search if none of them fits."""

    each = 40

    def begin(self, poses):
        self.poses, self.logs = np.array(poses), np.zeros(len(poses))

    def around(self, places):
        return places

    def move(self, forward, left, turn):
        cos, sin = np.cos(self.poses[:, 2]), np.sin(self.poses[:, 2])
        self.poses += np.column_stack([cos * forward - sin * left, sin * forward + cos * left, cos * 0 + turn])

    def matched(self, pose, points):
        guesses = self.rng.normal(pose, 0.05, (40, 3))
        probabilities = self.likelihood(guesses, points)
        logs = np.log(probabilities).sum(axis=1)
        weights = np.exp(logs - logs.max())
        return weights @ guesses / weights.sum(), weights @ probabilities.mean(axis=1) / weights.sum()

    def update(self, points):
        found = [self.matched(pose, points) for pose in self.poses]
        self.poses, fits = np.array([pose for pose, _ in found]), np.array([fit for _, fit in found])
        self.logs += 12 * np.log(fits)
        weights = self.weights()
        self.fast += 0.2 * (float(weights @ fits) - self.fast)
        kept = weights > 1e-4
        self.poses, self.logs = self.poses[kept], self.logs[kept]
        self.one = weights.max() > 0.8
        if self.fast < 0.85:
            self.search(points)

    def search(self, points):
        poses = self.anywhere(4000)
        best = poses[np.argsort(-self.likelihood(poses, points).mean(axis=1))[:60]]
        for _ in range(3):
            best = np.array([self.matched(pose, points)[0] for pose in best])
        fits, kept = self.likelihood(best, points).mean(axis=1), []
        for pose in best[np.argsort(-fits)][: (fits > fits.max() - 0.08).sum()]:
            if all(math.dist(pose[:2], one[:2]) > 0.3 or math.cos(pose[2] - one[2]) < 0.9 for one in kept):
                kept.append(pose)
        self.begin(kept)
        self.fast = 0.95

    def some(self):
        poses = np.concatenate([self.rng.normal(pose, 0.06, (self.each, 3)) for pose in self.poses])
        return poses, np.repeat(self.weights() / self.each, self.each)


# -- wrong ones --


class Few(Kidnapped):
    """Fewer particles find it, too."""

    count, rays = 2000, 18


class EverywhereForever(Few):
    """Publishes a cloud that is all over the map, always."""

    def on_parking(self, msg):
        self.begin(np.zeros((1, 3)))

    def update(self, points):
        self.poses = self.anywhere(1000)
        self.logs = np.zeros(1000)


class WideForever(Few):
    """Its particles have a spread of 10 m."""

    def some(self):
        return self.rng.normal(self.poses[:500], (10.0, 10.0, 3.0)), np.full(500, 1 / 500)


class PicksOne(Few):
    """Begins at the first of the two places."""

    def around(self, places):
        return super().around(places[:1])


class PublishesTheMean(Few):
    """One particle: the mean of all."""

    def some(self):
        x, y = self.poses[:, :2].mean(axis=0)
        yaw = math.atan2(np.sin(self.poses[:, 2]).mean(), np.cos(self.poses[:, 2]).mean())
        return np.array([(x, y, yaw)]), np.ones(1)



class OdometryOnly(Few):
    """Never looks at a scan."""

    def update(self, points):
        pass


class NeverNotices(Few):
    """No random particles."""

    def random_share(self):
        return 0.0



class AlwaysSure(Few):
    def is_localized(self):
        return True


class NeverSure(Few):
    def is_localized(self):
        return False



class SureForEver(Few):
    """Once it knows, it always says so."""

    sure = False

    def is_localized(self):
        self.sure = self.sure or super().is_localized()
        return self.sure


class NoticesTooLate(Few):
    """Adds random particles only once hardly any ray fits."""

    def random_share(self):
        return 1 - self.fast / 0.92 if self.fast < 0.2 else 0.0


class NoParticles(Few):
    def some(self):
        return np.zeros((0, 3)), np.zeros(0)


class NotNormalized(Few):
    def some(self):
        poses, weights = super().some()
        return poses, weights * len(weights)


class NotANumber(Few):
    """0 / 0: multiplies probabilities of 1e-20."""

    def some(self):
        poses, weights = super().some()
        return poses, weights * math.nan


class WithoutWeights(Few):
    def some(self):
        poses, weights = super().some()
        return poses, weights * 0.0


class WrongFrame(Few):
    frame = "odom"


class OnlyOnce(Few):
    """Publishes one cloud, the first one."""

    def publish(self, stamp):
        if self.scans == 1:
            super().publish(stamp)


class Silent(Few):
    def publish(self, stamp):
        pass


class NoFlag(Few):
    def flag(self):
        pass


class FlagOnce(Few):
    """Publishes clouds, but says only at first whether it knows."""

    def flag(self):
        if self.scans == 1:
            super().flag()


class BothForever(Few):
    """Two clusters on whatever it knows: half of the particles are at the twin."""

    def some(self):
        poses, weights = super().some()
        middle = np.mean(self.places, axis=0)[:2]
        twins = np.column_stack([2 * middle - poses[:, :2], poses[:, 2] + math.pi])
        return np.concatenate([poses, twins]), np.concatenate([weights, weights]) / 2
