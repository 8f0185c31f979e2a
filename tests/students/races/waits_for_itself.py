"""A callback waits for an answer that only its own callback group could handle (as in raspimouse#56)."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
from std_srvs.srv import Trigger

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Mode(Node):
    """Publishes the mode, latched, and answers what it is."""

    def __init__(self):
        super().__init__("mode")
        self.create_publisher(String, "mode", LATCHED).publish(String(data="slow"))
        self.create_service(Trigger, "get_mode", self.answer)

    def answer(self, request, response):
        response.message = "slow"
        return response


class Drives(Node):
    """Calls the service where it does not know the mode yet."""

    def __init__(self):
        super().__init__("drives")
        self.mode, self.ticks = None, 0
        self.client = self.create_client(Trigger, "get_mode", callback_group=self.group_of_client())
        self.create_subscription(String, "mode", self.on_mode, LATCHED)
        self.create_timer(0.05, self.tick)

    def group_of_client(self):
        return None

    def on_mode(self, message):
        self.mode = message.data

    def tick(self):
        if self.mode is None and self.client.service_is_ready():
            self.mode = self.client.call(Trigger.Request()).message
        self.ticks += 1


class GroupOfItsOwn(Drives):
    """The answer is handled in another group."""

    def group_of_client(self):
        return MutuallyExclusiveCallbackGroup()


def spun(node):
    """A main() that spins a node with two threads."""

    def main():
        rclpy.init()
        executor = MultiThreadedExecutor(2)
        executor.add_node(node())
        executor.spin()

    return main


def holds(run):
    """No callback waits forever."""
    return not run.errors and run.ended.reason == "time"


WRONG, RIGHT = (spun(Drives), Mode), (spun(GroupOfItsOwn), Mode)
