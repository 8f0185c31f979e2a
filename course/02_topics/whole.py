"""The goals of lesson 2: a boss that publishes words, and walkers that turn words into velocities."""

import math

from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node
from std_msgs.msg import String


class Boss(Node):
    """Publishes one word every two seconds."""

    def __init__(self):
        super().__init__("boss")
        self.publisher = self.create_publisher(String, "/robot/command", 10)
        self.words = ["walk", "stop", "left", "walk"]
        self.create_timer(2.0, self.speak)

    def speak(self):
        """Publish the next word if there is one left."""
        if self.words:
            self.publisher.publish(String(data=self.words.pop(0)))


class Walker(Node):
    """Drives as the last word says."""

    def __init__(self):
        super().__init__("walker")
        self.velocities = {"walk": (0.4, 0.0), "left": (0.0, math.pi / 4), "stop": (0.0, 0.0)}
        self.speed, self.turn = 0.0, 0.0
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(String, "/robot/command", self.obey, 10)
        self.create_timer(0.1, self.drive)

    def obey(self, msg):
        """Set the speed and the turning rate that the word stands for."""
        self.get_logger().info(msg.data)
        self.speed, self.turn = self.velocities[msg.data]

    def drive(self):
        """Publish the velocities, ten times a second: a robot stops when commands stop arriving."""
        msg = Twist()
        msg.linear.x, msg.angular.z = self.speed, self.turn
        self.publisher.publish(msg)


class CarefulWalker(Walker):
    """A walker that stops 2 m from its start."""

    def __init__(self):
        super().__init__()
        self.create_subscription(Odometry, "/odom", self.look, 10)

    def look(self, msg):
        """Stop when odometry says that the robot is far enough away."""
        position = msg.pose.pose.position
        if math.hypot(position.x, position.y) > 2.0:
            self.speed = 0.0
