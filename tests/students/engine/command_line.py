"""Programs with words on their command line, and with lines typed at their keyboard."""

import argparse
import sys
import termios

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node
from rclpy.utilities import remove_ros_args


def reads_words(args=None):
    """The classic client: its two numbers are words of the command line."""
    rclpy.init(args=args)
    node = Node("reader")
    request = AddTwoInts.Request(a=int(sys.argv[1]), b=int(sys.argv[2]))
    node.get_logger().info(f"{request.a} + {request.b}")


def shows_words():
    """All the words there are, then those that are not ROS's."""
    rclpy.init()
    node = Node("shows")
    node.get_logger().info(" ".join(sys.argv))
    node.get_logger().info(" ".join(remove_ros_args()))


def parses_words():
    rclpy.init()
    parser = argparse.ArgumentParser()
    parser.add_argument("--speed", type=float, default=0.1)
    speed = parser.parse_args(remove_ros_args()[1:]).speed
    node = Node("parser")
    node.create_timer(0.5, lambda: node.get_logger().info(f"speed {speed}"))
    rclpy.spin(node)


def changes_words():
    """What it writes into its words stays its own, also while others run."""
    sys.argv.insert(1, "mine")
    rclpy.init()
    node = Node("changes")
    node.create_timer(0.5, lambda: node.get_logger().info(" ".join(sys.argv)))
    rclpy.spin(node)


def no_ros_words():
    """An empty command line, whatever the program was started with."""
    rclpy.init(args=[])
    Node("plain").get_logger().info("here")


def asks():
    """Asks until no one answers any more."""
    rclpy.init()
    node = Node("asks")
    try:
        while True:
            node.get_logger().info(input("word? "))
    except EOFError as error:
        node.get_logger().info(str(error))


def asks_now_and_then():
    rclpy.init()
    node = Node("asks_now")
    node.create_timer(0.5, lambda: node.get_logger().info(input()))
    rclpy.spin(node)


def reads_stdin():
    rclpy.init()
    node = Node("reads")
    for line in sys.stdin:
        node.get_logger().info(repr(line))


def reads_keys():
    """As teleop programs do."""
    termios.tcgetattr(sys.stdin)
