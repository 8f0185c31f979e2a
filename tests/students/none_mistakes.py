"""Nodes with one mistake each, named by it: a None where a function or method should have given a value."""

import math

import rclpy
from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts
from geometry_msgs.msg import Twist
from rclpy.action import ActionClient
from rclpy.node import Node

from tests.students.misfits import Talker


class Ordering(Node):
    def __init__(self):
        super().__init__("ordering")
        self.client = ActionClient(self, Fibonacci, "fib")

    def send(self):
        future = self.client.send_goal_async(Fibonacci.Goal(order=3))  # noqa: F841


def polls_what_was_not_returned():
    rclpy.init()
    node = Ordering()
    future = node.send()
    while not future.done():
        rclpy.spin_once(node)


def waits_for_what_was_not_returned():
    rclpy.init()
    node = Ordering()
    future = node.send()
    rclpy.spin_until_future_complete(node, future)


def make_node():
    rclpy.init()
    node = Node("made")  # noqa: F841


def spins_what_was_not_returned():
    rclpy.spin(make_node())


def takes_what_spinning_returns():
    rclpy.init()
    node = Node("asking")
    client = node.create_client(AddTwoInts, "add")
    client.wait_for_service()
    answer = rclpy.spin_until_future_complete(node, client.call_async(AddTwoInts.Request()))
    print(answer.sum)


class Driver(Talker):
    """What the others are built on: a timer calls `tick`, and methods return nothing, or not always."""

    message_type = Twist

    def make(self):
        msg = Twist()
        msg.linear.x = 0.2

    def speed(self, distance):
        if distance > 1.0:
            return 0.2

    def pair(self):
        point = 1.0, 2.0  # noqa: F841

    def turn(self, one, other):
        self.turned = one, other


class PublishesWhatWasNotReturned(Driver):
    def tick(self):
        msg = self.make()
        self.publisher.publish(msg)


class MultipliesNothing(Driver):
    def tick(self):
        speed = self.speed(0.5)
        print(speed * 2)


class ComparesNothing(Driver):
    def tick(self):
        if self.speed(0.5) > 1:
            print("fast")


class RootOfNothing(Driver):
    def tick(self):
        self.turn(math.sqrt(self.speed(0.5)), 1.0)


class UnpacksNothing(Driver):
    def tick(self):
        x, y = self.pair()
        print(x, y)


class PassesOnNothing(Driver):
    def tick(self):
        self.turn(*self.pair())


class KeepsNothing(Driver):
    def __init__(self):
        super().__init__()
        self.command = self.make()

    def tick(self):
        self.command.linear.x = 1.0


class AwaitsNothing(Driver):
    async def tick(self):
        answer = await self.ask()
        print(answer.sum)

    async def ask(self):
        total = 3  # noqa: F841


class LoopsOverASort(Driver):
    def __init__(self):
        super().__init__()
        self.distances = [2.0, 1.0]

    def tick(self):
        for each in self.distances.sort():
            print(each)


class TakesTheFirstOfASort(Driver):
    def tick(self):
        distances = [2.0, 1.0].copy()
        ordered = distances.sort()
        print(ordered[0])


class LoopsOverAReturnedReverse(Driver):
    def backwards(self):
        distances = [1.0, 2.0]
        return distances.reverse()

    def tick(self):
        for each in self.backwards():
            print(each)


class LooksUpNothing(Driver):
    def tick(self):
        known = {}
        place = known.get("here")
        print(place.x)
