"""main() functions for the exercise `whole_main`, named by what is special or wrong about them."""

import contextlib

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node

PARTS = ("Countdown", "clean_up")


class Countdown(Node):
    """As the notebook gives it."""

    def __init__(self):
        super().__init__("countdown")
        self.left = 3
        self.create_timer(1.0, self.tick)

    def tick(self):
        if self.left == 0:
            raise KeyboardInterrupt
        self.get_logger().info(f"{self.left}")
        self.left -= 1


def clean_up(node):
    node.get_logger().info("Engine off")
    node.destroy_node()
    rclpy.shutdown()


# Right


def with_suppress(args=None):
    rclpy.init(args=args)
    node = Countdown()
    with contextlib.suppress(KeyboardInterrupt):
        rclpy.spin(node)
    clean_up(node)


def with_an_executor(args=None):
    rclpy.init(args=args)
    executor = SingleThreadedExecutor()
    node = Countdown()
    executor.add_node(node)
    try:
        executor.spin()
    except KeyboardInterrupt:
        node.get_logger().info("Engine off!")
    finally:
        executor.shutdown()
        node.destroy_node()
        rclpy.try_shutdown()


def with_a_loop():
    rclpy.init()
    try:
        node = Countdown()
        while rclpy.ok():
            rclpy.spin_once(node, timeout_sec=0.1)
    except KeyboardInterrupt:
        clean_up(node)


# Wrong


def without_spin(args=None):
    rclpy.init(args=args)
    clean_up(Countdown())


def without_spin_or_try(args=None):
    """Lesson 1's first one."""
    rclpy.init(args=args)
    node = Countdown()
    node.destroy_node()
    rclpy.shutdown()


def careless(args=None):
    """Lesson 1's second one."""
    rclpy.init(args=args)
    node = Countdown()
    rclpy.spin(node)
    node.get_logger().info("Engine off")
    rclpy.shutdown()


def without_init():
    node = Countdown()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        clean_up(node)


def without_try(args=None):
    rclpy.init(args=args)
    node = Countdown()
    rclpy.spin(node)
    clean_up(node)


def without_except(args=None):
    rclpy.init(args=args)
    node = Countdown()
    try:
        rclpy.spin(node)
    finally:
        clean_up(node)


def without_shutdown(args=None):
    rclpy.init(args=args)
    node = Countdown()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.get_logger().info("Engine off")
        node.destroy_node()


def without_destroy(args=None):
    rclpy.init(args=args)
    node = Countdown()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.get_logger().info("Engine off")
        rclpy.shutdown()


def engine_off_too_early(args=None):
    rclpy.init(args=args)
    node = Countdown()
    node.get_logger().info("Engine off")
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.shutdown()


def engine_stays_on(args=None):
    rclpy.init(args=args)
    node = Countdown()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        node.destroy_node()
        rclpy.shutdown()


def prints_engine_off(args=None):
    rclpy.init(args=args)
    node = Countdown()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        print("Engine off")
        node.destroy_node()
        rclpy.shutdown()


def never_ends(args=None):
    rclpy.init(args=args)
    node = Countdown()
    while rclpy.ok():
        with contextlib.suppress(KeyboardInterrupt):
            rclpy.spin_once(node)


def shuts_down_twice(args=None):
    rclpy.init(args=args)
    node = Countdown()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        rclpy.shutdown()
    finally:
        clean_up(node)


def two_nodes(args=None):
    rclpy.init(args=args)
    node, other = Countdown(), Countdown()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    executor.add_node(other)
    with contextlib.suppress(KeyboardInterrupt):
        executor.spin()
    clean_up(node)


def as_in_the_lesson(args=None):
    """Right, too: it ends quietly on Ctrl-C and on kill."""
    rclpy.init(args=args)
    node = Countdown()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.get_logger().info("Engine off")
        node.destroy_node()
        rclpy.try_shutdown()
