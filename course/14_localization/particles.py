"""A particle filter in numpy: hundreds of guesses about where the robot is. It needs no ROS."""

import math

import numpy as np

# How much the odometry may be off; each is a variance. In AMCL: alpha1 to alpha5.
ALONG, ASIDE = 0.01, 0.005  # m^2 for each m driven: forward, to the left
TURN, BEND = 0.02, 0.01  # rad^2 for each rad turned, for each m driven
SIGMA = 0.2  # m: how far from a wall a ray may end. In AMCL: sigma_hit
RANDOM = 0.2  # the share of rays that end anywhere. In AMCL: z_rand
TRUST = 0.3  # rays have errors in common: 30 of them count as 9. In AMCL: fewer max_beams


def distance_field(cells, resolution, most=0.5):
    """How far each cell is from the nearest occupied one (m), at most `most`."""
    field = np.full(cells.shape, most)
    rows, columns = np.nonzero(cells == 100)
    reach = math.ceil(most / resolution)
    for up in range(-reach, reach + 1):
        for right in range(-reach, reach + 1):
            row, column = rows + up, columns + right
            inside = (row >= 0) & (row < len(cells)) & (column >= 0) & (column < len(cells[0]))
            there = row[inside], column[inside]
            field[there] = np.minimum(field[there], math.hypot(up, right) * resolution)
    return field


def compose(a, b):
    """The pose b, given in the frame a, in the frame in which a is given."""
    cos, sin = math.cos(a[2]), math.sin(a[2])
    return a[0] + cos * b[0] - sin * b[1], a[1] + sin * b[0] + cos * b[1], a[2] + b[2]


def inverse(a):
    """The pose that undoes a: compose(a, inverse(a)) is 0."""
    cos, sin = math.cos(a[2]), math.sin(a[2])
    return -cos * a[0] - sin * a[1], sin * a[0] - cos * a[1], -a[2]


def wrapped(angle):
    """The same angle in -pi to pi."""
    return (angle + math.pi) % math.tau - math.pi


class ParticleFilter:
    """Guesses about where the robot is, with the logarithms of their weights."""

    def __init__(self, cells, resolution, origin, count, rng):
        self.field = distance_field(cells, resolution)
        self.free = np.argwhere(cells == 0)
        self.resolution, self.origin, self.count, self.rng = resolution, np.array(origin), count, rng
        self.poses, self.logs = self.anywhere(count), np.zeros(count)  # rows: x, y, yaw

    def anywhere(self, count):
        """Poses anywhere on the free part of the map."""
        cells = self.free[self.rng.integers(len(self.free), size=count)]
        places = self.origin + (cells[:, ::-1] + self.rng.random((count, 2))) * self.resolution
        return np.column_stack([places, self.rng.uniform(-math.pi, math.pi, count)])

    def start(self, pose, covariance):
        """Draw all particles around a pose; the covariance is of x, y and yaw."""
        self.poses = self.rng.multivariate_normal(pose, covariance, self.count)
        self.logs = np.zeros(self.count)

    def move(self, step):
        """Move each particle by a step in its own frame (forward, left, turn), with noise of its own."""
        forward, left, turn = step
        far, normal = math.hypot(forward, left), self.rng.normal(size=(3, self.count))
        forward = forward + math.sqrt(ALONG * far) * normal[0]
        left = left + math.sqrt(ASIDE * far) * normal[1]
        cos, sin = np.cos(self.poses[:, 2]), np.sin(self.poses[:, 2])
        self.poses[:, 0] += cos * forward - sin * left
        self.poses[:, 1] += sin * forward + cos * left
        self.poses[:, 2] += turn + math.sqrt(TURN * abs(turn) + BEND * far) * normal[2]

    def likelihood(self, points):
        """The logarithm of each ray's probability, for each particle; the points are in base_link."""
        x, y, yaw = self.poses.T[:, :, None]
        ends_x = x + np.cos(yaw) * points[:, 0] - np.sin(yaw) * points[:, 1]
        ends_y = y + np.sin(yaw) * points[:, 0] + np.cos(yaw) * points[:, 1]
        column = ((ends_x - self.origin[0]) // self.resolution).astype(int)
        row = ((ends_y - self.origin[1]) // self.resolution).astype(int)
        inside = (row >= 0) & (row < len(self.field)) & (column >= 0) & (column < len(self.field[0]))
        distance = np.where(inside, self.field[row * inside, column * inside], self.field.max())
        return np.log((1 - RANDOM) * np.exp(-(distance**2) / (2 * SIGMA**2)) + RANDOM)

    def weigh(self, points):
        """Multiply each weight by the probability of the scan: add logarithms."""
        self.logs += TRUST * self.likelihood(points).sum(axis=1)

    @property
    def weights(self):
        """The weights, with the sum 1."""
        weights = np.exp(self.logs - self.logs.max())
        return weights / weights.sum()

    def resample(self):
        """Draw new particles if fewer than half of them count: heavy ones several times, light ones never."""
        weights = self.weights
        if 1 / (weights**2).sum() > self.count / 2:
            return
        marks = (self.rng.random() + np.arange(self.count)) / self.count  # one random number for all
        chosen = np.searchsorted(np.cumsum(weights), marks).clip(max=self.count - 1)
        self.poses, self.logs = self.poses[chosen], np.zeros(self.count)

    def estimate(self):
        """The mean pose of the heaviest cluster, and the covariance of all particles around it."""
        weights = self.weights
        _, bins = np.unique(self.poses // 0.5, axis=0, return_inverse=True)
        heaviest = bins.ravel() == np.bincount(bins.ravel(), weights).argmax()
        x, y, yaw = self.mean(weights * heaviest)
        offsets = self.poses - (x, y, yaw)
        offsets[:, 2] = wrapped(offsets[:, 2])
        near = np.hypot(offsets[:, 0], offsets[:, 1]) + np.abs(offsets[:, 2]) < 1.0
        offsets = self.poses - self.mean(weights * near)
        offsets[:, 2] = wrapped(offsets[:, 2])
        return self.mean(weights * near), (offsets.T * weights) @ offsets

    def mean(self, weights):
        """The weighted mean of the poses; that of the headings is the direction of their mean arrow."""
        x, y = weights @ self.poses[:, :2] / weights.sum()
        return x, y, math.atan2(weights @ np.sin(self.poses[:, 2]), weights @ np.cos(self.poses[:, 2]))
