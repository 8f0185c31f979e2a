"""Fused yaws: right ones, and wrong ones named after their defect."""

import bisect
import math

import numpy as np
import rclpy
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.time import Time
from sensor_msgs.msg import Imu
from std_msgs.msg import Empty


class Fusion(Node):
    """The textbook's: yaw, bias and the wheels' drift; measurements in the order of their stamps."""

    topic, lag, unknown, bias_spread = "/odometry/filtered", 0.55, 1.0, 0.03

    def __init__(self):
        super().__init__("fusion")
        self.reset()
        self.publisher = self.create_publisher(Odometry, self.topic, 10)
        self.create_subscription(Empty, "/reset_odometry", lambda msg: self.reset(), 10)
        self.create_subscription(Odometry, "/odom", self.on_odom, 10)
        self.create_subscription(Imu, "/imu/data", self.on_imu, 10)

    def reset(self):
        self.x = np.zeros(3)
        self.P = np.diag([0.0, self.bias_spread**2, 0.0])
        self.stamp = self.spread = None
        self.waiting = []

    def stamp_of(self, msg):
        return Time.from_msg(msg.header.stamp).nanoseconds

    def on_imu(self, msg):
        self.add(self.stamp_of(msg), 0, msg.angular_velocity.z, msg.angular_velocity_covariance[8])

    def on_odom(self, msg):
        turn = msg.pose.pose.orientation
        self.add(self.stamp_of(msg), 1, 2 * math.atan2(turn.z, turn.w), msg.pose.covariance[35])

    def add(self, *measurement):
        bisect.insort(self.waiting, measurement)
        while self.waiting[0][0] <= self.waiting[-1][0] - self.lag * 1e9:
            self.process(*self.waiting.pop(0))

    def process(self, stamp, kind, value, variance):
        dt = 0.0 if self.stamp is None else (stamp - self.stamp) / 1e9
        self.stamp = stamp
        if kind == 0:
            self.predict(value, variance, dt)
        else:
            if dt > 0:
                self.predict_blindly(dt)
            self.correct(value, variance)
        self.publish(stamp)

    def predict(self, rate, variance, dt):
        if dt > 0.15:
            self.predict_blindly(dt)
            return
        F = np.eye(3)
        F[0, 1] = -dt
        self.x[0] += (rate - self.x[1]) * dt
        self.P = F @ self.P @ F.T
        self.P[0, 0] += variance * dt**2

    def predict_blindly(self, dt):
        self.P[0, 0] += (self.unknown * dt) ** 2

    def correct(self, yaw, spread):
        if self.spread is not None:
            self.P[2, 2] += spread - self.spread
        self.spread = spread
        self.update(self.innovation(yaw), np.array([1.0, 0.0, 1.0]), 1e-8)

    def innovation(self, yaw):
        return math.remainder(yaw - self.x[0] - self.x[2], math.tau)

    def update(self, innovation, H, R):
        K = self.P @ H / (H @ self.P @ H + R)
        self.x = self.x + K * innovation
        self.P = self.P - np.outer(K, H @ self.P)

    def publish(self, stamp):
        odom = Odometry(child_frame_id="base_link")
        odom.header.frame_id, odom.header.stamp = "odom", Time(nanoseconds=stamp).to_msg()
        yaw = self.yaw()
        odom.pose.pose.orientation.z, odom.pose.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        odom.pose.covariance[35] = float(self.variance())
        self.publisher.publish(odom)

    def yaw(self):
        return float(self.x[0])

    def variance(self):
        return self.P[0, 0]


class Joseph(Fusion):
    """The form of the update that stays symmetric."""

    def update(self, innovation, H, R):
        K = self.P @ H / (H @ self.P @ H + R)
        A = np.eye(3) - np.outer(K, H)
        self.x = self.x + K * innovation
        self.P = A @ self.P @ A.T + R * np.outer(K, K)


