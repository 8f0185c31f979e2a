"""Publishers and subscriptions in other ways: QoS, raw bytes, statistics, transforms, filters, discovery."""

import rclpy
from geometry_msgs.msg import PointStamped, TransformStamped
from message_filters import ApproximateTimeSynchronizer, Subscriber, TimeSynchronizer
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import QoSPresetProfiles, QoSProfile, ReliabilityPolicy, qos_profile_sensor_data
from rclpy.serialization import deserialize_message, serialize_message
from rclpy.time import Time
from rosidl_runtime_py.utilities import get_message
from std_msgs.msg import Header, String
from tf2_ros import (
    Buffer,
    StaticTransformBroadcaster,
    TransformBroadcaster,
    TransformException,
    TransformListener,
)


class Reliable(Node):
    """Offers more than its subscriber requests, with deadlines that it meets."""

    def __init__(self):
        super().__init__("reliable")
        qos = QoSProfile(depth=5, reliability=ReliabilityPolicy.RELIABLE, deadline=Duration(seconds=1))
        events = PublisherEventCallbacks(deadline=self.late)
        self.publisher = self.create_publisher(String, "data", qos, event_callbacks=events)
        self.create_timer(0.2, lambda: self.publisher.publish(String(data="x")))

    def late(self, event):
        self.get_logger().error("late")


class TakesBestEffort(Node):
    def __init__(self):
        super().__init__("best_effort")
        events = SubscriptionEventCallbacks(deadline=lambda _: self.get_logger().error("late"))
        self.create_subscription(
            String, "data", self.receive, qos_profile_sensor_data, event_callbacks=events
        )
        self.create_subscription(String, "data", self.receive, QoSPresetProfiles.SYSTEM_DEFAULT.value)

    def receive(self, message):
        pass


class TakesBytes(Node):
    """Receives serialized messages, and looks into each tenth of them."""

    def __init__(self):
        super().__init__("bytes")
        self.size = self.count = 0
        self.create_subscription(String, "data", self.receive, 10, raw=True)

    def receive(self, data):
        self.size, self.count = self.size + len(data), self.count + 1
        if self.count % 10 == 0:
            self.get_logger().info(deserialize_message(data, String).data)


class Relay(Node):
    """Knows its types from their names only, and publishes bytes."""

    def __init__(self):
        super().__init__("relay")
        kind = get_message("std_msgs/msg/String")
        self.publisher = self.create_publisher(kind, "data_copy", 10)
        self.create_subscription(kind, "data", lambda it: self.publisher.publish(serialize_message(it)), 10)


class TakesInfo(Node):
    def __init__(self):
        super().__init__("info")
        self.create_subscription(String, "data", self.receive, 10)

    def receive(self, message, info):
        self.delay = info["received_timestamp"] - info["source_timestamp"]


class FindsItsTopics(Node):
    """Subscribes to each topic of a type, as soon as there is one."""

    def __init__(self):
        super().__init__("finder")
        self.known = {}
        self.create_timer(0.5, self.look)

    def look(self):
        for name, types in self.get_topic_names_and_types():
            if name not in self.known and types == ["std_msgs/msg/String"]:
                self.known[name] = self.create_subscription(String, name, lambda _: None, 10)


class PublishesOnDemand(Node):
    """Costly messages are made only for subscribers."""

    def __init__(self):
        super().__init__("on_demand")
        self.publisher = self.create_publisher(String, "costly", 10)
        self.create_timer(0.2, self.tick)

    def tick(self):
        if self.publisher.get_subscription_count() > 0:
            self.publisher.publish(String(data="costly"))


class OnChangeOnly(Node):
    """Publishes what has changed; nothing changes in the first seconds."""

    def __init__(self):
        super().__init__("on_change")
        self.state = "closed"
        self.publisher = self.create_publisher(String, "~/state", 1)
        self.publisher.publish(String(data=self.state))
        self.create_timer(0.1, self.look)

    def look(self):
        state = "closed" if self.get_clock().now().nanoseconds > 0 else "open"
        if state != self.state:
            self.state = state
            self.publisher.publish(String(data=state))


class PrivateNames(Node):
    """Private and absolute names, and parts of names."""

    def __init__(self):
        super().__init__("camera", namespace="head")
        self.outlets = [self.create_publisher(String, f"~/{part}/info", 10) for part in ("left", "right")]
        self.create_subscription(String, "/head/camera/left/info", lambda _: None, 10)
        self.create_timer(0.3, self.tick)

    def tick(self):
        for outlet in self.outlets:
            outlet.publish(String(data=outlet.topic))


class Broadcasts(Node):
    def __init__(self):
        super().__init__("broadcasts")
        self.fixed = StaticTransformBroadcaster(self)
        self.fixed.sendTransform(self.transform("base", "laser"))
        self.moving = TransformBroadcaster(self)
        self.create_timer(0.05, lambda: self.moving.sendTransform(self.transform("odom", "base")))

    def transform(self, parent, child):
        stamp = self.get_clock().now().to_msg()
        found = TransformStamped(header=Header(stamp=stamp, frame_id=parent), child_frame_id=child)
        found.transform.rotation.w = 1.0
        return found


class LooksUp(Node):
    """The first lookups fail, which it expects."""

    def __init__(self):
        super().__init__("looks_up")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.create_timer(0.1, self.tick)

    def tick(self):
        try:
            self.buffer.lookup_transform("odom", "laser", Time())
        except TransformException as error:
            self.get_logger().debug(str(error))


class PublishesPairs(Node):
    def __init__(self):
        super().__init__("pairs")
        self.outlets = [self.create_publisher(PointStamped, side, 10) for side in ("left", "right")]
        self.create_timer(0.2, self.tick)

    def tick(self):
        header = Header(stamp=self.get_clock().now().to_msg(), frame_id="map")
        for outlet in self.outlets:
            outlet.publish(PointStamped(header=header))


class Synchronizes(Node):
    def __init__(self):
        super().__init__("synchronizes")
        inlets = [Subscriber(self, PointStamped, side) for side in ("left", "right")]
        self.exact, self.near = TimeSynchronizer(inlets, 10), ApproximateTimeSynchronizer(inlets, 10, 0.05)
        self.pairs = 0
        for each in (self.exact, self.near):
            each.registerCallback(self.pair)

    def pair(self, left, right):
        self.pairs += 1


def stops_listening():
    """Destroys its subscription after three messages, and goes on with the rest."""
    rclpy.init()
    node = rclpy.create_node("enough")
    taken = []

    def receive(message):
        taken.append(message)
        if len(taken) == 3:
            node.destroy_subscription(subscription)

    subscription = node.create_subscription(String, "data", receive, 10)
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, rclpy.executors.ExternalShutdownException):
        node.destroy_node()


CORPUS = [
    (Reliable, TakesBestEffort),
    (Reliable, TakesBytes),
    (Reliable, Relay),
    (Reliable, TakesInfo),
    (Reliable, FindsItsTopics),
    (Reliable, stops_listening),
    (PublishesOnDemand,),
    (OnChangeOnly,),
    (PrivateNames,),
    (Broadcasts, LooksUp),
    (PublishesPairs, Synchronizes),
]
