"""Visitors at the door: right ones, and wrong ones named by their defect."""

import math
import time

import example_interfaces.srv
import rclpy
from geometry_msgs.msg import Twist
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Visitor(Node):
    """As one would write it."""

    type, service, pause = Trigger, "/door/open", 1.0

    def __init__(self):
        super().__init__("visitor")
        self.speed = 0.0
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, self.drive)
        self.client = self.create_client(self.type, self.service)
        self.timer = self.create_timer(self.pause, self.ask)

    def drive(self):
        msg = Twist()
        msg.linear.x = self.speed
        self.publisher.publish(msg)

    def ask(self):
        if self.client.service_is_ready():
            future = self.client.call_async(self.type.Request())
            future.add_done_callback(self.on_response)

    def on_response(self, future):
        answer = future.result()
        if answer.success:
            self.speed = 0.3
            self.timer.cancel()
        else:
            self.get_logger().warning(f"The door says: {answer.message}")


class VisitorThatAwaits(Visitor):
    """One coroutine; the client has a callback group of its own, so that its answer can come in."""

    def __init__(self):
        super().__init__()
        group = MutuallyExclusiveCallbackGroup()
        self.client = self.create_client(Trigger, "/door/open", callback_group=group)

    async def ask(self):
        if not self.client.service_is_ready():
            return
        answer = await self.client.call_async(Trigger.Request())
        if answer.success:
            self.speed = 0.3
            self.timer.cancel()
        else:
            self.get_logger().warning(answer.message)


def main(args=None):
    """A program that asks in its main function, and lets the node work in between."""
    rclpy.init(args=args)
    node = Node("visitor")
    speed = 0.0
    publisher = node.create_publisher(Twist, "cmd_vel", 10)

    def drive():
        msg = Twist()
        msg.linear.x = speed
        publisher.publish(msg)

    node.create_timer(0.1, drive)
    client = node.create_client(Trigger, "door/open")
    while rclpy.ok() and not client.service_is_ready():
        rclpy.spin_once(node, timeout_sec=0.1)
    while speed == 0.0:
        future = client.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(node, future)
        if future.result().success:
            speed = 0.3
            break
        node.get_logger().warn(future.result().message)
        until = node.get_clock().now() + rclpy.duration.Duration(seconds=1)
        while node.get_clock().now() < until:
            rclpy.spin_once(node)
    rclpy.spin(node)


def main_with_threads(args=None):
    """Blocks in a callback, which is fine with a thread for it and a group that lets the answer in."""
    rclpy.init(args=args)
    node = Visitor()
    node.timer.cancel()
    group = ReentrantCallbackGroup()
    client = node.create_client(Trigger, "door/open", callback_group=group)

    def ask():
        node.timer.cancel()
        client.wait_for_service()
        while not (answer := client.call(Trigger.Request())).success:
            node.get_logger().warning("Refused: " + answer.message)
            time.sleep(1.0)
        node.speed = 0.3

    node.timer = node.create_timer(0.5, ask, callback_group=group)
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(node)
    executor.spin()


class VisitorWithOneShotTimers(Visitor):
    """A design of its own: after a no, a timer for the next question."""

    pause = 0.1

    def ask(self):
        if self.client.wait_for_service(timeout_sec=0.0):
            self.timer.cancel()
            self.client.call_async(Trigger.Request()).add_done_callback(self.on_response)

    def on_response(self, future):
        if future.result().success:
            self.speed = 0.3
            return
        self.get_logger().warning(future.result().message)
        self.timer = self.create_timer(1.0, self.ask)


class MisspeltService(Visitor):
    service = "/dor/open"


class TriggerOfAnotherPackage(Visitor):
    type = example_interfaces.srv.Trigger


class AsksOnceAtTheStart(Visitor):
    """The door isn't there yet: the question is lost."""

    def __init__(self):
        super().__init__()
        self.timer.cancel()
        self.client.call_async(Trigger.Request()).add_done_callback(self.on_response)


class AsksWithoutLooking(Visitor):
    """It comes in at last, and its first questions are lost."""

    def ask(self):
        self.client.call_async(Trigger.Request()).add_done_callback(self.on_response)


class ReadyWithoutBrackets(Visitor):
    """A method is always true."""

    def ask(self):
        if self.client.service_is_ready:
            self.client.call_async(Trigger.Request()).add_done_callback(self.on_response)


class WaitsInInit(Visitor):
    """Works, but no commands go out for as long as it waits."""

    def __init__(self):
        super().__init__()
        self.client.wait_for_service()


class WaitsInTheCallback(Visitor):
    def ask(self):
        self.client.wait_for_service()
        super().ask()


class CallsInTheCallback(Visitor):
    """The deadlock."""

    def ask(self):
        if self.client.service_is_ready():
            answer = self.client.call(Trigger.Request())
            self.speed = 0.3 if answer.success else 0.0


class SpinsInTheCallback(Visitor):
    def ask(self):
        if self.client.service_is_ready():
            future = self.client.call_async(Trigger.Request())
            rclpy.spin_until_future_complete(self, future)
            self.on_response(future)


class SleepsUntilDone(Visitor):
    """No one can fill the future while it sleeps."""

    def ask(self):
        if self.client.service_is_ready():
            future = self.client.call_async(Trigger.Request())
            while not future.done():
                time.sleep(0.1)
            self.on_response(future)


class AwaitsInOneGroup(Visitor):
    async def ask(self):
        if self.client.service_is_ready():
            answer = await self.client.call_async(Trigger.Request())
            self.speed = 0.3 if answer.success else 0.0


class LooksAtTheResultAtOnce(Visitor):
    def ask(self):
        if self.client.service_is_ready():
            self.on_response(self.client.call_async(Trigger.Request()))


class NoDoneCallback(Visitor):
    def ask(self):
        if self.client.service_is_ready():
            self.client.call_async(Trigger.Request())


class IgnoresSuccess(Visitor):
    """Any answer is good enough for it."""

    def on_response(self, future):
        self.speed = 0.3
        self.timer.cancel()


class CarelessVisitor(Visitor):
    """Lesson 3's: doesn't look at the answer."""

    def on_response(self, future):
        self.get_logger().info("The door is open!")


class InfoForWarning(Visitor):
    def on_response(self, future):
        if future.result().success:
            super().on_response(future)
        else:
            self.get_logger().info(future.result().message)


class AsksAgainAtOnce(Visitor):
    def on_response(self, future):
        super().on_response(future)
        if not future.result().success:
            self.ask()


class GivesUp(Visitor):
    def on_response(self, future):
        super().on_response(future)
        self.timer.cancel()


class ReceiveWithoutFuture(Visitor):
    def on_response(self):
        pass


class ForgetsResult(Visitor):
    def on_response(self, future):
        if future.success:
            self.speed = 0.3


class AsksWithTheClass(Visitor):
    def ask(self):
        if self.client.service_is_ready():
            self.client.call_async(Trigger.Request).add_done_callback(self.on_response)


class AsksBeforeTheAnswer(Visitor):
    """Ten times a second, while an answer takes 0.2 s."""

    pause = 0.1


class DrivesAtNan(Visitor):
    """Once the door is open, the speed is not a number."""

    def on_response(self, future):
        super().on_response(future)
        self.speed = math.nan if self.speed else 0.0
