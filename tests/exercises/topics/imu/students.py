"""IMUs: right ones, and wrong ones named by their defect."""

import math
import time

import rclpy
from geometry_msgs.msg import Quaternion, Vector3
from rclpy.node import Node
from sensor_msgs.msg import Imu
from std_msgs.msg import Header

HALF = math.pi / 4


class ImuPublisher(Node):
    """As one would write it."""

    topic, period = "/imu/data", 0.01

    def __init__(self):
        super().__init__("imu")
        self.publisher = self.create_publisher(Imu, self.topic, 10)
        self.create_timer(self.period, self.measure)

    def measure(self):
        msg = Imu()
        msg.header.stamp = self.get_clock().now().to_msg()
        msg.header.frame_id = "imu_link"
        msg.linear_acceleration.z = 9.81
        msg.orientation.z = math.sin(HALF)
        msg.orientation.w = math.cos(HALF)
        self.fill(msg)
        self.publisher.publish(msg)

    def fill(self, msg):
        """What the wrong ones do otherwise."""


class ImuWithOneMessage(Node):
    """Makes the message once, and only stamps it anew; its quaternion has the other sign."""

    def __init__(self):
        super().__init__("imu")
        self.msg = Imu(
            header=Header(frame_id="imu_link"),
            orientation=Quaternion(z=-math.sqrt(0.5), w=-math.sqrt(0.5)),
            linear_acceleration=Vector3(z=9.81),
        )
        self.publisher = self.create_publisher(Imu, "imu/data", 100)
        self.create_timer(1 / 100, self.measure)

    def measure(self):
        self.msg.header.stamp = self.get_clock().now().to_msg()
        self.publisher.publish(self.msg)


def main_that_sleeps_between_messages():
    rclpy.init()
    node = Node("imu", namespace="imu")
    publisher = node.create_publisher(Imu, "data", 10)
    while rclpy.ok():
        msg = Imu()
        msg.header.frame_id, msg.header.stamp = "imu_link", node.get_clock().now().to_msg()
        msg.orientation.z = msg.orientation.w = 0.7071
        msg.linear_acceleration.z = 9.81
        publisher.publish(msg)
        time.sleep(0.01)


def imu_made_by_a_function():
    node = Node("imu")
    publisher = node.create_publisher(Imu, "/imu/data", 10)

    async def measure():
        msg = Imu(orientation=Quaternion(x=0.0, y=0.0, z=math.sin(HALF), w=math.cos(HALF)))
        msg.header = Header(stamp=node.get_clock().now().to_msg(), frame_id="imu_link")
        msg.linear_acceleration = Vector3(x=0.0, y=0.0, z=9.81)
        publisher.publish(msg)

    node.create_timer(0.01, measure)
    return node


class TopicWithoutSlash(ImuPublisher):
    topic = "/imu_data"


class TenHertz(ImuPublisher):
    period = 0.1


class PeriodAsRate(ImuPublisher):
    period = 100


class SleepsInTheTimer(ImuPublisher):
    def fill(self, msg):
        time.sleep(0.05)


class NoFrame(ImuPublisher):
    def fill(self, msg):
        msg.header.frame_id = ""


class FrameWithSlash(ImuPublisher):
    def fill(self, msg):
        msg.header.frame_id = "/imu_link"


class NoStamp(ImuPublisher):
    def fill(self, msg):
        msg.header.stamp.sec = msg.header.stamp.nanosec = 0


class StampedOnceInInit(ImuPublisher):
    def __init__(self):
        super().__init__()
        self.stamp = self.get_clock().now().to_msg()

    def fill(self, msg):
        msg.header.stamp = self.stamp


class ClockOfTheMachine(ImuPublisher):
    """What the monotonic clock shows has nothing to do with the time of day."""

    def fill(self, msg):
        msg.header.stamp.sec = int(time.monotonic())


class GravityDownwards(ImuPublisher):
    def fill(self, msg):
        msg.linear_acceleration.z = -9.81


class AngleInPlaceOfQuaternion(ImuPublisher):
    def fill(self, msg):
        msg.orientation = Quaternion(z=90.0)


class WholeAngle(ImuPublisher):
    """Forgets to halve the angle."""

    def fill(self, msg):
        msg.orientation = Quaternion(z=math.sin(math.pi / 2), w=math.cos(math.pi / 2))


class DegreesIntoSine(ImuPublisher):
    def fill(self, msg):
        msg.orientation = Quaternion(z=math.sin(45), w=math.cos(45))


class NotANumber(ImuPublisher):
    def fill(self, msg):
        msg.orientation.w = math.nan


class WholeNumber(ImuPublisher):
    def fill(self, msg):
        msg.linear_acceleration.z = 10


class NumberAsAcceleration(ImuPublisher):
    def fill(self, msg):
        msg.linear_acceleration = 9.81
