"""Executors of the student's own, built on rclpy's base class as its documentation says."""

import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial

import rclpy
from rclpy.executors import (
    Executor,
    ShutdownException,
    TimeoutException,
)
from rclpy.node import Node
from std_msgs.msg import Int32


class Ticking(Node):
    """Ticks every 0.5 s, for so many seconds each, and learns of it; has one coroutine callback, too."""

    def __init__(self, name, seconds=0.0):
        super().__init__(name)
        self.seconds = seconds
        self.publisher = self.create_publisher(Int32, "count", 10)
        self.create_subscription(Int32, "count", self.on_message, 10)
        self.create_timer(0.5, self.tick)

    def tick(self):
        time.sleep(self.seconds)
        self.get_logger().info("tick")
        self.publisher.publish(Int32(data=1))

    async def on_message(self, message):
        self.get_logger().info("received")


class OneByOne(Executor):
    """Runs each callback itself."""

    def spin_once(self, timeout_sec=None):
        try:
            handler, _, _ = self.wait_for_ready_callbacks(timeout_sec=timeout_sec)
        except (TimeoutException, ShutdownException):
            return
        handler()
        if handler.exception() is not None:
            raise handler.exception()


class Priorities(Executor):
    """What the urgent nodes do never waits for what the others do."""

    def __init__(self, urgent):
        super().__init__()
        self.urgent = urgent
        self.fast, self.slow = ThreadPoolExecutor(1), ThreadPoolExecutor(1)
        self.add_node(urgent)

    def spin_once(self, timeout_sec=None):
        handler, _, node = self.wait_for_ready_callbacks(timeout_sec=timeout_sec)
        (self.fast if node is self.urgent else self.slow).submit(handler)


def one_by_one():
    rclpy.init()
    executor = OneByOne()
    executor.add_node(Ticking("ticking"))
    executor.spin()


def priorities():
    rclpy.init()
    executor = Priorities(Ticking("urgent"))
    executor.add_node(Ticking("patient", seconds=0.7))
    executor.spin()


def raises():
    rclpy.init()
    executor, node = OneByOne(), Node("raising")
    node.create_timer(0.5, lambda: 1 / 0)
    executor.add_node(node)
    executor.spin()


def all_ends():
    """What ends its waiting: time-outs, also when other nodes have work; a condition; two shutdown()."""
    rclpy.init()
    node = Node("waiting")
    def say_why(executor, *arguments):
        try:
            executor.wait_for_ready_callbacks(*arguments)
        except Exception as end:
            node.get_logger().info(type(end).__name__)

    say_why(OneByOne(), 0.25)
    say_why(OneByOne(), 0)
    executor = OneByOne()
    executor.add_node(Ticking("ticking"))
    say_why(executor, 0.75, [node])
    say_why(executor, None, [node], lambda: True)
    executor.shutdown()
    say_why(executor)
    another = OneByOne()
    rclpy.shutdown()
    say_why(another)


def spins_once_each_time():
    """Both timers are due at every look: with an equal timeout it goes on, with another it begins anew."""
    rclpy.init()
    node = Node("often")
    for name in ("first", "second"):
        node.create_timer(0.001, partial(node.get_logger().info, name))
    for timeout in (1.0, 2.0, 3.0, 4.0, 4.0, 4.0):
        time.sleep(0.25)
        rclpy.spin_once(node, timeout_sec=timeout)
