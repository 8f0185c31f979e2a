"""Nodes that hold their state in other ways: slots, dataclasses, enums, generators, properties, queues."""

import contextlib
import enum
import itertools
import queue
import threading
from dataclasses import dataclass, field
from typing import ClassVar, NamedTuple

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Int64, String


class Slotted:
    __slots__ = ("count", "last")

    def __init__(self):
        self.count, self.last = 0, None


class HasSlots(Node):
    def __init__(self):
        super().__init__("slots")
        self.state = Slotted()
        self.create_subscription(String, "chatter", self.receive, 10)

    def receive(self, message):
        self.state.count += 1
        self.state.last = message


@dataclass
class Settings:
    period: float = 0.2
    words: list[str] = field(default_factory=lambda: ["red", "green"])


@dataclass(eq=False)
class DataNode(Node):
    """A node that is a dataclass itself."""

    topic: str = "chatter"
    settings: Settings = field(default_factory=Settings)

    def __post_init__(self):
        super().__init__("data_node")
        self.words = itertools.cycle(self.settings.words)
        self.publisher = self.create_publisher(String, self.topic, 10)
        self.create_timer(self.settings.period, self.tick)

    def tick(self):
        self.publisher.publish(String(data=next(self.words)))


class Light(enum.Enum):
    RED = 0.4
    GREEN = 0.8
    YELLOW = 0.2

    @property
    def following(self):
        lights = list(Light)
        return lights[(lights.index(self) + 1) % len(lights)]


class TrafficLight(Node):
    """A state machine whose timer is made anew for each state."""

    def __init__(self):
        super().__init__("traffic_light")
        self.publisher = self.create_publisher(String, "light", 10)
        self.timer = None
        self.enter(Light.RED)

    def enter(self, light):
        if self.timer is not None:
            self.destroy_timer(self.timer)
        self.publisher.publish(String(data=light.name.lower()))
        self.timer = self.create_timer(light.value, lambda: self.enter(light.following))


class Sequence(Node):
    """Each tick resumes a generator, which waits by yielding."""

    def __init__(self):
        super().__init__("sequence")
        self.publisher = self.create_publisher(String, "light", 10)
        self.steps = self.script()
        self.timer = self.create_timer(0.1, self.tick)

    def script(self):
        for word in ("ready", "steady", "go"):
            self.publisher.publish(String(data=word))
            for _ in range(3):
                yield

    def tick(self):
        if next(self.steps, self) is self:
            self.timer.cancel()


class Reading(NamedTuple):
    stamp: float
    nearest: float


class NearestOf(Node):
    """Measures the robot's scans, and keeps the last ten."""

    last: ClassVar[list[Reading]] = []

    def __init__(self):
        super().__init__("nearest")
        self.create_subscription(LaserScan, "/scan", self.scan, 10)

    @property
    def nearest(self):
        return min((reading.nearest for reading in self.last), default=float("inf"))

    def scan(self, message):
        stamp = message.header.stamp
        self.last.append(Reading(stamp.sec + stamp.nanosec * 1e-9, min(message.ranges)))
        del self.last[:-10]


class Alarm(Node):
    """Publishes only when something is near, and nothing is."""

    def __init__(self):
        super().__init__("alarm")
        self.publisher = self.create_publisher(String, "alarm", 10)
        self.create_subscription(LaserScan, "/scan", self.scan, 10)

    def scan(self, message):
        if min(message.ranges) < 0.1:
            self.publisher.publish(String(data="near"))


class LateAlarm(Node):
    """The same, with a timer that looks at what the subscription has stored."""

    def __init__(self):
        super().__init__("late_alarm")
        self.nearest = float("inf")
        self.publisher = self.create_publisher(String, "alarm", 10)
        self.create_subscription(LaserScan, "/scan", self.scan, 10)
        self.create_timer(0.2, self.tick)

    def scan(self, message):
        self.nearest = min(message.ranges)

    def tick(self):
        if self.nearest > 0.1:
            return
        self.publisher.publish(String(data="near"))


class QueueWorker(Node):
    """The callback fills a queue; a thread of its own empties it."""

    def __init__(self):
        super().__init__("queue_worker")
        self.jobs = queue.Queue(maxsize=20)
        self.publisher = self.create_publisher(Int64, "length", 10)
        self.create_subscription(String, "light", self.jobs.put_nowait, 10)
        threading.Thread(target=self.work, daemon=True).start()

    def work(self):
        while (job := self.jobs.get()) is not None:
            self.publisher.publish(Int64(data=len(job.data)))


class Guarded(Node):
    """A lock around what two callbacks share."""

    def __init__(self):
        super().__init__("guarded")
        self.lock, self.total = threading.Lock(), 0
        self.create_subscription(String, "light", self.add, 10)
        self.publisher = self.create_publisher(Int64, "total", 10)
        self.create_timer(0.5, self.report)

    def add(self, message):
        with self.lock:
            self.total += len(message.data)

    def report(self):
        with self.lock:
            total = self.total
        self.publisher.publish(Int64(data=total))


@contextlib.contextmanager
def ros_node(name):
    rclpy.init()
    node = rclpy.create_node(name)
    try:
        yield node
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def with_a_context_manager():
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), ros_node("managed") as node:
        publisher = node.create_publisher(String, "light", 10)
        node.create_timer(0.5, lambda: publisher.publish(String(data="on")))
        rclpy.spin(node)


def with_an_exit_stack():
    with contextlib.ExitStack() as stack:
        rclpy.init()
        stack.callback(rclpy.try_shutdown)
        node = rclpy.create_node("stacked")
        stack.callback(node.destroy_node)
        publisher = node.create_publisher(String, "light", 10)
        for text in ("one", "two", "three"):
            publisher.publish(String(data=text))
            rclpy.spin_once(node, timeout_sec=0.2)


CORPUS = [
    (DataNode, HasSlots),
    (TrafficLight, Guarded),
    (Sequence, QueueWorker),
    (NearestOf,),
    (Alarm,),
    (LateAlarm,),
    (with_a_context_manager,),
    (with_an_exit_stack,),
]
