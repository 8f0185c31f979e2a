"""Services and actions that raise nothing and still go wrong: names, answers, nodes no one spins."""

import time

import rclpy
from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts
from rcl_interfaces.srv import GetParameters
from rclpy.action import ActionServer
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from rclpy.node import Node

from sim import Process
from tests.students.engine.actions import Server
from tests.students.engine.services import Adder, Customer, Wheel


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


class NoOneReceives(Customer):
    """Asks, and names no one who gets the answer."""

    def __init__(self):
        super().__init__()
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.client.call_async(self.request())


class AwaitsTwice(Customer):
    """Requests one sum after the other in a coroutine, the second one after the first `await`."""

    def __init__(self):
        Node.__init__(self, "customer")
        group = ReentrantCallbackGroup()
        self.client = self.create_client(AddTwoInts, "/add", callback_group=group)
        self.timer = self.create_timer(1.0, self.ask, callback_group=group)

    async def ask(self):
        self.timer.cancel()
        for _ in range(2):
            await self.client.call_async(AddTwoInts.Request(a=1, b=-1))


def adder_that_no_one_spins():
    rclpy.init()
    node = Adder()
    while rclpy.ok():
        time.sleep(1.0)
    node.destroy_node()


def server_that_no_one_spins():
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


class TakesAllParameters(Node):
    def __init__(self):
        super().__init__("taker", allow_undeclared_parameters=True)
        self.get_logger().info("Here")


class DeclaresWhatIsGiven(Node):
    def __init__(self):
        super().__init__("declarer", automatically_declare_parameters_from_overrides=True)
        self.get_logger().info("Here")


def launch_with_a_typo():
    return Process(Wheel, parameters={"name": "right", "radios": 0.2})


def launch_with_another_parameter():
    return Process(Wheel, arguments=["--ros-args", "-p", "mass:=2.0"])


def launch_with_a_parameter_for_none():
    return Process(Adder, parameters={"mass": 2.0})


def launch_with_parameters():
    return Process(Wheel, parameters={"radius": 0.2, "start_type_description_service": False})


def launch_of_a_taker():
    return Process(TakesAllParameters, parameters={"mass": 2.0})


def launch_of_a_declarer():
    return Process(DeclaresWhatIsGiven, parameters={"mass": 2.0})


class DeclaresInOnConfigure(LifecycleNode):
    """Right: its manager, which is not there, configures it later."""

    def __init__(self):
        super().__init__("arm")

    def on_configure(self, state):
        self.declare_parameter("robot", "a")
        return TransitionCallbackReturn.SUCCESS


def launch_of_an_unconfigured_node():
    return Process(DeclaresInOnConfigure, parameters={"robot": "b"})


class ConfiguresItself(DeclaresInOnConfigure):
    def __init__(self):
        super().__init__()
        self.trigger_configure()


def launch_of_a_configured_node():
    return Process(ConfiguresItself, parameters={"robot": "b"})


class AwaitsInItsGroup(Node):
    """Its callback and its client share the node's callback group."""

    def __init__(self):
        super().__init__("awaits")
        self.client = self.create_client(AddTwoInts, "add")
        self.create_timer(0.5, self.tick)

    async def tick(self):
        await self.client.call_async(AddTwoInts.Request(a=1, b=2))


def main_of_a_later_distribution(args=None):
    with rclpy.init(args=args):
        rclpy.spin(Adder())


class SetsTheFieldsOfOneService(NeverSetsTheSum):
    def __init__(self):
        super().__init__()
        self.create_service(AddTwoInts, "add_again", self.add_again)

    def add_again(self, request, response):
        response.sum = request.a + request.b
        return response
