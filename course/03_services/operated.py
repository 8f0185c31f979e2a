"""The goal of lesson 3b: a robot that drives circles while its power is on, and its operator."""

from geometry_msgs.msg import Twist
from rcl_interfaces.msg import SetParametersResult
from rcl_interfaces.srv import SetParameters
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_srvs.srv import SetBool


class Circler(Node):
    """Drives circles of the radius that its parameter says, while its power is on."""

    def __init__(self):
        super().__init__("circler")
        self.on = False
        self.add_on_set_parameters_callback(self.check)
        self.declare_parameter("radius", 1.0)
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_service(SetBool, "/power", self.power)
        self.create_timer(0.1, self.drive)

    def check(self, parameters):
        """Refuse a radius that is too small."""
        for parameter in parameters:
            if parameter.name == "radius" and parameter.value < 0.2:
                return SetParametersResult(successful=False, reason="the radius must be 0.2 m or more")
        return SetParametersResult(successful=True)

    def power(self, request, response):
        """Switch on or off."""
        self.on = request.data
        return SetBool.Response(success=True, message="on" if self.on else "off")

    def drive(self):
        """Publish a command: zeros while the power is off."""
        msg = Twist()
        if self.on:
            msg.linear.x, msg.angular.z = 0.4, 0.4 / self.get_parameter("radius").value
        self.publisher.publish(msg)


class Operator(Node):
    """Switches the robot on at 3 s, sets a radius every 6 s, and switches the robot off at the end."""

    def __init__(self):
        super().__init__("operator")
        self.left = [0.5, 0.0, 0.3]
        self.power = self.create_client(SetBool, "/power")
        self.settings = self.create_client(SetParameters, "/circler/set_parameters")
        self.start = self.create_timer(3.0, self.begin)
        self.create_timer(6.0, self.tick)

    def begin(self):
        """Switch on, once."""
        self.start.cancel()
        self.switch(True)

    def tick(self):
        """Set the next radius, or switch off if none is left."""
        if self.left:
            parameter = Parameter("radius", value=self.left.pop(0)).to_parameter_msg()
            request = SetParameters.Request(parameters=[parameter])
            self.settings.call_async(request).add_done_callback(self.on_radius)
        else:
            self.switch(False)

    def on_radius(self, future):
        """Log whether the radius was accepted."""
        result = future.result().results[0]
        self.get_logger().info(f"successful={result.successful} {result.reason}")

    def switch(self, on):
        """Ask for on or off."""
        self.power.call_async(SetBool.Request(data=on)).add_done_callback(self.on_power)

    def on_power(self, future):
        """Log the answer."""
        self.get_logger().info(f"power {future.result().message}")