class ByTheRate(Fusion):
    """Takes the wheels' turn since their last message, against the gyro's, in a state with the old yaw."""

    def reset(self):
        super().reset()
        self.before = None

    def correct(self, yaw, spread):
        if self.before is not None:
            turned = math.remainder(yaw - self.before[0], math.tau)
            innovation = math.remainder(turned - (self.x[0] - self.x[2]), math.tau)
            self.update(innovation, np.array([1.0, 0.0, -1.0]), spread - self.before[1] + 1e-8)
        copy = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]])
        self.x, self.P = copy @ self.x, copy @ self.P @ copy.T
        self.before = yaw, spread


class LastReading(Fusion):
    """As in the lesson: the gyro's last reading holds for 0.15 s, whichever sensor speaks next."""

    def reset(self):
        super().reset()
        self.rate, self.rated = 0.0, -math.inf

    def process(self, stamp, kind, value, variance):
        dt = 0.0 if self.stamp is None else (stamp - self.stamp) / 1e9
        self.stamp = stamp
        if kind == 0:
            self.rate, self.rated = value, stamp
        if stamp - self.rated < 0.15e9:
            self.predict(self.rate, 0.015**2, dt)
        else:
            self.predict_blindly(dt)
        if kind == 1:
            self.correct(value, variance)
        self.publish(stamp)


class FourStates(Fusion):
    """The yaw rate is a state, too, as in robot_localization; it may change by 2 rad/s in a second."""

    def reset(self):
        super().reset()
        self.x = np.zeros(4)  # yaw, bias, drift, rate
        self.P = np.diag([0.0, self.bias_spread**2, 0.0, 1.0])
        self.gyro = None

    def predict(self, rate, variance, dt):
        H = np.array([0.0, 1.0, 0.0, 1.0])
        if dt:
            self.P[3, 3] += 4.0
            self.x[3] = 0.0
            self.P[3, :3] = self.P[:3, 3] = 0.0
        self.update(rate - H @ self.x, H, variance)
        self.move(dt)

    def predict_blindly(self, dt):
        self.x[3] = 0.0
        self.P[3] = self.P[:, 3] = 0.0
        self.P[3, 3] = 1.0
        self.move(dt)

    def move(self, dt):
        F = np.eye(4)
        F[0, 3] = dt
        self.x, self.P = F @ self.x, F @ self.P @ F.T

    def correct(self, yaw, spread):
        if self.spread is not None:
            self.P[2, 2] += spread - self.spread
        self.spread = spread
        self.update(self.innovation(yaw), np.array([1.0, 0.0, 1.0, 0.0]), 1e-8)


class Information(Fusion):
    """A design of its own: the inverse of the covariance, in which a measurement is an addition."""

    def update(self, innovation, H, R):
        Y = np.linalg.inv(self.P + 1e-12 * np.eye(3)) + np.outer(H, H) / R
        self.P = np.linalg.inv(Y)
        self.x = self.x + self.P @ H * innovation / R


class Hypotheses(Fusion):
    """A design of its own: 121 possible biases, each with its own yaw, weighed by how well the wheels fit."""

    def reset(self):
        super().reset()
        self.biases = np.linspace(-0.07, 0.07, 141)
        self.yaws, self.V = np.zeros(141), np.zeros(141)
        self.logs = -(self.biases**2) / 2 / self.bias_spread**2
        self.D, self.C, self.drifts = np.zeros(141), np.zeros(141), np.zeros(141)

    def predict(self, rate, variance, dt):
        if dt > 0.15:
            return self.predict_blindly(dt)
        self.yaws = self.yaws + (rate - self.biases) * dt
        self.V = self.V + variance * dt**2
        return None

    def predict_blindly(self, dt):
        self.V = self.V + (self.unknown * dt) ** 2

    def correct(self, yaw, spread):
        if self.spread is not None:
            self.D = self.D + spread - self.spread
        self.spread = spread
        off = yaw - self.yaws - self.drifts
        off = off - math.tau * np.round(off / math.tau)
        S = self.V + self.D + 2 * self.C + 1e-8
        self.logs = self.logs - off**2 / S / 2 - np.log(S) / 2
        a, b = (self.V + self.C) / S, (self.D + self.C) / S
        self.yaws, self.drifts = self.yaws + a * off, self.drifts + b * off
        V, D, C = self.V - a * a * S, self.D - b * b * S, self.C - a * b * S
        self.V, self.D, self.C = V, D, C

    def weights(self):
        weights = np.exp(self.logs - self.logs.max())
        return weights / weights.sum()

    def yaw(self):
        return float(self.weights() @ self.yaws)

    def variance(self):
        return self.weights() @ (self.V + (self.yaws - self.yaw()) ** 2) + 1e-9


