"""Drivers that stop when the joystick falls silent: right ones, and wrong ones named by their defect."""

import rclpy
from geometry_msgs.msg import Twist, Vector3
from rclpy.duration import Duration
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy


class Driver(Node):
    """As one would write it; the wrong ones change one thing each."""

    deadline = 0.2  # s

    def __init__(self):
        super().__init__("driver")
        self.command = Twist()
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.listen()
        self.create_timer(0.05, self.repeat)

    def listen(self):
        qos = QoSProfile(depth=1, deadline=Duration(seconds=self.deadline))
        events = SubscriptionEventCallbacks(deadline=self.too_late)
        self.create_subscription(Twist, "/joystick", self.on_message, qos, event_callbacks=events)

    def on_message(self, msg):
        self.command = msg

    def too_late(self, event):
        self.command = Twist()

    def repeat(self):
        self.publisher.publish(self.command)


class AtOnce(Driver):
    """A design of its own: passes each command on as it comes, too; and asks for what the joystick offers."""

    deadline = 0.1

    def on_message(self, msg):
        super().on_message(msg)
        self.repeat()


class LongestDeadline(Driver):
    deadline = 0.3


class BestEffort(Driver):
    deadline = 0.25

    def listen(self):
        qos = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
        qos.deadline = Duration(nanoseconds=250_000_000)
        events = SubscriptionEventCallbacks()
        events.deadline = lambda event: self.too_late(event)
        self.create_subscription(Twist, "/joystick", self.on_message, qos, event_callbacks=events)


def main_without_a_class():
    rclpy.init()
    node = rclpy.create_node("driver")
    publisher = node.create_publisher(Twist, "/cmd_vel", 10)
    last = [Twist()]
    node.create_subscription(
        Twist,
        "/joystick",
        lambda msg: last.append(msg),
        QoSProfile(depth=1, deadline=Duration(seconds=0.15)),
        event_callbacks=SubscriptionEventCallbacks(deadline=lambda event: last.append(Twist())),
    )
    node.create_timer(0.05, lambda: publisher.publish(last[-1]))
    rclpy.spin(node)


class RightOnceIn50Milliseconds(Driver):
    """And drives as it likes for the rest of the time, also where the joystick is silent."""

    ticks = 0

    def __init__(self):
        super().__init__()
        self.create_timer(0.01, self.tick)

    def repeat(self):
        pass

    def tick(self):
        self.ticks += 1
        if self.ticks % 5 == 1:
            self.publisher.publish(self.command)
        elif self.ticks % 5 == 2:
            self.publisher.publish(Twist(linear=Vector3(x=1.0)))


class DrivesOnInSilence(Driver):
    """Zeros go out as they should, and between them other commands."""

    ticks = 0

    def repeat(self):
        self.publisher.publish(self.command)
        self.ticks += 1
        if self.command == Twist() and self.ticks > 20:
            timer = self.create_timer(0.02, lambda: (timer.cancel(), self.push()))

    def push(self):
        self.publisher.publish(Twist(linear=Vector3(x=1.0)))
        timer = self.create_timer(0.02, lambda: (timer.cancel(), self.publisher.publish(self.command)))


class NoCallback(Driver):
    """Asks for a deadline, and it is not reported."""

    def listen(self):
        qos = QoSProfile(depth=1, deadline=Duration(seconds=self.deadline))
        self.create_subscription(Twist, "/joystick", self.on_message, qos)


class NoDeadline(Driver):
    def listen(self):
        self.create_subscription(Twist, "/joystick", self.on_message, 10)


class AsksTooMuch(Driver):
    """The joystick promises a command every 0.1 s, and no more."""

    deadline = 0.05


class OnlyLogs(Driver):
    def too_late(self, event):
        self.get_logger().warning("The joystick is late")


class FallsSilentToo(Driver):
    """Sends nothing more; the robot stops by itself, later."""

    def too_late(self, event):
        self.command = None

    def repeat(self):
        if self.command is not None:
            super().repeat()


class NeverGoesOn(Driver):
    stopped = False

    def too_late(self, event):
        super().too_late(event)
        self.stopped = True

    def on_message(self, msg):
        if not self.stopped:
            super().on_message(msg)


class OwnDriver(Driver):
    """Receives another topic, and drives on its own."""

    def listen(self):
        self.create_subscription(Twist, "/gamepad", self.on_message, 10)
        self.command.linear.x = 0.2


class Relay(Driver):
    """Passes on what it receives, and when it receives nothing, nothing; the robot stops by itself, later."""

    def on_message(self, msg):
        self.publisher.publish(msg)

    def repeat(self):
        pass


class OwnWatch(Driver):
    """Looks at the clock itself, and asks ROS for nothing."""

    received = 0.0

    def listen(self):
        self.create_subscription(Twist, "/joystick", self.on_message, 10)

    def now(self):
        return self.get_clock().now().nanoseconds / 1e9

    def on_message(self, msg):
        super().on_message(msg)
        self.received = self.now()

    def repeat(self):
        if self.now() - self.received > 0.2:
            self.command = Twist()
        super().repeat()
