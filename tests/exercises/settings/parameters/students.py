"""Cruisers: right ones, and wrong ones named by their defect."""

import math

import rclpy
from geometry_msgs.msg import Twist
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter


class Cruiser(Node):
    """As one would write it."""

    name, parameter, default = "cruiser", "speed", 0.2

    def __init__(self):
        super().__init__(self.name)
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, self.drive)
        self.add_on_set_parameters_callback(self.check)
        self.declare_parameter(self.parameter, self.default)

    def check(self, parameters):
        for parameter in parameters:
            if parameter.name == "speed" and not 0.0 <= parameter.value <= 0.5:
                return SetParametersResult(successful=False, reason="speed has to be from 0.0 to 0.5 m/s")
        return SetParametersResult(successful=True)

    def drive(self):
        msg = Twist()
        msg.linear.x = self.get_parameter("speed").value
        self.publisher.publish(msg)


class CruiserWithField(Cruiser):
    """Keeps the value in a field, and learns when it has changed."""

    def __init__(self):
        super().__init__()
        self.speed = self.get_parameter("speed").get_parameter_value().double_value
        self.add_post_set_parameters_callback(self.keep)

    def check(self, parameters):
        bad = [p for p in parameters if p.name == "speed" and (p.value < 0.0 or p.value > 0.5)]
        return SetParametersResult(successful=not bad, reason="out of range" if bad else "")

    def keep(self, parameters):
        for parameter in parameters:
            if parameter.name == "speed":
                self.speed = parameter.value

    def drive(self):
        msg = Twist()
        msg.linear.x = self.speed
        self.publisher.publish(msg)


class CruiserWithDescriptor(Cruiser):
    """Lets ROS itself refuse: the range is in the descriptor."""

    def __init__(self):
        Node.__init__(self, "cruiser")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, self.drive)
        allowed = FloatingPointRange(from_value=0.0, to_value=0.5)
        descriptor = ParameterDescriptor(description="m/s", floating_point_range=[allowed])
        self.speed = self.declare_parameter("speed", 0.2, descriptor)


def main():
    rclpy.init()
    rclpy.spin(Cruiser())
    rclpy.shutdown()


class LooksAtItsStart(Cruiser):
    """A design of its own: declares first, looks at the value itself, and takes another if it is wrong."""

    def __init__(self):
        Node.__init__(self, "cruiser")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        first = self.declare_parameter("speed", 0.2)
        if not self.check([first]).successful:
            self.get_logger().error("from 0.0 to 0.5 m/s; I take 0.2")
            self.set_parameters([Parameter("speed", value=0.2)])
        self.add_on_set_parameters_callback(self.check)
        self.create_timer(0.1, self.drive)


class ChecksAfterItsStart(Cruiser):
    """Declares the parameter before anything checks it."""

    def __init__(self):
        NotDeclared.__init__(self)
        self.declare_parameter("speed", 0.2)
        self.add_on_set_parameters_callback(self.check)


class AnotherName(Cruiser):
    name = "driver"


class ParameterMisspelt(Cruiser):
    parameter = "Speed"

    def drive(self):
        self.publisher.publish(Twist())


class ParameterMisspeltEverywhere(Cruiser):
    """The parameter has another name than the one that is set."""

    parameter = "sped"

    def check(self, parameters):
        for parameter in parameters:
            if parameter.name == "sped" and not 0.0 <= parameter.value <= 0.5:
                return SetParametersResult(successful=False, reason="from 0.0 to 0.5 m/s")
        return SetParametersResult(successful=True)

    def drive(self):
        msg = Twist()
        msg.linear.x = self.get_parameter("sped").value
        self.publisher.publish(msg)


class NotDeclared(Cruiser):
    def __init__(self):
        Node.__init__(self, "cruiser")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, self.drive)


class AnotherDefault(Cruiser):
    default = 0.3


class WholeNumber(Cruiser):
    default = 0


