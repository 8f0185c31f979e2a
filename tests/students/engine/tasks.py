"""Tasks that executors are given."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future


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
