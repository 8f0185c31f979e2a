"""Nodes that learn of the other ends of their topics, and messages that expire."""

import time

import rclpy
from geometry_msgs.msg import Twist
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import Int32

BRIEF = QoSProfile(depth=10, lifespan=Duration(seconds=1))
BRIEF_LATCHED = QoSProfile(
    depth=10, lifespan=Duration(seconds=1), durability=DurabilityPolicy.TRANSIENT_LOCAL
)
LEASED = QoSProfile(depth=10, liveliness_lease_duration=Duration(seconds=1))
HURRIED = QoSProfile(depth=10, deadline=Duration(seconds=0.2))
LEASE = Duration(seconds=0.5)
BY_HAND = QoSProfile(depth=10, liveliness=LivelinessPolicy.MANUAL_BY_TOPIC, liveliness_lease_duration=LEASE)
SLOPPY_BY_HAND = QoSProfile(
    depth=10,
    reliability=ReliabilityPolicy.BEST_EFFORT,
    liveliness=LivelinessPolicy.MANUAL_BY_TOPIC,
    liveliness_lease_duration=LEASE,
)


class Watcher(Node):
    """Says who comes and goes at both ends: in all, now there. Without a lease no one's life is watched."""

    def __init__(self):
        super().__init__("watcher")
        lost = self.get_logger().error
        events = SubscriptionEventCallbacks(
            liveliness=lost, matched=lambda event: self.say("publishers", event)
        )
        self.create_subscription(Int32, "count", lambda msg: None, 10, event_callbacks=events)
        events = PublisherEventCallbacks(
            liveliness=lost, matched=lambda event: self.say("subscriptions", event)
        )
        self.create_publisher(Int32, "count_2", 10, event_callbacks=events)

    def say(self, who, event):
        change = f"{event.current_count} ({event.current_count_change:+d})"
        self.get_logger().info(f"{who} {event.total_count}, {change}")


class Guest(Node):
    """Comes at 1 s, and goes at 2 s."""

    def __init__(self):
        super().__init__("guest")
        self.create_timer(1.0, self.change)
        self.ends = None

    def change(self):
        if self.ends is None:
            publisher = self.create_publisher(Int32, "count", 10)
            self.ends = publisher, self.create_subscription(Int32, "count_2", lambda msg: None, 10)
        elif self.ends:
            self.destroy_publisher(self.ends[0])
            self.destroy_subscription(self.ends[1])
            self.ends = ()


def leaves():
    """A program that is there from 1 s to 2 s, and just ends."""
    time.sleep(1.0)
    rclpy.init()
    node = Node("leaves")
    node.create_publisher(Int32, "count", 10)
    node.create_subscription(Int32, "count_2", lambda msg: None, 10)
    time.sleep(1.0)


class Says(Node):
    """Says what each event tells: its counts, and how each has changed."""

    def report(self, word):
        def say(event):
            changes = {name: count for name, count in vars(event).items() if name.endswith("_change")}
            counts = {name: count for name, count in vars(event).items() if name not in changes}
            self.get_logger().info(f"{word} {[*counts.values()]} {[*changes.values()]}")

        return say


class Speaks(Says):
    """Publishes on `count` at some times, and says at others that it is alive."""

    profile, speaks, asserts = 10, (), ()

    def __init__(self):
        super().__init__("speaks")
        events = PublisherEventCallbacks(deadline=self.report("offered"), liveliness=self.report("lost"))
        self.publisher = self.create_publisher(Int32, "count", self.profile, event_callbacks=events)
        for stamp in self.speaks:
            self.once(stamp, lambda: self.publisher.publish(Int32()))
        for stamp in self.asserts:
            self.once(stamp, self.publisher.assert_liveliness)

    def once(self, stamp, do):
        def fire():
            timer.cancel()
            do()

        timer = self.create_timer(stamp, fire)


class Listens(Says):
    """Receives `count`, and says what there is to say of it but for the messages."""

    profile = 10

    def __init__(self):
        super().__init__("listens")
        events = SubscriptionEventCallbacks(
            deadline=self.report("requested"),
            liveliness=self.report("changed"),
            message_lost=self.report("missed"),
        )
        self.create_subscription(Int32, "count", lambda msg: None, self.profile, event_callbacks=events)


