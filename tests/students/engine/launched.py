"""A program that a launch file starts, twice; the second time it doesn't live long."""

import sys
from pathlib import Path

import rclpy
from rclpy.node import Node
from std_msgs.msg import String

twice = Path(__file__).with_name("twice.launch.py")


class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.create_timer(0.4, self.say)
        self.create_subscription(String, "/one/chatter", self.on_message, 10)

    def say(self):
        self.publisher.publish(String(data=self.get_namespace()))

    def on_message(self, message):
        if "dies" in sys.argv:
            raise RuntimeError(f"received {message.data}")
        self.get_logger().info(f"received {message.data}")


def main():
    rclpy.init()
    try:
        rclpy.spin(Talker())
    except KeyboardInterrupt:
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
