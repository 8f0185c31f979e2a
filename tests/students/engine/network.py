"""Programs of several hosts, which talk through a network."""

import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import Int32

BEST_EFFORT = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
LATCHED = QoSProfile(depth=3, durability=DurabilityPolicy.TRANSIENT_LOCAL)
BRIEF = QoSProfile(depth=10, lifespan=Duration(seconds=0.5))
ALL = QoSProfile(history=HistoryPolicy.KEEP_ALL)


class Counter(Node):
    """Publishes 1, 2, 3, ... on /count, ten times a second."""

    qos, last = 10, 10_000

    def __init__(self):
        super().__init__("counter")
        self.publisher = self.create_publisher(Int32, "count", self.qos)
        self.count = 0
        self.create_timer(0.1, self.tick)

    def tick(self):
        if self.count < self.last:
            self.count += 1
            self.publisher.publish(Int32(data=self.count))


class Listener(Node):
    """Says what comes on /count."""

    qos = 1000

    def __init__(self):
        super().__init__("listener")
        self.create_subscription(Int32, "count", self.on_message, self.qos)

    def on_message(self, msg):
        self.get_logger().info(str(msg.data))


class SloppyCounter(Counter):
    """Cares for no message that is lost."""

    qos = BEST_EFFORT


class SloppyListener(Listener):
    """Receives what comes."""

    qos = BEST_EFFORT


class OneWord(Counter):
    """Says one thing and no more."""

    last = 1


class DeepCounter(Counter):
    """Keeps fifty messages."""

    qos = 50


class ShallowCounter(Counter):
    """Keeps two messages."""

    qos = 2


class BriefCounter(Counter):
    """What it says is worth nothing after half a second."""

    qos = BRIEF


class BriefListener(Listener):
    """Wants nothing that is older than half a second."""

    qos = BRIEF


class LatchingCounter(Counter):
    """Says five things, and latches the last three."""

    qos, last = LATCHED, 5


class LateListener(Node):
    """Listens from 2 s on."""

    def __init__(self):
        super().__init__("late")
        self.timer = self.create_timer(2.0, self.begin)

    def begin(self):
        self.timer.cancel()
        self.create_subscription(Int32, "count", self.on_message, LATCHED)

    def on_message(self, msg):
        self.get_logger().info(str(msg.data))


class KeepsAll(Node):
    """Publishes without a limit at 1 s, until it is refused."""

    def __init__(self):
        super().__init__("keeper")
        self.publisher = self.create_publisher(Int32, "count", ALL)
        self.timer = self.create_timer(1.0, self.flood)

    def flood(self):
        self.timer.cancel()
        for number in range(1, 6000):
            try:
                self.publisher.publish(Int32(data=number))
            except Exception as error:
                self.get_logger().info(f"{number}: {type(error).__name__} {error}")
                return


class ReceivesAll(Listener):
    """Has room for all."""

    qos = ALL


class AsksWhetherAllHaveIt(Counter):
    """Publishes once, and waits until that has come, for a second and then for long."""

    def tick(self):
        if not self.count:
            super().tick()
            for seconds in (1, 10):
                done = self.publisher.wait_for_all_acked(Duration(seconds=seconds))
                self.get_logger().info(f"all have it: {done}")


def speaks_and_leaves():
    """Publishes once, at 0.1 s, and ends."""
    rclpy.init()
    node = Counter()
    while not node.count:
        rclpy.spin_once(node)


def listens_for_a_moment():
    """Listens until 0.15 s."""
    rclpy.init()
    node = Listener()
    end = node.get_clock().now() + Duration(seconds=0.15)
    while node.get_clock().now() < end:
        rclpy.spin_once(node, timeout_sec=0.05)
