"""Nodes for the exercise `counter`, named by what is special or wrong about them."""

import asyncio
import itertools
import threading
import time

import rclpy
from rclpy.node import Node


class Counter(Node):
    """Nothing is wrong with it; the wrong ones change one thing each."""

    name, period, text, step = "counter", 0.5, "Count: {}", 1
    count = 0

    def __init__(self):
        super().__init__(self.name)
        self.create_timer(self.period, self.tick)

    def tick(self):
        self.count += self.step
        self.get_logger().info(self.text.format(self.count))


# Right


def node_with_a_lambda():
    node, numbers = Node("counter"), itertools.count(1)
    node.create_timer(0.5, lambda: node.get_logger().info(f"Count: {next(numbers)}"))
    return node


def main_with_a_rate(args=None):
    rclpy.init(args=args)
    node = Node("counter")
    rate = node.create_rate(2.0)
    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
    for number in itertools.count(1):
        rate.sleep()
        node.get_logger().info(f"Count: {number}")


def main_with_everything_global(args=None):
    def tick():
        nonlocal count
        count += 1
        node.get_logger().info("Count: %d" % count)  # noqa: UP031

    count = 0
    rclpy.init(args=args)
    node = rclpy.create_node("counter")
    node.create_timer(0.5, tick)
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        node.destroy_node()
        rclpy.try_shutdown()


class SaysMoreThanItMust(Counter):
    def __init__(self):
        super().__init__()
        self.get_logger().info("Here we go")


# Wrong


class OtherName(Counter):
    name = "my_counter"


class FromZero(Counter):
    count = -1


class StepOfTwo(Counter):
    step = 2


class OnceASecond(Counter):
    period = 1.0


class OtherText(Counter):
    text = "{}. count"


class Prints(Counter):
    def tick(self):
        self.count += 1
        print(f"Count: {self.count}")


class Warns(Counter):
    def tick(self):
        self.count += 1
        self.get_logger().warning(f"Count: {self.count}")


class ForgetsTheCount(Counter):
    def tick(self):
        count = 0
        count += 1
        self.get_logger().info(f"Count: {count}")


class CountNeverSet(Node):
    def __init__(self):
        super().__init__("counter")
        self.create_timer(0.5, self.tick)

    def tick(self):
        self.count += 1
        self.get_logger().info(f"Count: {self.count}")


class CallsTheCallback(Counter):
    def __init__(self):
        Node.__init__(self, "counter")
        self.create_timer(0.5, self.tick())


class CallsTheCallbackAtOnce(Node):
    """Lesson 1's: with parentheses."""

    def __init__(self):
        super().__init__("counter")
        self.create_timer(0.5, self.tick())

    def tick(self):
        self.get_logger().info("Count: 1")


class AllAtOnce(Counter):
    def __init__(self):
        Node.__init__(self, "counter")
        for _ in range(8):
            self.tick()


class SleepsInTheCallback(Counter):
    def tick(self):
        super().tick()
        time.sleep(1.0)


class CountsOnce(Counter):
    def __init__(self):
        Node.__init__(self, "counter")
        self.tick()


class StopsAfterThree(Counter):
    def __init__(self):
        Node.__init__(self, "counter")
        self.timer = self.create_timer(0.5, self.tick)

    def tick(self):
        super().tick()
        if self.count == 3:
            self.timer.cancel()


class UnevenTimers(Counter):
    def __init__(self):
        super().__init__()
        self.create_timer(0.8, self.tick)


class WithoutTimer(Node):
    def __init__(self):
        super().__init__("counter")
        self.count = 0

    def tick(self):
        self.count += 1
        self.get_logger().info(f"Count: {self.count}")


def main_without_spin(args=None):
    rclpy.init(args=args)
    node = Counter()
    node.destroy_node()
    rclpy.shutdown()


class LoopsInInit(Node):
    """Never comes out of its __init__: no one can spin it."""

    def __init__(self):
        super().__init__("counter")
        self.loop()

    def loop(self):
        for number in itertools.count(1):
            time.sleep(0.5)
            self.get_logger().info(f"Count: {number}")


def main_beside_asyncio(args=None):
    """Right, too: asyncio drives rclpy in small steps."""

    async def spinning(node):
        while rclpy.ok():
            rclpy.spin_once(node, timeout_sec=0.0)
            await asyncio.sleep(0.02)

    rclpy.init(args=args)
    asyncio.run(spinning(Counter()))
