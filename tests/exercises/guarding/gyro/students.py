"""Headings from a gyro: right ones, and wrong ones named by their defect."""

import math
import statistics

import numpy as np
import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import Imu
from std_msgs.msg import Float64


class Gyro(Node):
    """As one would write it."""

    still, step, sign, topic = 200, None, 1.0, "/heading"

    def __init__(self):
        super().__init__("gyro")
        self.rates, self.bias, self.yaw, self.before = [], 0.0, 0.0, None
        self.publisher = self.create_publisher(Float64, self.topic, 10)
        self.create_subscription(Imu, "/imu/data", self.look, 10)

    def look(self, msg):
        rate = msg.angular_velocity.z
        if len(self.rates) < self.still:
            self.rates.append(rate)
            self.bias = statistics.mean(self.rates)
        else:
            self.yaw += self.sign * (rate - self.bias) * (self.step or self.since(msg))
        self.before = Time.from_msg(msg.header.stamp)
        self.publisher.publish(Float64(data=self.tell(self.yaw)))

    def since(self, msg):
        before = self.before or Time.from_msg(msg.header.stamp)
        return (Time.from_msg(msg.header.stamp) - before).nanoseconds / 1e9

    def tell(self, yaw):
        return math.degrees(yaw)


class GyroByStamps(Node):
    """Takes time from the header, and the bias as a running mean of the first 2.5 s."""

    def __init__(self):
        super().__init__("gyro")
        self.count, self.bias, self.heading, self.last = 0, 0.0, 0.0, None
        self.begin = self.get_clock().now().nanoseconds * 1e-9
        self.pub = self.create_publisher(Float64, "heading", 10)
        self.create_subscription(Imu, "imu/data", self.imu_callback, qos_profile_sensor_data)

    def imu_callback(self, msg):
        stamp = msg.header.stamp.sec + msg.header.stamp.nanosec * 1e-9 - self.begin
        if stamp < 2.5:
            self.count += 1
            self.bias += (msg.angular_velocity.z - self.bias) / self.count
        elif self.last is not None:
            self.heading += (msg.angular_velocity.z - self.bias) * (stamp - self.last)
        self.last = stamp
        self.pub.publish(Float64(data=math.degrees(math.remainder(self.heading, math.tau))))


class GyroWithTimer(Node):
    """Sums in the callback, speaks ten times a second, degrees all through."""

    def __init__(self):
        super().__init__("imu_heading")
        self.samples, self.heading, self.last = [], 0.0, self.get_clock().now()
        self.drives_off = self.get_clock().now() + Duration(seconds=2)
        self.publisher = self.create_publisher(Float64, "/heading", 10)
        self.create_subscription(Imu, "/imu/data", self.integrate, 50)
        self.create_timer(0.1, self.publish)

    def integrate(self, msg):
        rate, now = math.degrees(msg.angular_velocity.z), Time.from_msg(msg.header.stamp)
        if self.get_clock().now() < self.drives_off:
            self.samples.append(rate)
        else:
            self.heading += (rate - np.mean(self.samples)) * (now - self.last).nanoseconds * 1e-9
        self.last = now

    def publish(self):
        self.publisher.publish(Float64(data=float(self.heading)))


def main():
    """A design of its own: from the orientation that the IMU has summed up, without its drift."""
    rclpy.init()
    node = rclpy.create_node("gyro")
    pub = node.create_publisher(Float64, "/heading", 10)
    seen, start = [], node.get_clock().now()

    def callback(msg):
        now = (Time.from_msg(msg.header.stamp) - start).nanoseconds / 1e9
        yaw = math.degrees(2 * math.atan2(msg.orientation.z, msg.orientation.w))
        if now <= 2.5:
            seen.append((now, yaw))
        (begin, first), (end, last) = seen[0], seen[-1]
        drift = (last - first) / max(end - begin, 0.01)
        pub.publish(Float64(data=yaw - first - drift * (now - begin) if now > 2.5 else 0.0))

    node.create_subscription(Imu, "/imu/data", callback, 10)
    rclpy.spin(node)


class NoBias(Gyro):
    still = 0


class OneReading(Gyro):
    """One reading is mostly noise."""

    still = 1


class AddsTheBias(Gyro):
    def look(self, msg):
        msg.angular_velocity.z += 2 * self.bias * (len(self.rates) >= self.still)
        super().look(msg)


class BiasWhileTurning(Gyro):
    """Takes the mean over the first 6 s, in which the robot sets off."""

    still = 600


class WrongSide(Gyro):
    sign = -1.0


class NoTimeStep(Gyro):
    step = 1.0


class StepOfTheScans(Gyro):
    step = 0.05


class StepByHeart(Gyro):
    """As if each of the 100 messages a second arrived."""

    step = 0.01


class Radians(Gyro):
    def tell(self, yaw):
        return yaw


class RateAsHeading(Gyro):
    """Publishes how fast it turns, not how far."""

    def look(self, msg):
        self.publisher.publish(Float64(data=math.degrees(msg.angular_velocity.z)))


class RoundsEachStep(Gyro):
    """Small steps, rounded away."""

    def look(self, msg):
        super().look(msg)
        self.yaw = round(self.yaw, 2)


class SmoothsTooMuch(Gyro):
    """Comes near to the right heading in 2 s, and goes on turning when the robot stands."""

    smooth = 0.0

    def tell(self, yaw):
        self.smooth += 0.005 * (yaw - self.smooth)
        return math.degrees(self.smooth)


class WaitsTooLong(Gyro):
    """Says nothing until the bias is known, for 5 s."""

    def __init__(self):
        super().__init__()
        self.known = self.get_clock().now() + Duration(seconds=5)

    def look(self, msg):
        if self.get_clock().now() > self.known:
            super().look(msg)


class MisspeltTopic(Gyro):
    topic = "/headings"


class AngularVelocityWithoutZ(Gyro):
    def look(self, msg):
        self.yaw += msg.angular_velocity * 0.01


class NeverCollects(Gyro):
    """Waits for 200 rates, and keeps none."""

    def look(self, msg):
        super().look(msg)
        self.rates.clear()


class TakesTheBiasFromTheAngle(Gyro):
    """A bias is a rate: it, too, counts for 0.01 s."""

    def look(self, msg):
        super().look(msg)
        if len(self.rates) == self.still:
            self.yaw -= self.bias


class KeepsTheLastStepOnly(Gyro):
    def look(self, msg):
        self.yaw = 0.0
        super().look(msg)


class DegreesTwice(Gyro):
    step = math.degrees(0.01)


class BeginsWithNoNumber(Gyro):
    def __init__(self):
        super().__init__()
        self.yaw = math.nan