class WholeNumberMadeReal(WholeNumber):
    """ROS refuses all that is set, in place of its own check."""

    def drive(self):
        msg = Twist()
        msg.linear.x = float(self.get_parameter("speed").value)
        self.publisher.publish(msg)


class TextForSpeed(Cruiser):
    default = "0.2"


class ReadOnceInInit(Cruiser):
    def __init__(self):
        super().__init__()
        self.speed = self.get_parameter("speed").value

    def drive(self):
        msg = Twist()
        msg.linear.x, msg.angular.z = self.speed, 0.0
        self.publisher.publish(msg)


class ConstantSpeed(Cruiser):
    def drive(self):
        msg = Twist()
        msg.linear.x = 0.3
        self.publisher.publish(msg)


class NoCallback(Cruiser):
    def __init__(self):
        NotDeclared.__init__(self)
        self.declare_parameter("speed", 0.2)


class CallbackNotHandedOver(Cruiser):
    """Brackets after the method."""

    def __init__(self):
        NotDeclared.__init__(self)
        self.declare_parameter("speed", 0.2)
        self.add_on_set_parameters_callback(self.check([]))


class RefusesSilently(Cruiser):
    def check(self, parameters):
        return SetParametersResult(successful=0.0 <= parameters[0].value <= 0.5)


class OnlyUpwards(Cruiser):
    """Forgets that a speed may be negative."""

    def check(self, parameters):
        if parameters[0].value > 0.5:
            return SetParametersResult(successful=False, reason="too fast")
        return SetParametersResult(successful=True)


class ChecksTheOldValue(Cruiser):
    def check(self, parameters):
        fine = 0.0 <= self.get_parameter("speed").value <= 0.5
        return SetParametersResult(successful=fine, reason="" if fine else "out of range")


class ReturnsNothing(Cruiser):
    """Forgets the good case."""

    def check(self, parameters):
        for parameter in parameters:
            if not 0.0 <= parameter.value <= 0.5:
                return SetParametersResult(successful=False, reason="out of range")


class ReturnsABool(Cruiser):
    def check(self, parameters):
        return 0.0 <= parameters[0].value <= 0.5


class RaisesForBadValues(Cruiser):
    def check(self, parameters):
        if not 0.0 <= parameters[0].value <= 0.5:
            raise ValueError("out of range")
        return SetParametersResult(successful=True)


class CutsToTheLimits(Cruiser):
    """Kind, but then no one learns of the mistake."""

    def check(self, parameters):
        return SetParametersResult(successful=True)

    def drive(self):
        msg = Twist()
        msg.linear.x = min(max(self.get_parameter("speed").value, 0.0), 0.5)
        self.publisher.publish(msg)


class RefusesTheLimits(Cruiser):
    def check(self, parameters):
        fine = 0.0 < parameters[0].value < 0.5
        return SetParametersResult(successful=fine, reason="out of range")


class RefusesEverything(Cruiser):
    def check(self, parameters):
        return SetParametersResult(successful=False, reason="no")


class TakesOneParameter(Cruiser):
    """The callback gets a list."""

    def check(self, parameters):
        fine = 0.0 <= parameters.value <= 0.5
        return SetParametersResult(successful=fine, reason="out of range")


class NeverComesBack(Cruiser):
    """A loop without end in the callback."""

    def check(self, parameters):
        while True:
            pass


class NeverBothAtOnce(Cruiser):
    """No number is below one end and above the other."""

    def check(self, parameters):
        for parameter in parameters:
            if parameter.name == "speed" and parameter.value < 0.0 and parameter.value > 0.5:
                return SetParametersResult(successful=False, reason="out of range")
        return SetParametersResult(successful=True)


class DrivesAtNan(Cruiser):
    """The parameter is right, and no command is a number."""

    def drive(self):
        msg = Twist()
        msg.linear.x = math.nan
        self.publisher.publish(msg)