class LeastSquares(Fusion):
    """A design of its own: all measurements of a drive in one system of equations, solved each time anew."""

    def reset(self):
        super().reset()
        self.steps, self.marks, self.turned, self.noise, self.time = [], [], 0.0, 0.0, 0.0
        self.fit = 0.0, 1e-9

    def predict(self, rate, variance, dt):
        if dt > 0.15:
            return self.predict_blindly(dt)
        self.turned, self.noise, self.time = self.turned + rate * dt, self.noise + variance * dt**2, self.time + dt
        return None

    def predict_blindly(self, dt):
        self.noise += (self.unknown * dt) ** 2

    def correct(self, yaw, spread):
        self.marks.append((yaw, spread, self.turned, self.noise, self.time))

    def variance(self):
        """Unknown are the bias and the yaw between two messages of the wheels: steps of two measurements."""
        bias, weight, parts = 0.0, 1.0 / self.bias_spread**2, []
        for before, after in zip(self.marks, self.marks[1:], strict=False):
            yaw, spread, turned, noise, time = (b - a for a, b in zip(before, after, strict=True))
            wheel, gyro, time = math.remainder(yaw, math.tau), turned, time
            w, g = spread + 1e-8, noise + 1e-12
            parts.append((wheel, gyro, w, g, time))
            weight += time**2 / (w + g)
            bias += time * (gyro - wheel) / (w + g)
        bias /= weight
        total, variance, lever = 0.0, 0.0, 0.0
        for wheel, gyro, w, g, time in parts:
            share = w / (w + g)  # of the gyro
            total += share * (gyro - bias * time) + (1 - share) * wheel
            variance += w * g / (w + g)
            lever += share * time
        last = self.marks[-1][2:] if self.marks else (0.0, 0.0, 0.0)
        total += self.turned - last[0] - bias * (self.time - last[2])
        variance += self.noise - last[1]
        lever += self.time - last[2]
        self.fit = total, variance + lever**2 / weight
        return self.fit[1] + 1e-9

    def yaw(self):
        self.variance()
        return self.fit[0]


def main():
    """A program of plain numbers: the bias by its own small filter, the yaw by steps."""
    rclpy.init()
    node = rclpy.create_node("fusion")
    pub = node.create_publisher(Odometry, "odometry/filtered", 10)
    fusion = LeastSquares.__new__(LeastSquares)
    LeastSquares.reset(fusion)

    def send(stamp):
        odom = Odometry(child_frame_id="base_link")
        odom.header.frame_id, odom.header.stamp = "odom", Time(nanoseconds=stamp).to_msg()
        variance = fusion.variance()
        half = fusion.fit[0] / 2
        odom.pose.pose.orientation.z, odom.pose.pose.orientation.w = math.sin(half), math.cos(half)
        odom.pose.covariance[35] = variance
        pub.publish(odom)

    fusion.publish = send
    node.create_subscription(Empty, "reset_odometry", lambda msg: fusion.reset(), 10)
    node.create_subscription(Odometry, "odom", fusion.on_odom, 10)
    node.create_subscription(Imu, "imu/data", fusion.on_imu, 10)
    rclpy.spin(node)


