"""Robots that stop in front of a wall on a slope: right ones, and wrong ones named by their defect."""

import math

import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Float64


class Stopper(Node):
    """As one would write it; the wrong ones change one thing each."""

    weight, p, i = 0.2, 0.6, 0.15
    limit, period = 0.3, 0.05
    first = None  # a distance to begin with

    def __init__(self):
        super().__init__("stopper")
        self.distance, self.sum = self.first, 0.0
        self.distances = self.create_publisher(Float64, "/distance", 10)
        self.speeds = self.create_publisher(Float64, "/speed", 10)
        self.create_subscription(LaserScan, "/scan", self.on_message, qos_profile_sensor_data)

    def on_message(self, scan):
        self.filter(scan.ranges[0])
        self.distances.publish(Float64(data=self.distance))
        self.speeds.publish(Float64(data=self.speed(self.distance - 0.6)))

    def filter(self, new):
        if self.distance is None:
            self.distance = new
        self.distance += self.weight * (new - self.distance)

    def speed(self, error):
        command = self.p * error + self.i * self.sum
        if abs(command) < self.limit:
            self.sum += error * self.period
        return max(-self.limit, min(self.limit, command))


class CutsTheSum(Stopper):
    """Anti wind-up in the other usual way: the sum has limits."""

    p, i = 0.7, 0.2

    def speed(self, error):
        self.sum = max(-0.6, min(0.6, self.sum + error * self.period))
        return max(-self.limit, min(self.limit, self.p * error + self.i * self.sum))


class BackCalculates(Stopper):
    """A design of its own: what is cut away is taken from the sum."""

    def speed(self, error):
        self.sum += error * self.period
        command = self.p * error + self.i * self.sum
        cut = max(-self.limit, min(self.limit, command))
        self.sum += (cut - command) / self.i * 0.2
        return cut


def main_without_a_class():
    rclpy.init()
    node, seen, sums = rclpy.create_node("stopper"), [], [0.0]
    distances = node.create_publisher(Float64, "/distance", 10)
    speeds = node.create_publisher(Float64, "/speed", 10)

    def on_message(scan):
        seen.append(0.8 * (seen or scan.ranges)[-1 if seen else 0] + 0.2 * scan.ranges[0])
        error = seen[-1] - 0.6
        if abs(error) < 0.4:
            sums.append(sums[-1] + 0.05 * error)
        distances.publish(Float64(data=seen[-1]))
        speeds.publish(Float64(data=max(-0.3, min(0.3, 0.6 * error + 0.15 * sums[-1]))))

    node.create_subscription(LaserScan, "/scan", on_message, qos_profile_sensor_data)
    rclpy.spin(node)


class WindsUp(Stopper):
    def speed(self, error):
        self.sum += error * self.period
        return max(-self.limit, min(self.limit, self.p * error + self.i * self.sum))


class POnly(Stopper):
    i = 0.0


class NoLimit(Stopper):
    """Leaves it to the motors to cut the speed."""

    def speed(self, error):
        super().speed(error)
        return self.p * error + self.i * self.sum


class NoLimitAtAll(Stopper):
    limit = math.inf


class TooShy(Stopper):
    """Stands where the slope pulls as hard as it."""

    p, i = 0.1, 0.0


class WeightsSwapped(Stopper):
    weight = 0.8


class NoFilter(Stopper):
    weight = 1.0


class BeginsAtZero(Stopper):
    first = 0.0


class OtherWeight(Stopper):
    weight = 0.1


class SignTurned(Stopper):
    def speed(self, error):
        return super().speed(-error)


class EverySecondScan(Stopper):
    count = 0

    def on_message(self, scan):
        self.count += 1
        if self.count % 2:
            super().on_message(scan)


class Wobbles(Stopper):
    """I without measure."""

    p, i = 0.2, 0.6


class SaysNoSpeed(Stopper):
    def on_message(self, scan):
        self.filter(scan.ranges[0])
        self.distances.publish(Float64(data=self.distance))


class LeavesItToTheBrake(Stopper):
    """Drives up to the place, and says nothing more."""

    def on_message(self, scan):
        self.filter(scan.ranges[0])
        self.distances.publish(Float64(data=self.distance))
        if self.distance > 0.62:
            self.speeds.publish(Float64(data=0.1 if self.distance < 0.8 else 0.3))


class TooNear(Stopper):
    """Wants a distance of 0.2 m, and goes there slowly."""

    i = 0.0

    def speed(self, error):
        return super().speed(error + 0.4)
