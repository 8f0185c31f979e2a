"""The goal of lesson 3a: a trip meter with a reset, and a button that presses it."""

from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node
from std_msgs.msg import Float64
from std_srvs.srv import Trigger


class TripMeter(Node):
    """Adds up how far the robot has driven, until it is reset."""

    def __init__(self):
        super().__init__("trip_meter")
        self.meters = 0.0
        self.publisher = self.create_publisher(Float64, "/trip", 10)
        self.create_subscription(Odometry, "/odom", self.count, 10)
        self.create_service(Trigger, "/trip/reset", self.reset)

    def count(self, msg):
        """Add the distance since the last message."""
        self.meters += abs(msg.twist.twist.linear.x) / 20  # /odom arrives 20 times a second
        self.publisher.publish(Float64(data=self.meters))

    def reset(self, request, response):
        """Restart at 0 and respond with the distance so far."""
        response.success = True
        response.message = f"it was {self.meters:.2f} m"
        self.meters = 0.0
        return response


class Button(Node):
    """Requests a reset every 4 s and logs the answer."""

    def __init__(self):
        super().__init__("button")
        self.client = self.create_client(Trigger, "/trip/reset")
        self.create_timer(4.0, self.press)

    def press(self):
        """Send a request if there is a server."""
        if self.client.service_is_ready():
            self.client.call_async(Trigger.Request()).add_done_callback(self.on_response)

    def on_response(self, future):
        """Log the answer."""
        self.get_logger().info(future.result().message)


class Driver(Node):
    """Drives straight ahead."""

    def __init__(self):
        super().__init__("driver")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, self.drive)

    def drive(self):
        """Publish a command."""
        msg = Twist()
        msg.linear.x = 0.3
        self.publisher.publish(msg)
