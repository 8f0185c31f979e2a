"""A watchdog is late, because it is in the callback group of a slow service (as in ada_feeding#92)."""

import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Arm(Node):
    """The watchdog has to run at least every 0.2 s; the service takes 0.15 s."""

    def __init__(self):
        super().__init__("arm")
        self.fed = None
        self.create_service(Trigger, "plan", self.plan)
        self.create_timer(0.1, self.watch, callback_group=self.group_of_watchdog())

    def group_of_watchdog(self):
        return None

    def plan(self, request, response):
        time.sleep(0.15)
        return response

    def watch(self):
        now = self.get_clock().now().nanoseconds / 1e9
        assert self.fed is None or now - self.fed < 0.2, f"fed {now - self.fed:.2f} s ago"
        self.fed = now


class GroupOfItsOwn(Arm):
    """The watchdog has its own group."""

    def group_of_watchdog(self):
        return MutuallyExclusiveCallbackGroup()


class Planner(Node):
    """Calls the service every 0.5 s."""

    def __init__(self):
        super().__init__("planner")
        self.client = self.create_client(Trigger, "plan")
        self.create_timer(0.5, self.call)

    def call(self):
        if self.client.service_is_ready():
            self.client.call_async(Trigger.Request())


def spun(node):
    """A main() that spins a node with two threads."""

    def main():
        rclpy.init()
        executor = MultiThreadedExecutor(2)
        executor.add_node(node())
        executor.spin()

    return main


WRONG, RIGHT = (spun(Arm), Planner), (spun(GroupOfItsOwn), Planner)
