"""Nodes with one mistake each around parameters, named by it."""

from example_interfaces.srv import AddTwoInts
from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter

from sim import Process


class Wheel(Node):
    """Declares a parameter, checks it, and sets it after 1 s; nothing is wrong with it."""

    def __init__(self):
        super().__init__("wheel")
        self.declare_parameter("radius", 0.1)
        self.add_on_set_parameters_callback(self.check)
        self.create_timer(1.0, self.change)

    def check(self, parameters):
        return SetParametersResult(successful=all(parameter.value > 0 for parameter in parameters))

    def change(self):
        self.set_parameters([Parameter("radius", value=0.2)])


class DeclaresTwice(Wheel):
    def __init__(self):
        super().__init__()
        self.declare_parameter("radius", 0.2)


class DeclaresWithoutAValue(Wheel):
    def change(self):
        self.remove_on_set_parameters_callback(self.check)
        self.declare_parameter("width", Parameter.Type.DOUBLE)
        return self.get_parameter("width").value


class ReckonsWithoutAValue(Wheel):
    def change(self):
        self.remove_on_set_parameters_callback(self.check)
        self.declare_parameter("width")
        return self.get_parameter("width").value * 2


class SetsPairs(Wheel):
    def change(self):
        self.set_parameters([("radius", 0.2)])


class ComputesWithTheParameter(Wheel):
    def change(self):
        return self.get_parameter("radius") * 2


class CallsTheCheck(Wheel):
    def __init__(self):
        super().__init__()
        self.add_on_set_parameters_callback(self.check([]))


class ChecksOneParameter(Wheel):
    def check(self, parameters):
        return SetParametersResult(successful=parameters.value > 0)


class ChecksFirst(Wheel):
    """As it should be; the two below refuse the value that it declares."""

    def __init__(self):
        Node.__init__(self, "wheel")
        self.add_on_set_parameters_callback(self.check)
        self.declare_parameter("radius", 0.1)


class ReturnsNothing(ChecksFirst):
    def check(self, parameters):
        pass


class RefusesItsDefault(ChecksFirst):
    def check(self, parameters):
        return SetParametersResult(successful=parameters[0].value > 1.0, reason="too small")


class SaysYesByPosition(Wheel):
    def check(self, parameters):
        return SetParametersResult(True)


def launches_an_object():
    return Process(Wheel(), parameters={"radius": 0.2})


class TakesTheFutureForTheAnswer(Wheel):
    def change(self):
        return self.create_client(AddTwoInts, "/add").call_async(AddTwoInts.Request()).sum


whole_number_at_the_start = Process(Wheel, parameters={"radius": 1})


def launches_with_a_keyword():
    return Process(Wheel, radius=0.2)


def launches_with_text():
    return Process(Wheel, parameters="radius:=0.2")


class LooksUpAWordThatIsNotThere(Wheel):
    def change(self):
        return {"round": 0.1}["square"]
