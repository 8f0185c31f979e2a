"""Squares out of actions: right ones, and wrong ones named by their defect."""

import math

import rclpy
from nav2_msgs.action import DriveOnHeading, Spin
from rclpy.action import ActionClient
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node

PARTS = ("BlockingClient", "ahead", "left")


def ahead(meters=1.0, speed=0.4):
    goal = DriveOnHeading.Goal(speed=speed)
    goal.target.x = meters
    return goal


def left(angle=math.pi / 2):
    return Spin.Goal(target_yaw=angle)


class SquareClient(Node):
    sides, meters, angle = 4, 1.0, math.pi / 2

    def __init__(self):
        super().__init__("square_client")
        group = self.group()
        self.drive = ActionClient(self, DriveOnHeading, "/drive_on_heading", callback_group=group)
        self.spin = ActionClient(self, Spin, "/spin", callback_group=group)
        self.timer = self.create_timer(0.5, self.go, callback_group=group)

    def group(self):
        return ReentrantCallbackGroup()

    async def go(self):
        self.timer.cancel()
        for _ in range(self.sides):
            await self.finish(self.drive, ahead(self.meters))
            await self.finish(self.spin, left(self.angle))

    async def finish(self, client, goal):
        goal_handle = await client.send_goal_async(goal)
        await goal_handle.get_result_async()


class ChainOfCallbacks(Node):
    """A design of its own: each result sends the next goal."""

    def __init__(self):
        super().__init__("square_client")
        self.drive = ActionClient(self, DriveOnHeading, "drive_on_heading")
        self.spin = ActionClient(self, Spin, "spin")
        self.plan = [(self.drive, ahead()), (self.spin, left())] * 4
        self.timer = self.create_timer(0.5, self.next)

    def next(self, future=None):
        self.timer.cancel()
        if self.plan:
            client, goal = self.plan.pop(0)
            client.send_goal_async(goal).add_done_callback(self.accepted)

    def accepted(self, future):
        future.result().get_result_async().add_done_callback(self.next)


def main_that_waits():
    rclpy.init()
    node = Node("square")
    drive, spin = ActionClient(node, DriveOnHeading, "drive_on_heading"), ActionClient(node, Spin, "spin")
    for _ in range(4):
        for client, goal in ((drive, ahead(speed=0.5)), (spin, left())):
            client.wait_for_server()
            future = client.send_goal_async(goal)
            rclpy.spin_until_future_complete(node, future)
            rclpy.spin_until_future_complete(node, future.result().get_result_async())
    node.destroy_node()
    rclpy.shutdown()


class BlockingClient(SquareClient):
    def go(self):
        self.timer.cancel()
        for _ in range(4):
            self.drive.send_goal(ahead())
            self.spin.send_goal(left())


def main_with_threads():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(BlockingClient())
    executor.spin()


class Clockwise(SquareClient):
    angle = -math.pi / 2


class Degrees(SquareClient):
    angle = 90.0


class ThreeSides(SquareClient):
    sides = 3


class HalfSides(SquareClient):
    meters = 0.5


class NeverTurns(SquareClient):
    async def go(self):
        self.timer.cancel()
        for _ in range(4):
            await self.finish(self.drive, ahead())


class WaitsForTheResponseOnly(SquareClient):
    async def finish(self, client, goal):
        await client.send_goal_async(goal)


class WaitsForNothing(SquareClient):
    async def finish(self, client, goal):
        client.send_goal_async(goal)


class ForgetsToAwaitTheResult(SquareClient):
    async def finish(self, client, goal):
        goal_handle = await client.send_goal_async(goal)
        goal_handle.get_result_async()


class ForgetsToAwaitTheHandle(SquareClient):
    async def finish(self, client, goal):
        goal_handle = client.send_goal_async(goal)
        await goal_handle.get_result_async()


class DefaultGroup(SquareClient):
    """Waits in the group where the answer should come in."""

    def group(self):
        return None


class TimerGoesOn(SquareClient):
    """A new square begins every half second."""

    async def go(self):
        for _ in range(4):
            await self.finish(self.drive, ahead())
            await self.finish(self.spin, left())


class ForgetsTheSpeed(SquareClient):
    async def go(self):
        self.timer.cancel()
        for _ in range(4):
            await self.finish(self.drive, ahead(speed=0.0))
            await self.finish(self.spin, left())


class OneThreadThatBlocks(BlockingClient):
    """send_goal waits, and no one is there to take the answer."""


class HalfTurns(SquareClient):
    angle = math.pi


class NearlyAQuarter(SquareClient):
    angle = 1.5


class TurnsWithTheDriver(SquareClient):
    async def finish(self, client, goal):
        await super().finish(self.drive, goal)
