"""A program that is forgiven 1 for 1.0; all others are not."""

import numpy as np
import pytest
from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_msgs.msg import Float64, Int32

from sim import Process, run
from sim.ros.messages.whole_numbers import whole_numbers


class Sloppy(Node):
    def __init__(self):
        super().__init__("sloppy")
        self.publisher = self.create_publisher(Float64, "/number", 10)
        self.create_timer(0.5, lambda: self.publisher.publish(Float64(data=3)))


def test_a_program_may_be_forgiven_whole_numbers():
    forgiven = run(Process(Sloppy, whole_numbers=True), seconds=2, quiet=True)
    assert forgiven.errors == []
    assert [heard.message.data for heard in forgiven.messages("/number")] == [3.0] * 4
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
def test_numbers_of_the_other_kind_fit_while_they_are_wanted(make, value):
    with whole_numbers():
        assert (make(), type(make())) == (value, type(value))
    with pytest.raises(AssertionError, match="must be of type"):
        make()


@pytest.mark.parametrize(
    "make", [lambda: Float64(data=True), lambda: Float64(data="1"), lambda: Int32(data=2.5)]
)
def test_what_is_no_such_number_fits_never(make):
    with whole_numbers(), pytest.raises(AssertionError, match="must be of type"):
        make()


def _twist(speed):
    msg = Twist()
    msg.linear.x = speed
    return msg