class ListensOnBestEffort(Listens):
    """Receives what comes."""

    profile = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)


class Punctual(Speaks):
    """In time until 1.4 s, and once again."""

    profile, speaks = HURRIED, (1.0, 1.2, 1.4, 2.15)


class Waits(Listens):
    """Wants a message each 0.2 s."""

    profile = HURRIED


class Manual(Speaks):
    """Is alive when it says so."""

    profile, speaks, asserts = BY_HAND, (1.5, 4.0), (1.8, 3.0)


class SloppyManual(Speaks):
    """Says so where no one receives it."""

    profile, speaks, asserts = SLOPPY_BY_HAND, (1.5,), (1.8,)


class Cares(Listens):
    """Wants a sign of life each 0.5 s."""

    profile = BY_HAND


class CaresLittle(Listens):
    """The same on best effort."""

    profile = SLOPPY_BY_HAND


class CaresLonger(Listens):
    """Wants a sign of life each second, of any kind."""

    profile = LEASED


class Steady(Speaks):
    """Publishes ten times a second, and is alive as long as it is there."""

    profile, speaks = LEASED, tuple(tick / 10 for tick in range(1, 30))


def steady_for_a_while():
    """The same, and ends at 1.5 s."""
    rclpy.init()
    node = Steady()
    end = node.get_clock().now() + Duration(seconds=1.5)
    while node.get_clock().now() < end:
        rclpy.spin_once(node, timeout_sec=0.1)


class StopsTheRobot(Node):
    """Passes commands on, and stops the robot when the last one is older than 0.3 s."""

    def __init__(self):
        super().__init__("watch")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        events = SubscriptionEventCallbacks(deadline=lambda event: self.publisher.publish(Twist()))
        profile = QoSProfile(depth=1, deadline=Duration(seconds=0.3))
        self.create_subscription(Twist, "joystick", self.publisher.publish, profile, event_callbacks=events)


class Joystick(Node):
    """Drives forward until 1 s, and is silent then."""

    def __init__(self):
        super().__init__("joystick")
        profile = QoSProfile(depth=1, deadline=Duration(seconds=0.25))
        self.publisher = self.create_publisher(Twist, "joystick", profile)
        self.timer = self.create_timer(0.2, self.tick)
        self.end = self.get_clock().now() + Duration(seconds=1.0)

    def tick(self):
        command = Twist()
        command.linear.x = 0.3
        self.publisher.publish(command)
        if self.get_clock().now() >= self.end:
            self.timer.cancel()


class Talker(Node):
    """Publishes 0, 1, 2, ... each half second; each message lives one second."""

    def __init__(self, profile=BRIEF):
        super().__init__("talker")
        publisher = self.create_publisher(Int32, "count", profile)
        self.count = 0
        self.create_timer(0.5, lambda: self.tick(publisher))

    def tick(self, publisher):
        publisher.publish(Int32(data=self.count))
        self.count += 1


def latched_talker():
    return Talker(BRIEF_LATCHED)


class Sleeper(Node):
    """Sleeps in its callbacks, so that messages wait."""

    profile = 10

    def __init__(self):
        super().__init__("sleeper")
        self.create_subscription(Int32, "count", self.on_message, self.profile)

    def on_message(self, msg):
        self.get_logger().info(f"received {msg.data}")
        time.sleep(1.75)


class BriefSleeper(Sleeper):
    """Wants nothing that is older than a second."""

    profile = BRIEF


def late():
    """Comes at 2.25 s."""
    time.sleep(2.25)
    rclpy.init()
    node = Node("late")
    receive = lambda msg: node.get_logger().info(f"received {msg.data}")  # noqa: E731
    node.create_subscription(Int32, "count", receive, BRIEF_LATCHED)
    rclpy.spin(node)


def offers(**policies):
    """A program that publishes on `count` with this QoS."""

    def publisher():
        node = Node("publisher")
        node.create_publisher(Int32, "count", QoSProfile(depth=10, **policies))
        return node

    return publisher


def wants(**policies):
    """A program that listens there with this QoS."""

    def subscriber():
        node = Node("subscriber")
        node.create_subscription(Int32, "count", lambda msg: None, QoSProfile(depth=10, **policies))
        return node

    return subscriber
