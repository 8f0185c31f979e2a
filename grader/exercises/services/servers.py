"""Nodes of ours for 03_services whose services the student's nodes use."""

from __future__ import annotations

import random

from example_interfaces.srv import AddTwoInts
from rclpy.duration import Duration
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from std_msgs.msg import Int64
from std_srvs.srv import Trigger

from grader.exercises.services.partners import at

REFUSALS = (
    "The door is locked.",
    "Somebody stands in the way.",
    "The doorman is at lunch.",
    "Please wait a moment.",
)


class Door(Node):
    """Offers /door/open (Trigger), but only from 2 or 3 s on; says no two or three times, then yes.

    Times and words come from the run's seed.
    """

    def __init__(self) -> None:
        super().__init__("door")
        self.refusals = random.sample(REFUSALS, random.randint(2, 3))
        at(self, random.uniform(2.1, 3.4), self.open_up)

    def open_up(self) -> None:
        """Begin to answer."""
        try:
            self.create_service(Trigger, "/door/open", self.answer)
        except rclpy_implementation.RCLError:  # the student's client is of another type
            self.get_logger().info("/door/open is used with another type")

    def answer(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        """No, no, yes."""
        self.get_clock().sleep_for(Duration(seconds=0.2))  # it takes a moment
        response.success = not self.refusals
        response.message = "The door is open." if response.success else self.refusals.pop()
        return response


class SlowAdder(Node):
    """Offers /add_two_ints (AddTwoInts), and takes 0.3 s for each answer."""

    def __init__(self) -> None:
        super().__init__("slow_adder")
        self.create_service(AddTwoInts, "/add_two_ints", self.add)

    def add(self, request: AddTwoInts.Request, response: AddTwoInts.Response) -> AddTwoInts.Response:
        """Think, then add."""
        self.get_clock().sleep_for(Duration(seconds=0.3))
        response.sum = request.a + request.b
        return response


class Wheels(Node):
    """Counts the ticks of two wheels that turn: Int64 on /ticks/left and /ticks/right, 5 times a second."""

    def __init__(self) -> None:
        super().__init__("wheels")
        self.counts = [random.randint(1, 9), random.randint(1, 9)]
        self.sides = [self.create_publisher(Int64, f"/ticks/{side}", 10) for side in ("left", "right")]
        self.create_timer(0.2, self.turn)

    def turn(self) -> None:
        """A bit further, and never the same way on both sides."""
        for side, publisher in enumerate(self.sides):
            self.counts[side] += random.randint(3, 20)
            publisher.publish(Int64(data=self.counts[side]))
