"""Tasks that executors are given."""

import threading
import time

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_srvs.srv import Trigger


def in_which_order():
    """Three tasks that wait for the same future, and go on when it is done."""
    rclpy.init()
    node, executor, go = Node("tasks"), SingleThreadedExecutor(), Future()
    executor.add_node(node)

    async def work(name):
        node.get_logger().info(f"{name} begins")
        await go
        node.get_logger().info(f"{name} goes on")

    tasks = [executor.create_task(work, name) for name in ("first", "second", "third")]
    timer = node.create_timer(0.5, lambda: (timer.cancel(), go.set_result(None)))
    for task in tasks:
        executor.spin_until_future_complete(task)


class PlansInAThread(Node):
    """A service awaits what a thread of its own works out, and its client awaits the response."""

    def __init__(self):
        super().__init__("planner")
        group = ReentrantCallbackGroup()
        self.create_service(Trigger, "/plan", self.plan, callback_group=group)
        self.client = self.create_client(Trigger, "/plan", callback_group=group)
        self.create_timer(1.0, self.ask, callback_group=group)

    async def plan(self, request, response):
        planned = Future()
        threading.Thread(target=self.work, args=(planned,)).start()
        response.message = await planned
        return response

    def work(self, planned):
        time.sleep(0.4)
        planned.set_result("left, then right")

    async def ask(self):
        response = await self.client.call_async(Trigger.Request())
        self.get_logger().info(response.message)


def plans_with_four_threads():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(PlansInAThread())
    executor.spin()
