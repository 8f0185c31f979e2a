"""Nodes that are told of the other ends of their topics, and messages that expire."""

import time

import rclpy
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks, UnsupportedEventTypeError
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Int32

BRIEF = QoSProfile(depth=10, lifespan=Duration(seconds=1))
BRIEF_LATCHED = QoSProfile(
    depth=10, lifespan=Duration(seconds=1), durability=DurabilityPolicy.TRANSIENT_LOCAL
)
LEASED = QoSProfile(depth=1, liveliness_lease_duration=Duration(seconds=1))


class Watcher(Node):
    """Says who comes and goes at both ends: in all, now there. No lease of liveliness runs out here."""

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


class Deadline(Node):
    def __init__(self):
        super().__init__("deadline")
        events = SubscriptionEventCallbacks(deadline=lambda event: None)
        profile = QoSProfile(depth=1, deadline=Duration(seconds=1))
        self.create_subscription(Int32, "count", lambda msg: None, profile, event_callbacks=events)


class OfferedDeadline(Node):
    def __init__(self):
        super().__init__("offered")
        events = PublisherEventCallbacks(deadline=lambda event: None)
        self.create_publisher(Int32, "count", qos_profile=10, event_callbacks=events)


class Leased(Node):
    def __init__(self):
        super().__init__("leased")
        events = PublisherEventCallbacks(liveliness=lambda event: None)
        self.create_publisher(Int32, "count", qos_profile=LEASED, event_callbacks=events)


class Careful(Node):
    """As code for several middlewares does, it goes on without what isn't there."""

    def __init__(self):
        super().__init__("careful")
        events = SubscriptionEventCallbacks(liveliness=lambda event: None)
        try:
            self.create_subscription(Int32, "count", print, LEASED, event_callbacks=events)
        except UnsupportedEventTypeError:
            self.create_subscription(Int32, "count", self.hear, LEASED)
        self.publisher = self.create_publisher(Int32, "count", LEASED)
        self.create_timer(1.0, lambda: self.publisher.publish(Int32(data=1)))

    def hear(self, msg):
        self.get_logger().info(f"heard {msg.data}")


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

    def __init__(self):
        super().__init__("sleeper")
        self.create_subscription(Int32, "count", self.hear, 10)

    def hear(self, msg):
        self.get_logger().info(f"heard {msg.data}")
        time.sleep(1.75)


def late():
    """Comes at 2.25 s."""
    time.sleep(2.25)
    rclpy.init()
    node = Node("late")
    hear = lambda msg: node.get_logger().info(f"heard {msg.data}")  # noqa: E731
    node.create_subscription(Int32, "count", hear, BRIEF_LATCHED)
    rclpy.spin(node)
