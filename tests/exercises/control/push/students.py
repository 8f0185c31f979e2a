"""Controllers for any pole, and any push: right ones, and wrong ones named by their defect."""

import time

import numpy as np
import rclpy
from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64


class Balancer(Node):
    """As one would write it; the wrong ones change one thing each."""

    gains = 60.0, 9.0, 10.0, 11.0  # N per rad, rad/s, m, m/s
    limit = 10.0

    def __init__(self):
        super().__init__("balancer")
        self.publisher = self.create_publisher(Float64, "/cart_effort", 10)
        self.create_subscription(JointState, "/joint_states", self.on_joints, 10)

    def on_joints(self, msg):
        (x, angle), (speed, rate) = msg.position, msg.velocity
        pole, turn, place, way = self.gains
        self.push(-pole * angle - turn * rate + place * x + way * speed)

    def push(self, effort):
        self.publisher.publish(Float64(data=max(-self.limit, min(self.limit, effort))))


class ByPlacedPoles(Balancer):
    """A design of its own: what the place asks for has a limit, so that a far cart never upsets the pole."""

    def on_joints(self, msg):
        (x, angle), (speed, rate) = msg.position, msg.velocity
        home = max(-6.0, min(6.0, 10.0 * x + 11.0 * speed))
        self.push(home - 60.0 * angle - 9.0 * rate)


class WithoutThePlace(Balancer):
    gains = 60.0, 9.0, 0.0, 11.0


class Cascade(Balancer):
    """The place says how far to lean, and the lean says how hard to push."""

    def on_joints(self, msg):
        (x, angle), (speed, rate) = msg.position, msg.velocity
        lean = max(-0.3, min(0.3, 0.18 * x + 0.2 * speed))
        self.push(60.0 * (lean - angle) - 9.0 * rate)


class OnATimer(Balancer):
    """A loop of its own."""

    joints, period = None, 0.01

    def __init__(self):
        super().__init__()
        self.create_timer(self.period, self.loop)

    def on_joints(self, msg):
        self.joints = msg

    def loop(self):
        if self.joints:
            super().on_joints(self.joints)


def main_without_a_class():
    rclpy.init()
    node = rclpy.create_node("balancer")
    publisher = node.create_publisher(Float64, "/cart_effort", 10)

    def on_message(joints):
        (x, angle), (v, w) = joints.position, joints.velocity
        push = 9.0 * x + 10.0 * v - 55.0 * angle - 8.0 * w
        publisher.publish(Float64(data=min(max(push, -10.0), 10.0)))

    node.create_subscription(JointState, "/joint_states", on_message, 10)
    rclpy.spin(node)


class ByRiccati(Balancer):
    """The best gains for a cart in the middle of the range, from a model of it."""

    def __init__(self):
        super().__init__()
        cart, pole, length, step = 0.55, 0.13, 0.37, 0.01  # kg, kg, m, s
        drift = 9.81 * pole / cart  # m/s^2 per rad
        model = np.eye(4) + step * np.array([
            [0, 0, 1, 0],
            [0, 0, 0, 1],
            [0, drift, 0, 0],
            [0, (drift + 9.81) / length, 0, 0],
        ])
        force = step * np.array([[0], [0], [1 / cart], [1 / (cart * length)]])
        cost = worth = np.diag([60.0, 60.0, 4.0, 1.0])
        for _ in range(3000):
            self.best = np.linalg.solve(0.3 + force.T @ worth @ force, force.T @ worth @ model)[0]
            worth = cost + model.T @ worth @ (model - force @ self.best[None])

    def on_joints(self, msg):
        self.push(-float(self.best @ [*msg.position, *msg.velocity]))


class RatesByItself(Balancer):
    """Trusts the positions alone: smoothed differences are its rates."""

    before, rates = None, (0.0, 0.0)

    def on_joints(self, msg):
        if self.before is not None:
            pairs = zip(msg.position, self.before, self.rates, strict=True)
            self.rates = tuple(0.6 * (new - old) / 0.01 + 0.4 * rate for new, old, rate in pairs)
        self.before, msg.velocity = list(msg.position), list(self.rates)
        super().on_joints(msg)


class AngleOnly(Balancer):
    gains = 60.0, 9.0, 0.0, 0.0


class NoD(Balancer):
    gains = 60.0, 0.0, 10.0, 11.0


class SignTurned(Balancer):
    gains = tuple(-gain for gain in Balancer.gains)


class TooWeak(Balancer):
    """Enough for a pole that no one pushes."""

    gains = 16.0, 2.5, 1.0, 1.5


class TenHertz(OnATimer):
    period = 0.1


class NoLimit(Balancer):
    limit = 1000.0


class ComesBackSlowly(Balancer):
    gains = 60.0, 9.0, 1.0, 5.0


class Nervous(Balancer):
    """Too little D for its P: it swings for long."""

    gains = 60.0, 3.6, 3.0, 6.0


class Sleeps(Balancer):
    def push(self, effort):
        super().push(effort)
        time.sleep(0.06)


class Idle(Balancer):
    def push(self, effort):
        pass


class ByNameAndNewest(Balancer):
    """Right, too: joints are found by their names, and the newest state alone counts."""

    def __init__(self):
        Node.__init__(self, "balancer")
        self.publisher = self.create_publisher(Float64, "/cart_effort", 1)
        self.create_subscription(JointState, "/joint_states", self.on_joints, 1)

    def on_joints(self, msg):
        slider, pole = msg.name.index("slider_joint"), msg.name.index("pole_joint")
        effort = -60.0 * msg.position[pole] - 9.0 * msg.velocity[pole]
        self.push(effort + 10.0 * msg.position[slider] + 11.0 * msg.velocity[slider])
