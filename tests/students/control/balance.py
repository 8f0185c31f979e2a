"""Controllers of a pole's angle: right ones, and wrong ones named by their defect."""

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
        self.begin, self.told = None, False
        self.publisher = self.create_publisher(Float64, "/cart_effort", 10)
        self.fallen = self.create_publisher(Float64, "/fallen", 10)
        self.create_subscription(JointState, "/joint_states", self.hear, 10)

    def hear(self, msg):
        angle, rate = msg.position[1], msg.velocity[1]
        self.push(angle, rate)
        now = Time.from_msg(msg.header.stamp).nanoseconds / 1e9
        self.begin = now if self.begin is None else self.begin
        if self.lies(angle) and not self.told:
            self.tell(now - self.begin)

    def lies(self, angle):
        return abs(angle) > 0.5

    def push(self, angle, rate):
        self.publisher.publish(Float64(data=-(self.p * angle + self.d * rate)))

    def tell(self, seconds):
        self.told = True
        self.fallen.publish(Float64(data=seconds))


class ByName(Node):
    """Looks the joint up by its name, and takes the time from its clock."""

    def __init__(self):
        super().__init__("pole")
        self.effort = self.create_publisher(Float64, "cart_effort", 1)
        self.report = self.create_publisher(Float64, "fallen", 1)
        self.began = self.get_clock().now()
        self.create_subscription(JointState, "joint_states", self.on_joints, qos_profile_sensor_data)

    def on_joints(self, joints):
        pole = joints.name.index("pole_joint")
        effort = -50.0 * joints.position[pole] - 6.0 * joints.velocity[pole]
        self.effort.publish(Float64(data=max(-10.0, min(10.0, effort))))
        if abs(joints.position[pole]) > 0.5 and self.report:
            stood = self.get_clock().now() - self.began
            self.report.publish(Float64(data=stood.nanoseconds / 1e9))
            self.report = None


class OnATimer(Balancer):
    """Keeps what it heard, and pushes a hundred times a second."""

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
    fallen = node.create_publisher(Float64, "/fallen", 10)
    stamps, told = [], []

    def hear(msg):
        stamps.append(msg.header.stamp.sec + msg.header.stamp.nanosec / 1e9)
        efforts.publish(Float64(data=-(40.0 * msg.position[1] + 5.0 * msg.velocity[1])))
        if abs(msg.position[1]) > 0.5 and not told:
            told.append(stamps[-1] - stamps[0])
            fallen.publish(Float64(data=told[0]))

    node.create_subscription(JointState, "/joint_states", hear, 10)
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
    """Hears a hundred joint states a second, and answers 25."""

    count = 0

    def push(self, angle, rate):
        self.count += 1
        if self.count % 4 == 0:
            super().push(angle, rate)


class Sleeps(Balancer):
    """Waits for the cart to move, and hears nothing meanwhile."""

    def push(self, angle, rate):
        super().push(angle, rate)
        time.sleep(0.08)


class PushesNothing(Balancer):
    def push(self, angle, rate):
        pass


class TellsAllTheTime(Balancer):
    def tell(self, seconds):
        self.fallen.publish(Float64(data=seconds))


class TellsTooEarly(Balancer):
    def lies(self, angle):
        return abs(angle) > 0.03


class TellsOneSide(Balancer):
    """The pole leans to the left, and may fall to the right."""

    def lies(self, angle):
        return angle < -0.5


class TellsNanoseconds(Balancer):
    def tell(self, seconds):
        super().tell(seconds * 1e9)


class TellsTooLate(Balancer):
    def lies(self, angle):
        return abs(angle) > 1.5
