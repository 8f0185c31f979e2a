"""Controllers of a pole's angle: right ones, and wrong ones named by their defect."""

import math
import time

import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64


class Balancer(Node):
    """As one would write it; the wrong ones change one thing each."""

    p, d = 30.0, 4.0

    def __init__(self):
        super().__init__("balancer")
        self.begin, self.stood, self.fell = None, 0.0, False
        self.publisher = self.create_publisher(Float64, "/cart_effort", 10)
        self.times = self.create_publisher(Float64, "/stood", 10)
        self.create_subscription(JointState, "/joint_states", self.on_message, 10)

    def on_message(self, msg):
        angle, rate = msg.position[1], msg.velocity[1]
        self.push(angle, rate)
        now = Time.from_msg(msg.header.stamp).nanoseconds / 1e9
        self.begin = now if self.begin is None else self.begin
        self.fell = self.fell or self.lies(angle)
        self.tell(now - self.begin)

    def lies(self, angle):
        return abs(angle) > 0.5

    def push(self, angle, rate):
        self.publisher.publish(Float64(data=-(self.p * angle + self.d * rate)))

    def tell(self, seconds):
        if not self.fell:
            self.stood = seconds
        self.times.publish(Float64(data=self.stood))


class ByName(Node):
    """A design of its own: looks the joint up by its name, and takes the time from its clock."""

    def __init__(self):
        super().__init__("pole")
        self.effort = self.create_publisher(Float64, "cart_effort", 1)
        self.report = self.create_publisher(Float64, "stood", 1)
        self.began = self.get_clock().now()
        self.fell = None
        self.create_subscription(JointState, "joint_states", self.on_joints, qos_profile_sensor_data)

    def on_joints(self, joints):
        pole = joints.name.index("pole_joint")
        effort = -50.0 * joints.position[pole] - 6.0 * joints.velocity[pole]
        self.effort.publish(Float64(data=max(-10.0, min(10.0, effort))))
        now = self.get_clock().now()
        if abs(joints.position[pole]) > 0.5 and self.fell is None:
            self.fell = now
        stood = (self.fell or now) - self.began
        self.report.publish(Float64(data=stood.nanoseconds / 1e9))


class OnATimer(Balancer):
    """Keeps what it received, and pushes a hundred times a second."""

    period = 0.01

    def __init__(self):
        super().__init__()
        self.last = (0.0, 0.0)
        self.create_timer(self.period, lambda: Balancer.push(self, *self.last))

    def push(self, angle, rate):
        self.last = angle, rate


def main_without_a_class():
    rclpy.init()
    node = rclpy.create_node("balancer")
    efforts = node.create_publisher(Float64, "/cart_effort", 10)
    times = node.create_publisher(Float64, "/stood", 10)
    stamps, fallen = [], []

    def on_message(msg):
        if abs(msg.position[1]) > 0.5 or fallen:
            fallen.append(msg)
        else:
            stamps.append(msg.header.stamp.sec + msg.header.stamp.nanosec / 1e9)
        efforts.publish(Float64(data=-(40.0 * msg.position[1] + 5.0 * msg.velocity[1])))
        times.publish(Float64(data=stamps[-1] - stamps[0]))

    node.create_subscription(JointState, "/joint_states", on_message, 10)
    rclpy.spin(node)


class NoD(Balancer):
    d = 0.0


class SignTurned(Balancer):
    p, d = -30.0, -4.0


class DTurned(Balancer):
    d = -4.0


class TooWeak(Balancer):
    p = 3.0


class TenHertz(OnATimer):
    period = 0.1


class EveryFourth(Balancer):
    """Receives a hundred joint states a second, and answers 25."""

    count = 0

    def push(self, angle, rate):
        self.count += 1
        if self.count % 4 == 0:
            super().push(angle, rate)


class Sleeps(Balancer):
    """Waits for the cart to move, and receives nothing meanwhile."""

    def push(self, angle, rate):
        super().push(angle, rate)
        time.sleep(0.08)


class PushesNothing(Balancer):
    def push(self, angle, rate):
        pass


class GoesOnCounting(Balancer):
    def lies(self, angle):
        return False


class GivesUpEarly(Balancer):
    def lies(self, angle):
        return abs(angle) > 0.03


class Nanoseconds(Balancer):
    def tell(self, seconds):
        super().tell(seconds * 1e9)


class TellsOnceASecond(Balancer):
    count = 0

    def tell(self, seconds):
        self.count += 1
        if self.fell or self.count % 100 == 0:
            super().tell(seconds)


class StandsForNan(Balancer):
    """The time is not a number."""

    def tell(self, seconds):
        super().tell(math.nan)
