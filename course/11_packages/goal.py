"""A hall with three lanes for the lesson, and two robots in it as they drive at its end."""

from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

from sim import Process, Recording, World, run

WALL = 4.0  # m: where the wall ahead is; all robots start at 0
HALL = World.from_data(
    {
        "name": "hall",
        "card": "Picture: A hall with three lanes, a robot in each, and a wall ahead of them at x 4.",
        "start": [0.0, 0.0, 0.0],
        "bounds": [-0.5, -1.8, WALL, 1.8],
        "walls": [[[-0.5, 1.8], [WALL, 1.8], [WALL, -1.8], [-0.5, -1.8]]],
        "robots": [{"name": "left", "start": [0.0, 1.2, 0.0]}, {"name": "right", "start": [0.0, -1.2, 0.0]}],
    }
)


class Ahead(Node):
    """Drives towards a wall, and stops 1 m before it."""

    def __init__(self):
        super().__init__("ahead")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(LaserScan, "scan", self.on_scan, qos_profile_sensor_data)

    def on_scan(self, scan):
        """Slow down on the last meter."""
        command = Twist()
        command.linear.x = max(0.0, min(0.3, scan.ranges[0] - 1.0))
        self.publisher.publish(command)


def goal() -> Recording:
    """Two robots, one program."""
    left, right = (Process(Ahead, namespace=f"/{side}") for side in ("left", "right"))
    return run(left, right, world=HALL, seconds=20, quiet=True)
