"""Services and actions that raise nothing and still go wrong: names, answers, nodes nobody spins."""

import time

import rclpy
from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts
from rcl_interfaces.srv import GetParameters
from rclpy.action import ActionServer
from rclpy.node import Node

from tests.students.engine.actions import Server
from tests.students.engine.services import Adder, Customer


class MisspeltService(Adder):
    def __init__(self):
        Node.__init__(self, "adder")
        self.create_service(AddTwoInts, "ad", self.add)


class ServiceInNamespace(Adder):
    def __init__(self):
        Node.__init__(self, "adder", namespace="robot1")
        self.create_service(AddTwoInts, "add", self.add)


class MisspeltAction(Server):
    def __init__(self):
        Node.__init__(self, "server")
        self.server = ActionServer(self, Fibonacci, "fibonaci", self.execute)


class NeverSetsTheSum(Adder):
    def add(self, request, response):
        self.sum = request.a + request.b
        return response


class NobodyHears(Customer):
    """Asks, and names nobody who gets the answer."""

    def __init__(self):
        super().__init__()
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.client.call_async(self.request())


def adder_that_nobody_spins():
    rclpy.init()
    node = Adder()
    while rclpy.ok():
        time.sleep(1.0)
    node.destroy_node()


def server_that_nobody_spins():
    rclpy.init()
    node = Server()
    while rclpy.ok():
        time.sleep(1.0)
    node.destroy_node()


def asks_another_node():
    """For a parameter of /wheels, where the node is called /wheel."""
    rclpy.init()
    node = Node("asker")
    client = node.create_client(GetParameters, "/wheels/get_parameters")
    client.call_async(GetParameters.Request(names=["radius"]))
    rclpy.spin(node)
