"""Controllers of the cart and its pole, right and wrong."""

import math

from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64


class Balancer(Node):
    """Pushes each time it receives the joints.

    The gains are a linear-quadratic regulator's for the figures of the world cart_pole at 100 Hz, with
    weights 1 on the place, 10 on the angle and 0.005 on the force.
    """

    gains = (-12.3, -11.7, 59.5, 7.5)  # N per m, m/s, rad, rad/s

    def __init__(self):
        super().__init__("balancer")
        self.publisher = self.create_publisher(Float64, "cart_effort", 10)
        self.create_subscription(JointState, "joint_states", self.on_joints, 10)

    def on_joints(self, joints):
        self.push(joints)

    def push(self, joints):
        x, angle = joints.position
        v, w = joints.velocity
        k1, k2, k3, k4 = self.gains  # not sum(): Python 3.12 rounds it in another way than 3.11
        self.publisher.publish(Float64(data=-(k1 * x + k2 * v + k3 * angle + k4 * w)))


class Steadier(Balancer):
    """PD on the angle and a little on the place, in the student's own words."""

    def push(self, joints):
        angle, rate = joints.position[1], joints.velocity[1]
        lean = 0.1 * joints.position[0] + 0.15 * joints.velocity[0]
        self.publisher.publish(Float64(data=-(50.0 * (angle - lean) + 6.0 * rate)))


class Timed(Balancer):
    """Keeps what it received last and pushes on a timer of 100 Hz."""

    period = 0.01

    def __init__(self):
        super().__init__()
        self.joints = None
        self.create_timer(self.period, self.on_timer)

    def on_joints(self, joints):
        self.joints = joints

    def on_timer(self):
        if self.joints is not None:
            self.push(self.joints)


class TooSlow(Timed):
    """The same at 10 Hz."""

    period = 0.1


class WrongSign(Balancer):
    gains = tuple(-gain for gain in Balancer.gains)


class AngleOnly(Balancer):
    """Forgets the cart: it rolls away to the end of the track."""

    gains = (0.0, 0.0, 59.5, 7.5)


class PushesOnce(Node):
    """One push, and never again: the motor must stop by itself."""

    force = 1.0

    def __init__(self):
        super().__init__("pusher")
        self.publisher = self.create_publisher(Float64, "cart_effort", 10)
        self.timer = self.create_timer(0.1, self.push)

    def push(self):
        self.publisher.publish(Float64(data=self.force))
        self.timer.cancel()


class PushesNoNumber(PushesOnce):
    """Again and again."""

    force = math.nan

    def push(self):
        self.publisher.publish(Float64(data=self.force))


class Flood(PushesNoNumber):
    """Ten thousand commands a second."""

    force = 3.0

    def __init__(self):
        super().__init__()
        self.create_timer(0.0001, self.push)
