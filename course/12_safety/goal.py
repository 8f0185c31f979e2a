"""The emergency stop of the goal: it stays stopped until it is reset."""

from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_msgs.msg import Bool
from std_srvs.srv import Trigger


class Latch(Node):
    """Sits between /cmd_vel_raw and /cmd_vel; /emergency (Bool) stops it, /reset (Trigger) releases it."""

    def __init__(self):
        super().__init__("latch")
        self.stopped = False
        self.commands = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(Bool, "/emergency", self.on_button, 10)
        self.create_subscription(Twist, "/cmd_vel_raw", self.drive, 10)
        self.create_service(Trigger, "/reset", self.reset)

    def on_button(self, msg):
        """Set the latch on True; ignore False."""
        self.stopped = self.stopped or msg.data

    def reset(self, request, response):
        """Release the latch: a person has checked the robot."""
        self.stopped, response.success = False, True
        return response

    def drive(self, msg):
        """Pass the command on, or publish a stop instead."""
        self.commands.publish(Twist() if self.stopped else msg)
