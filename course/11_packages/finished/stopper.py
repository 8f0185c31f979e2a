"""Drives ahead, and stops before a wall."""
import signal
import time

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.signals import SignalHandlerOptions
from sensor_msgs.msg import LaserScan

from my_robot.brakes import GAP, ahead, speed_for


class Stopper(Node):
    def __init__(self):
        super().__init__("stopper")
        self.declare_parameter("speed", 0.3)  # m/s
        self.declare_parameter("gap", GAP)  # m
        self.commands = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(LaserScan, "scan", self.on_scan, qos_profile_sensor_data)
        self.get_logger().info(f"I stop {self.get_parameter('gap').value} m before a wall")

    def on_scan(self, scan):
        fastest, gap = self.get_parameter("speed").value, self.get_parameter("gap").value
        command = Twist()
        command.linear.x = speed_for(ahead(scan), fastest, gap)
        self.commands.publish(command)


def main(args=None):
    rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    node = Stopper()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.commands.publish(Twist())  # zeros: stand still
        time.sleep(0.2)  # so that they get there
        node.destroy_node()
        rclpy.try_shutdown()
