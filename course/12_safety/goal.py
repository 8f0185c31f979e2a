"""The emergency stop of the goal: it stays stopped until it is reset."""

from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_msgs.msg import Bool
from std_srvs.srv import Trigger


class Latch(Node):
    """Stands between /cmd_vel_raw and /cmd_vel; /emergency (Bool) stops it, /reset (Trigger) lets it go."""

    def __init__(self):
        super().__init__("latch")
        self.stopped = False
        self.commands = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(Bool, "/emergency", self.on_button, 10)
        self.create_subscription(Twist, "/cmd_vel_raw", self.drive, 10)
        self.create_service(Trigger, "/reset", self.reset)

    def on_button(self, msg):
        """A True sets the latch; a False changes nothing."""
        self.stopped = self.stopped or msg.data

    def reset(self, request, response):
        """A person has checked the robot and resets it."""
        self.stopped, response.success = False, True
        return response

    def drive(self, msg):
        """Pass a command on, or a stop in its place."""
        self.commands.publish(Twist() if self.stopped else msg)
