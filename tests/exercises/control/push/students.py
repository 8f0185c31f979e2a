"""Controllers for any pole, and any push: right ones, and wrong ones named by their defect."""

import threading

import numpy as np
import rclpy
from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64

from tests.students.teams import Team

PARTS = "Outer", "Inner"


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


class Outer(Node):
    """The slow half of a cascade in two nodes: 25 times a second it says on /lean how far the pole should lean."""

    def __init__(self):
        super().__init__("outer")
        self.publisher = self.create_publisher(Float64, "/lean", 1)
        self.create_subscription(JointState, "/joint_states", self.on_joints, 1)
        self.create_timer(0.04, self.tick)
        self.state = None

    def on_joints(self, msg):
        self.state = msg.position[0], msg.velocity[0]

    def tick(self):
        if self.state is not None:
            self.publisher.publish(Float64(data=max(-0.3, min(0.3, 0.18 * self.state[0] + 0.2 * self.state[1]))))


class Inner(Balancer):
    """The fast half makes it lean that far; until the first message, upright."""

    def __init__(self):
        super().__init__()
        self.lean = 0.0
        self.create_subscription(Float64, "/lean", lambda msg: setattr(self, "lean", msg.data), 1)

    def on_joints(self, msg):
        self.push(60.0 * (self.lean - msg.position[1]) - 9.0 * msg.velocity[1])


TwoNodes = Team(Outer, Inner)


class WithAnIntegral(Balancer):
    """PID on the angle whose wanted value comes from the place; the sum is limited, and small."""

    total = 0.0

    def on_joints(self, msg):
        (x, angle), (speed, rate) = msg.position, msg.velocity
        error = max(-0.3, min(0.3, 0.17 * x + 0.19 * speed)) - angle
        self.total = max(-0.02, min(0.02, self.total + 0.01 * error))
        self.push(60.0 * error + 5.0 * self.total - 9.0 * rate)


class ByAnObserver(Balancer):
    """Believes no velocity: an observer tracks place and angle, and estimates how fast they change."""

    track = None

    def on_joints(self, msg):
        if self.track is None:
            self.track = np.array([[value, 0.0] for value in msg.position])
        self.track[:, 0] += 0.01 * self.track[:, 1]
        off = np.array(msg.position) - self.track[:, 0]
        self.track += np.outer(off, [0.7, 30.0])
        (x, speed), (angle, rate) = self.track
        self.push(float(-60.0 * angle - 9.0 * rate + 10.0 * x + 11.0 * speed))


class Mass(Balancer):
    """Thinks in accelerations: which one does the cart need, and which force gives it that?"""

    def on_joints(self, msg):
        (x, angle), (speed, rate) = msg.position, msg.velocity
        wanted = 18.0 * x + 19.0 * speed - 105.0 * angle - 15.5 * rate  # m/s^2, of a cart
        self.push(0.57 * wanted)  # kg in the middle of the range


def loop_that_spins():
    """A program's own loop, as in a firmware: take the newest state, compute, send."""
    rclpy.init()
    node, box = rclpy.create_node("balancer"), []
    publisher = node.create_publisher(Float64, "cart_effort", 10)
    node.create_subscription(JointState, "joint_states", box.append, 10)
    while rclpy.ok():
        rclpy.spin_once(node)
        if box:
            state = dict(zip(box[-1].name, zip(box[-1].position, box[-1].velocity, strict=True), strict=True))
            box.clear()
            (x, v), (phi, omega) = state["slider_joint"], state["pole_joint"]
            effort = np.dot([10.0, 11.0, -60.0, -9.0], [x, v, phi, omega])
            publisher.publish(Float64(data=float(np.clip(effort, -10.0, 10.0))))


class ControlThread(Balancer):
    """A thread of its own computes, a hundred times a second; the callback only stores."""

    joints = None

    def __init__(self):
        super().__init__()
        self.rate = self.create_rate(100)
        threading.Thread(target=self.work, daemon=True).start()

    def on_joints(self, msg):
        self.joints = msg

    def work(self):
        while rclpy.ok():
            self.rate.sleep()
            if self.joints is not None:
                super().on_joints(self.joints)


class GainsAreParameters(Balancer):
    """A design of its own: two sets of gains, and the one for hard times while it is far from the middle."""

    def __init__(self):
        super().__init__()
        self.declare_parameter("calm", [60.0, 9.0, 10.0, 11.0])
        self.declare_parameter("hard", [70.0, 10.0, 9.0, 11.0])

    def on_joints(self, msg):
        far = abs(msg.position[0]) > 0.4 or abs(msg.position[1]) > 0.25
        self.gains = self.get_parameter("hard" if far else "calm").value
        super().on_joints(msg)


class BangBang(Balancer):
    """Full force to either side, a hundred times a second: hard on a motor, and right by all that is asked."""

    def push(self, effort):
        super().push(10.0 if effort > 0 else -10.0)


class AngleOnly(Balancer):
    gains = 60.0, 9.0, 0.0, 0.0


class SignTurned(Balancer):
    gains = tuple(-gain for gain in Balancer.gains)


class TooWeak(Balancer):
    """Enough for a pole that no one pushes."""

    gains = 16.0, 2.5, 1.0, 1.5


class TenHertz(OnATimer):
    period = 0.1


class NoLimit(Balancer):
    limit = 1000.0


class Nervous(Balancer):
    """Too little D for its P: it swings for long."""

    gains = 60.0, 3.6, 3.0, 6.0


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


class WindsUp(Balancer):
    """An integral of the place, without a limit."""

    total = 0.0

    def on_joints(self, msg):
        self.total += 0.01 * msg.position[0]
        (x, angle), (speed, rate) = msg.position, msg.velocity
        self.push(-60.0 * angle - 9.0 * rate + 10.0 * x + 11.0 * speed + 15.0 * self.total)


class NotANumber(Balancer):
    """Divides by the cart's mass, which it takes to be 0 as long as it doesn't know it."""

    def push(self, effort):
        with np.errstate(all="ignore"):
            self.publisher.publish(Float64(data=float(np.clip(np.float64(effort) / 0.0 * 0.0, -10.0, 10.0))))


class EndsAtTheFirstPush(Balancer):
    """Takes the jolt for an accident, and switches off."""

    off = False

    def on_joints(self, msg):
        self.off = self.off or abs(msg.velocity[0]) > 0.5
        if not self.off:
            super().on_joints(msg)