class NoBias(Fusion):
    """Takes the gyro at its word."""

    bias_spread = 0.0


class BiasOfTheFirstSecond(Fusion):
    """Measures the bias before it drives off, and some robots drive already."""

    def reset(self):
        super().reset()
        self.rates = []
        self.P[1, 1] = 0.0

    def predict(self, rate, variance, dt):
        if len(self.rates) < 10:
            self.rates.append(rate)
            self.x[1] = np.mean(self.rates)
            return
        super().predict(rate, variance + 2e-5, dt)


class TimeOfArrival(Fusion):
    """Takes the time at which a message arrives for the time of its measurement."""

    def stamp_of(self, msg):
        return self.get_clock().now().nanoseconds


class InTheOrderOfArrival(Fusion):
    """Processes each message at once, whatever has been processed before it."""

    lag = 0.0

    def add(self, *measurement):
        self.process(*measurement)


class DropsWhatIsLate(Fusion):
    """Leaves out what is older than the newest: of the wheels next to nothing remains."""

    def add(self, *measurement):
        if self.stamp is None or measurement[0] >= self.stamp:
            self.process(*measurement)


class NotWrapped(Fusion):
    def innovation(self, yaw):
        return yaw - self.x[0] - self.x[2]


class ThroughTheGap(Fusion):
    """As if the gyro's last rate held through its gap, and as if the wheels couldn't speak in it."""

    def predict(self, rate, variance, dt):
        super().predict(rate, variance, min(dt, 0.1))

    def predict_blindly(self, dt):
        pass


class WaitsForBoth(Fusion):
    """Publishes only with the wheels."""

    def process(self, stamp, kind, value, variance):
        self.is_wheels = kind == 1
        super().process(stamp, kind, value, variance)

    def publish(self, stamp):
        if self.is_wheels:
            super().publish(stamp)


class Zero(Fusion):
    def variance(self):
        return 0.0


class Huge(Fusion):
    def variance(self):
        return 100.0


class Tiny(Fusion):
    """A thousandth of a rad, always."""

    def variance(self):
        return 1e-6


class Degrees(Fusion):
    def variance(self):
        return self.P[0, 0] * math.degrees(1.0) ** 2


class TheSameForever(Fusion):
    """The variance that the wheels alone have at the end."""

    def variance(self):
        return 0.022


class RoundsTheYaw(Fusion):
    """To whole steps of 17 degrees, honestly: the variance of the rounding is in it."""

    step = math.radians(17.0)

    def yaw(self):
        return self.step * round(self.x[0] / self.step)

    def variance(self):
        return self.P[0, 0] + self.step**2 / 12


class StandardDeviation(Fusion):
    def variance(self):
        return math.sqrt(self.P[0, 0])


class NoNoise(Fusion):
    """Forgets that the bias isn't known at first, and adds the gyro's noise only."""

    def variance(self):
        return self.P[0, 0] * 0.1


class CountsTheWheelsTwice(Fusion):
    """Takes the whole variance of the wheels' yaw as new slip, and their yaw for the robot's: no drift."""

    def correct(self, yaw, spread):
        self.update(math.remainder(yaw - self.x[0], math.tau), np.array([1.0, 0.0, 0.0]), spread)


class DividesByZero(Fusion):
    """Two messages with one stamp: the rate between them is no number."""

    def correct(self, yaw, spread):
        rate = np.float64(self.innovation(yaw)) / np.float64(0.0)
        self.x[0] += 0.0 * rate


class StampOfNow(Fusion):
    def publish(self, stamp):
        super().publish(self.get_clock().now().nanoseconds + 3 * 10**9)


class AnotherTopic(Fusion):
    topic = "/odom_filtered"


class TunedConstant(Fusion):
    """A variance that is right on average, whatever has happened in a drive."""

    def variance(self):
        return 0.004
