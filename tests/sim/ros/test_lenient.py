"""A lenient program may use 1 for 1.0, and Float32 for Float64; all others may not."""

import numpy as np
import pytest
from geometry_msgs.msg import Twist
from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_msgs.msg import Float32, Float64, Int32, String

from sim import Process, run
from sim.ros.messages.lenient import lenient_fields


class Sloppy(Node):
    def __init__(self):
        super().__init__("sloppy")
        self.publisher = self.create_publisher(Float64, "/number", 10)
        self.create_timer(0.5, lambda: self.publisher.publish(Float64(data=3)))


def test_a_lenient_program_may_use_whole_numbers():
    lenient = run(Process(Sloppy, lenient=True), seconds=2, quiet=True)
    assert lenient.errors == []
    assert [received.message.data for received in lenient.messages("/number")] == [3.0] * 4
    (error,) = run(Sloppy, seconds=2, quiet=True).errors
    assert (error.type, error.text) == ("AssertionError", "The 'data' field must be of type 'float'")


@pytest.mark.parametrize(
    ("make", "value"),
    [
        (lambda: Float64(data=3).data, 3.0),
        (lambda: Float64(data=np.float32(0.5)).data, 0.5),
        (lambda: Int32(data=2.0).data, 2),
        (lambda: Int32(data=np.int64(2)).data, 2),
        (lambda: _twist(1).linear.x, 1.0),
    ],
)
def test_numbers_of_the_other_kind_are_accepted_while_lenient(make, value):
    with lenient_fields():
        assert (make(), type(make())) == (value, type(value))
    with pytest.raises(AssertionError, match="must be of type"):
        make()


@pytest.mark.parametrize(
    "make", [lambda: Float64(data=True), lambda: Float64(data="1"), lambda: Int32(data=2.5)]
)
def test_other_values_are_never_accepted(make):
    with lenient_fields(), pytest.raises(AssertionError, match="must be of type"):
        make()


def _twist(speed):
    msg = Twist()
    msg.linear.x = speed
    return msg


class Single(Node):
    """Publishes and subscribes to Float32 where all others use Float64."""

    type = Float32

    def __init__(self):
        super().__init__("single")
        self.publisher = self.create_publisher(self.type, "/joint_commands", 10)
        self.create_subscription(self.type, "/wanted", self.on_message, 10)

    def on_message(self, msg):
        self.publisher.publish(self.type(data=msg.data))


class Text(Single):
    type = String


class Wants(Node):
    def __init__(self):
        super().__init__("wants")
        self.publisher = self.create_publisher(Float64, "/wanted", 10)
        self.create_timer(1.0, lambda: self.publisher.publish(Float64(data=0.5)))


def test_a_lenient_program_may_use_the_other_float():
    lenient = run(Process(Single, lenient=True), companions=[Wants], world="joint", seconds=4, quiet=True)
    assert lenient.errors == []
    assert [received.type for received in lenient.messages("/joint_commands")] == ["std_msgs/msg/Float64"] * 4
    assert lenient.messages("/joint_states")[-1].message.position[0] == pytest.approx(0.5, abs=0.01)
    for target in (Single, Process(Text, lenient=True)):
        (error,) = run(target, companions=[Wants], world="joint", seconds=4, quiet=True).errors
        assert (error.type, "with incompatible type" in error.text) == ("RCLError", True)


class Setting(Node):
    def __init__(self):
        super().__init__("setting")
        self.declare_parameter("Speed", 0)
        self.declare_parameters("", [("Count", 2.0), ("flag", True)])


class Sets(Node):
    """Sets and reads a parameter of the other node, under the name that it should have."""

    def __init__(self):
        super().__init__("sets")
        self.set = self.create_client(SetParameters, "/setting/set_parameters")
        self.get = self.create_client(GetParameters, "/setting/get_parameters")
        self.create_timer(1.0, self.ask)

    def ask(self):
        value = Parameter("speed", value=0.5).to_parameter_msg()
        self.set.call_async(SetParameters.Request(parameters=[value]))
        self.get.call_async(GetParameters.Request(names=["speed", "flag"]))


def test_a_misspelt_parameter_is_found_and_one_with_default_0_accepts_0_5():
    set_, get = asked(Process(Setting))
    assert (set_.results[0].successful, get.values) == (False, [])
    set_, get = asked(Process(Setting, lenient=True))
    assert set_.results[0].successful
    assert [(value.type, value.double_value, value.bool_value) for value in get.values] == [
        (3, 0.5, False), (1, 0.0, True),
    ]  # fmt: skip


def asked(setting):
    """The last answers of the two services."""
    return [call.response for call in run(setting, companions=[Sets], seconds=2, quiet=True).calls[-2:]]
