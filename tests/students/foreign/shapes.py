"""Nodes whose parts are not in one class: mixins, functions, decorators, generated classes."""

import abc
import contextlib
import functools
from typing import Protocol

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import Bool, Int64, String


class LogsMixin:
    def log(self, text):
        self.get_logger().info(f"{self.get_name()}: {text}")


class BeatsMixin:
    period = 0.25

    def start_beating(self):
        self._timer = self.create_timer(self.period, self.beat)

    def beat(self):
        raise NotImplementedError


class PublishesMixin:
    topic = "chatter"

    @functools.cached_property
    def out(self):
        return self.create_publisher(String, self.topic, 10)


class MixedTalker(LogsMixin, BeatsMixin, PublishesMixin, Node):
    """All that it does is inherited, and its publisher is made by the first message."""

    def __init__(self):
        super().__init__("mixed")
        self.start_beating()

    def beat(self):
        self.out.publish(String(data="beat"))


class Template(Node, abc.ABC):
    def __init__(self, name):
        super().__init__(name)
        self.inlet = self.create_subscription(String, "chatter", self._receive, 10)
        self.outlet = self.create_publisher(String, f"{name}/text", 10)

    def _receive(self, message):
        if (text := self.convert(message.data)) is not None:
            self.outlet.publish(String(data=text))

    @abc.abstractmethod
    def convert(self, text):
        """The text to publish, or None."""


class Upper(Template):
    def __init__(self):
        super().__init__("upper")

    def convert(self, text):
        return text.upper()


def subscribes(kind, topic):
    """Marks a method as the callback of a topic."""

    def mark(method):
        method.subscribes = kind, topic
        return method

    return mark


class Decorated(Node):
    """Its subscriptions are made of the marks on its methods."""

    def __init__(self):
        super().__init__("decorated")
        for name in dir(type(self)):
            kind, topic = getattr(getattr(type(self), name), "subscribes", (None, ""))
            if kind is not None:
                self.create_subscription(kind, topic, getattr(self, name), 10)

    @subscribes(String, "chatter")
    def on_text(self, message):
        self.get_logger().info(message.data)

    @subscribes(Bool, "alarm")
    def on_alarm(self, message):
        self.get_logger().warning(str(message.data))


def _generated_init(self):
    Node.__init__(self, "generated")
    for topic, period in (("left", 0.2), ("right", 0.4)):
        publisher = self.create_publisher(Int64, topic, 10)
        self.create_timer(period, lambda p=publisher, t=topic: p.publish(Int64(data=len(t))))


Generated = type("Generated", (Node,), {"__init__": _generated_init, "__doc__": "A class without a body."})


class Partials(Node):
    def __init__(self):
        super().__init__("partials")
        self.counts = dict.fromkeys(("left", "right"), 0)
        for side in self.counts:
            self.create_subscription(Int64, side, functools.partial(self.count, side=side), 10)

    def count(self, message, *, side):
        self.counts[side] += message.data


class Lambdas(Node):
    """Keeps each last message by itself; nothing is published or logged."""

    def __init__(self):
        super().__init__("lambdas")
        self.last = {}
        self.create_subscription(Int64, "left", lambda it: self.last.update(left=it.data), 10)
        self.create_subscription(Int64, "right", lambda it: self.last.update(right=it.data), 10)


class Port(Protocol):
    def send(self, text: str) -> None: ...


class RosPort:
    """The only part of the program that knows ROS."""

    def __init__(self, node: Node) -> None:
        self._publisher = node.create_publisher(String, "chatter", 10)

    def send(self, text: str) -> None:
        self._publisher.publish(String(data=text))


class Greeter:
    def __init__(self, port: Port) -> None:
        self.port, self.greeted = port, 0

    def greet(self) -> None:
        self.greeted += 1
        self.port.send(f"hello {self.greeted}")


def composed() -> None:
    """A node without a class of its own; the program's objects are given to each other."""
    rclpy.init()
    node = rclpy.create_node("composed")
    node.create_timer(0.3, Greeter(RosPort(node)).greet)
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(node)


class Application:
    """The node is an attribute, and main() is a static method."""

    def __init__(self):
        self.node = Node("application")
        self.publisher = self.node.create_publisher(String, "chatter", 10)
        self.timer = self.node.create_timer(0.5, self)

    def __call__(self):
        self.publisher.publish(String(data="called"))

    @staticmethod
    def main():
        rclpy.init()
        application = Application()
        try:
            rclpy.spin(application.node)
        except (KeyboardInterrupt, ExternalShutdownException):
            pass
        finally:
            application.node.destroy_node()
            rclpy.try_shutdown()


class OneOnly(Node):
    """There is only one instance of it."""

    _instance = None

    def __new__(cls):
        if cls._instance is None:
            cls._instance = super().__new__(cls)
        return cls._instance

    def __init__(self):
        super().__init__("one_only")
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.create_timer(0.4, self.tick)

    def tick(self):
        OneOnly._instance.publisher.publish(String(data="one"))


def closures():
    """Nested functions share their variables by nonlocal."""
    count = 0
    rclpy.init()
    node = rclpy.create_node("closures")
    publisher = node.create_publisher(Int64, "left", 10)

    def tick():
        nonlocal count
        count += 1
        publisher.publish(Int64(data=count))
        if count == 5:
            timer.cancel()

    timer = node.create_timer(0.1, tick)
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(node)


CORPUS = [
    (MixedTalker, Upper),
    (MixedTalker, Decorated),
    (Generated, Partials),
    (Generated, Lambdas),
    (composed,),
    (Application.main,),
    (OneOnly,),
    (closures, Lambdas),
]
