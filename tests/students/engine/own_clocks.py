"""Nodes that would set the time themselves."""

from rclpy.clock import ROSClock
from rclpy.node import Node
from rclpy.time import Time
from rosgraph_msgs.msg import Clock


class Publishes(Node):
    def __init__(self):
        super().__init__("publishes")
        self.create_publisher(Clock, "/clock", 10)


class Overrides(Node):
    def __init__(self):
        super().__init__("overrides")
        clock = ROSClock()
        clock.set_ros_time_override(Time(seconds=5, clock_type=clock.clock_type))
