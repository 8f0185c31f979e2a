"""A robot of five programs, all of which run without an error, but four of its connections are silent."""

from geometry_msgs.msg import Twist
from nav_msgs.msg import OccupancyGrid
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Float32


class Lidar(Node):
    """Offers best effort."""

    def __init__(self):
        super().__init__("lidar")
        self.publisher = self.create_publisher(LaserScan, "/scan", qos_profile_sensor_data)
        self.create_timer(0.1, lambda: self.publisher.publish(LaserScan()))


class MapServer(Node):
    """Stores nothing for late joiners."""

    def __init__(self):
        super().__init__("map_server")
        self.publisher = self.create_publisher(OccupancyGrid, "/map", 1)
        self.create_timer(1.0, lambda: self.publisher.publish(OccupancyGrid()))


class Battery(Node):
    """Publishes in a namespace."""

    def __init__(self):
        super().__init__("battery", namespace="robot1")
        self.publisher = self.create_publisher(Float32, "level", 10)
        self.create_timer(1.0, lambda: self.publisher.publish(Float32(data=0.8)))


class Navigator(Node):
    """Subscribes to all of them and drives."""

    def __init__(self):
        super().__init__("navigator")
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(LaserScan, "/scan", lambda msg: None, 10)
        self.create_subscription(OccupancyGrid, "/map", lambda msg: None, latched)
        self.create_subscription(Float32, "/level", lambda msg: None, 10)
        self.publisher = self.create_publisher(Twist, "/cmd_val", 10)
        self.create_timer(0.1, lambda: self.publisher.publish(Twist()))


class Motor(Node):
    """Waits for commands."""

    def __init__(self):
        super().__init__("motor")
        self.create_subscription(Twist, "/cmd_vel", lambda msg: None, 10)


ROBOT = Lidar, MapServer, Battery, Navigator, Motor
