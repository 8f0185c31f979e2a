"""Callbacks that await futures: in vain, or only until the right callback has run."""

import weakref
from functools import partial

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_srvs.srv import Trigger


class Waiting(Node):
    """What the others are built on: a timer of 0.5 s whose callback awaits what `pause` does."""

    group = None

    def __init__(self):
        super().__init__("waiting")
        self.opened = Future()
        self.create_timer(0.5, self.go, callback_group=self.group and self.group())

    async def go(self):
        await self.pause()

    async def pause(self):
        await Future()


def spins_in_steps():
    rclpy.init()
    node = Waiting()
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=0.1)


class WaitsInExecute(Node):
    def __init__(self):
        super().__init__("waiting")
        self.server = ActionServer(self, Fibonacci, "fibonacci", self.execute)

    async def execute(self, goal):
        await Future()
        goal.succeed()
        return Fibonacci.Result()


class SleepsInItsGroup(Waiting):
    async def pause(self):
        pause = Future()
        timer = self.create_timer(0.2, lambda: pause.set_result(None))
        await pause
        timer.cancel()


class SleepsWithAPartial(Waiting):
    async def pause(self):
        pause = Future()

        def wake(value):
            pause.set_result(value)

        self.create_timer(0.2, partial(wake, 1))
        await pause


class OpensInItsGroup(Waiting):
    def __init__(self):
        super().__init__()
        self.create_timer(0.7, self.open)

    async def pause(self):
        await self.opened

    def open(self):
        self.finish()

    def finish(self):
        self.opened.set_result(True)


class SleepsInAnotherGroup(SleepsInItsGroup):
    """Right: its callback group lets the timer's callback run meanwhile."""

    group = ReentrantCallbackGroup


class WaitsForAService(Waiting):
    """Right: a service of another group opens it, which in this run no node calls."""

    def __init__(self):
        super().__init__()
        self.create_service(Trigger, "open", self.open, callback_group=ReentrantCallbackGroup())

    async def pause(self):
        await self.opened

    def open(self, request, response):
        self.opened.set_result(True)
        return response


class FindsItsFuture(WaitsForAService):
    """Right: the service looks the future up, and does not keep it alive."""

    async def pause(self):
        self.opened, self.futures = None, weakref.WeakValueDictionary()
        self.futures["open"] = future = Future()
        await future

    def open(self, request, response):
        self.futures["open"].set_result(True)
        return response


class OpenedFromOutside(Waiting):
    """Right: main() may complete the future."""

    async def pause(self):
        await self.opened


def opens_it_late():
    rclpy.init()
    node = OpenedFromOutside()
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=60.0)
        node.opened.set_result(True)


def stays_with_a_task():
    """Right: a coroutine that awaits forever keeps the program alive."""
    rclpy.init()
    node, executor = Node("waiting"), SingleThreadedExecutor()
    node.create_timer(0.1, node.get_clock().now)
    executor.add_node(node)

    async def forever():
        await Future()

    executor.spin_until_future_complete(executor.create_task(forever()))


class Secretive(type):
    """A metaclass that raises; the search for code that completes a future meets it here."""

    def __getattribute__(cls, name):
        if name in ("__name__", "__module__"):
            raise ValueError(name)
        return super().__getattribute__(name)


class Unnamable(metaclass=Secretive):
    pass
