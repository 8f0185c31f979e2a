"""Loops without a pause. On a robot they work, as others of their program go on, and keep a core busy."""

import sys
import threading
import time

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.time import Time
from std_msgs.msg import Int32


class Flagged(Node):
    """What the others are built on: a publisher that sends at 10 Hz, and a flag that is set after 1.5 s."""

    def __init__(self):
        super().__init__("busy")
        self.publisher = self.create_publisher(Int32, "data", 10)
        self.create_timer(0.1, lambda: self.publisher.publish(Int32()))
        self.flag = False
        self.timer = self.create_timer(1.5, self.set_flag)

    def set_flag(self):
        self.timer.cancel()
        self.flag = True


class Working(Flagged):
    """One that does its work in a thread."""

    def __init__(self):
        super().__init__()
        threading.Thread(target=self.work, daemon=True).start()


class LooksInThread(Working):
    def work(self):
        while not self.flag:
            pass
        self.get_logger().info("seen")


class LooksThroughALibrary(Working):
    """Almost all of its time passes in code that is not the student's."""

    def work(self):
        while not self.flag:
            Time(seconds=1.0).to_msg()
        self.get_logger().info("seen")


class LoopsForEver(Working):
    def work(self):
        while True:
            pass


class Publishes(Working):
    def work(self):
        while not self.flag:
            self.publisher.publish(Int32(data=1))
        self.get_logger().info("seen")


class PublishesInACallback(Flagged):
    def set_flag(self):
        while True:
            self.publisher.publish(Int32(data=1))


class Prints(Working):
    def work(self):
        while not self.flag:
            print("waiting")
        self.get_logger().info("seen")


class Logs(Working):
    def work(self):
        while not self.flag:
            self.get_logger().info("waiting")
        self.get_logger().info("seen")


class Complains(Working):
    def work(self):
        while not self.flag:
            print("waiting", file=sys.stderr)
        self.get_logger().info("seen")


class SleepsForNoTime(Working):
    def work(self):
        while not self.flag:
            time.sleep(0)
        self.get_logger().info("seen")


def spins_without_waiting():
    rclpy.init()
    node = Flagged()
    while not node.flag:
        rclpy.spin_once(node, timeout_sec=0)
    node.get_logger().info("seen")


def looks_in_main():
    rclpy.init()
    node = Flagged()
    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
    while not node.flag:
        pass
    node.get_logger().info("seen")


def two_that_look():
    """Both wait for the same, and neither for the other."""
    rclpy.init()
    node = LooksInThread()
    threading.Thread(target=node.work, daemon=True).start()
    rclpy.spin(node)


def asks_for_answers():
    """Waits for the answer of a service of its own in a reentrant callback, once a second."""
    rclpy.init()
    node, group = Flagged(), ReentrantCallbackGroup()

    def add(request, response):
        response.sum = request.a + request.b
        return response

    def ask():
        future = client.call_async(AddTwoInts.Request(a=1, b=2))
        while not future.done():
            pass
        node.get_logger().info(str(future.result().sum))

    node.create_service(AddTwoInts, "add", add)
    client = node.create_client(AddTwoInts, "add", callback_group=group)
    node.create_timer(1.0, ask, callback_group=group)
    executor = MultiThreadedExecutor()
    executor.add_node(node)
    executor.spin()


class TenKilohertz(Node):
    def __init__(self):
        super().__init__("fast")
        publisher = self.create_publisher(Int32, "data", 10)
        self.create_timer(0.0001, lambda: publisher.publish(Int32()))


def sleeps_too_shortly():
    rclpy.init()
    node = Node("fast")
    publisher = node.create_publisher(Int32, "data", 10)
    while rclpy.ok():
        publisher.publish(Int32())
        time.sleep(0.00005)
