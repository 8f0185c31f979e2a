"""Nodes for the exercise `hello`, named by what is special or wrong about them."""

import rclpy
from rclpy.node import Node


class Hello(Node):
    def __init__(self):
        super().__init__("hello")
        self.get_logger().info("Hello, robot!")


# Right


def function_that_makes_a_node():
    node = rclpy.create_node("greeter")
    node.get_logger().info("Hello, robot!")
    return node


def main_that_says_it(args=None):
    rclpy.init(args=args)
    node = Hello()
    rclpy.spin(node)


class SaysItInATimerThatStops(Node):
    def __init__(self):
        super().__init__("hello")
        self.timer = self.create_timer(1.0, self.say)

    def say(self):
        self.get_logger().info("hello, robot!")
        self.timer.cancel()


# Wrong


class Prints(Node):
    def __init__(self):
        super().__init__("hello")
        print("Hello, robot!")


class OtherText(Node):
    def __init__(self):
        super().__init__("hello")
        self.get_logger().info("Hello robot")


class DebugLevel(Node):
    def __init__(self):
        super().__init__("hello")
        self.get_logger().debug("Hello, robot!")


class WarningLevel(Node):
    def __init__(self):
        super().__init__("hello")
        self.get_logger().warning("Hello, robot!")


class AgainAndAgain(Node):
    def __init__(self):
        super().__init__("hello")
        self.create_timer(1.0, self.say)

    def say(self):
        self.get_logger().info("Hello, robot!")


class LoggerWithoutBrackets(Node):
    def __init__(self):
        super().__init__("hello")
        self.get_logger.info("Hello, robot!")


class MisspeltMethod(Node):
    def __init__(self):
        super().__init__("hello")
        self.get_loger().info("Hello, robot!")


class NoNode:
    def __init__(self):
        print("Hello, robot!")
