"""Nodes that wait for a joint's arrival: right ones, and wrong ones named by their defect."""

import math

import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Float64MultiArray

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Patient(Node):
    """As one would write it; the wrong ones change one thing each."""

    def __init__(self):
        super().__init__("patient")
        self.positions, self.target = [], None
        self.publisher = self.create_publisher(Float64, "/joint_commands", 10)
        self.create_subscription(Float64MultiArray, "/positions", self.take, LATCHED)
        self.create_subscription(JointState, "/joint_states", self.watch, 10)

    def take(self, msg):
        self.positions = list(msg.data)

    def watch(self, msg):
        index = msg.name.index("joint")
        arrived = self.target is None or self.has_arrived(msg.position[index], msg.velocity[index])
        if arrived and self.positions:
            self.target = self.next()
            self.publisher.publish(Float64(data=self.target))

    def next(self):
        return self.positions.pop(0)

    def has_arrived(self, position, velocity):
        return abs(position - self.target) < 0.01 and abs(velocity) < 0.01


class WithATimer(Patient):
    """Remembers the newest state, and looks at it ten times a second."""

    state = None

    def __init__(self):
        super().__init__()
        self.create_timer(0.1, self.look)

    def watch(self, msg):
        self.state = msg

    def look(self):
        if self.state is not None:
            super().watch(self.state)


class SaysItAgain(Patient):
    """A design of its own: the same command with each state, until the next one's turn comes."""

    def watch(self, msg):
        super().watch(msg)
        if self.target is not None:
            self.publisher.publish(Float64(data=self.target))


class FirstAtOnce(Patient):
    """The first goes out as soon as it is known and the arm is found, as the task says."""

    first = None

    def take(self, msg):
        super().take(msg)
        self.first = self.create_timer(0.01, self.send_first)

    def send_first(self):
        self.first.cancel()
        self.target = self.next()
        self.publisher.publish(Float64(data=self.target))

    def watch(self, msg):
        if self.first is not None and self.first.is_canceled():
            super().watch(msg)


def main_step_by_step():
    rclpy.init()
    node = rclpy.create_node("patient")
    publisher = node.create_publisher(Float64, "joint_commands", 10)
    places, state = [], {}
    node.create_subscription(Float64MultiArray, "positions", lambda msg: places.extend(msg.data), LATCHED)
    node.create_subscription(
        JointState,
        "joint_states",
        lambda msg: state.update(zip(msg.name, zip(msg.position, msg.velocity, strict=False), strict=False)),
        10,
    )
    while not (places and state):
        rclpy.spin_once(node)
    for place in places:
        publisher.publish(Float64(data=place))
        while True:
            rclpy.spin_once(node)
            position, velocity = state["joint"]
            if math.isclose(position, place, abs_tol=0.02) and abs(velocity) < 0.02:
                break
    rclpy.spin(node)


class CountsTime(Patient):
    """The poor way: two seconds are enough, aren't they?"""

    def __init__(self):
        super().__init__()
        self.create_timer(2.0, self.send)

    def watch(self, msg):
        pass

    def send(self):
        if self.positions:
            self.publisher.publish(Float64(data=self.next()))


class CountsALongTime(CountsTime):
    """Always enough, and nearly always too much."""

    def __init__(self):
        Patient.__init__(self)
        self.create_timer(5.5, self.send)


class WithoutAbs(Patient):
    def has_arrived(self, position, velocity):
        return position - self.target < 0.01


class SignOfTheVelocity(Patient):
    """Turning to the right is no standing still."""

    def has_arrived(self, position, velocity):
        return abs(position - self.target) < 0.2 and velocity < 0.01


class RoughlyThere(Patient):
    def has_arrived(self, position, velocity):
        return abs(position - self.target) < 0.3


class PositionOnly(Patient):
    """Near enough, but still moving."""

    def has_arrived(self, position, velocity):
        return abs(position - self.target) < 0.028


class Degrees(Patient):
    def next(self):
        return math.degrees(super().next())


class LastFirst(Patient):
    def next(self):
        return self.positions.pop()


class LeavesOneOut(Patient):
    def next(self):
        return self.positions.pop(0 if self.target is None else min(1, len(self.positions) - 1))


class GoesHome(Patient):
    """And then back to 0, which no one wanted."""

    def take(self, msg):
        self.positions = [*msg.data, 0.0]


class AllAtOnce(Patient):
    def take(self, msg):
        for position in msg.data:
            self.publisher.publish(Float64(data=position))


class LateByASecond(Patient):
    """Waits a second more, to be sure."""

    since = 0

    def has_arrived(self, position, velocity):
        self.since = self.since + 1 if super().has_arrived(position, velocity) else 0
        if self.since < 20:
            return False
        self.since = 0
        return True


class Silent(Patient):
    def watch(self, msg):
        pass


class ComparesForEquality(Patient):
    """An encoder never measures exactly that."""

    def has_arrived(self, position, velocity):
        return position == self.target


class LongEnoughForAll(Patient):
    """Begins at once, and 5.5 s later it is surely there."""

    def watch(self, msg):
        if self.target is None and self.positions:
            self.send()
            self.create_timer(5.5, self.send)

    def send(self):
        if self.positions:
            self.target = self.next()
            self.publisher.publish(Float64(data=self.target))


class Rounded(Patient):
    """Publishes the positions with one decimal."""

    def take(self, msg):
        self.positions = [round(position, 1) for position in msg.data]


class TooCautious(Patient):
    """Waits for 4.5 s at each position, and gets to the end of the run."""

    def has_arrived(self, position, velocity):
        self.since = getattr(self, "since", 0) + 1 if super().has_arrived(position, velocity) else 0
        if self.since < 90:
            return False
        self.since = 0
        return True
