"""Services, clients and parameters, called in every way that tutorials show."""

import time

import rclpy
from example_interfaces.srv import AddTwoInts
from rcl_interfaces.msg import SetParametersResult
from rcl_interfaces.srv import GetParameters
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
from rclpy.qos import qos_profile_services_default
from rclpy.service_introspection import ServiceIntrospectionState


class Adder(Node):
    """Answers at once."""

    wait = 0.0

    def __init__(self):
        super().__init__("adder")
        self.create_service(AddTwoInts, "add", self.add)

    def add(self, request, response):
        if self.wait:
            time.sleep(self.wait)
        response.sum = request.a + request.b
        return response


class SlowAdder(Adder):
    """Takes 0.5 s."""

    wait = 0.5


class AsyncAdder(Adder):
    """A service callback that is a coroutine."""

    async def add(self, request, response):
        response.sum = request.a + request.b
        return response


class Customer(Node):
    """A client for the adder, and a log to say what came."""

    def __init__(self, group=None):
        super().__init__("customer")
        self.group = group
        self.client = self.create_client(AddTwoInts, "add", callback_group=group)
        self.client.service_is_ready()  # with a server that is there, nothing is sent too early

    def say(self, text):
        self.get_logger().info(text)

    @staticmethod
    def request(a=2, b=3):
        return AddTwoInts.Request(a=a, b=b)


def late_adder():
    """The server comes after 2.3 s."""
    time.sleep(2.3)
    rclpy.init()
    rclpy.spin(Adder())


def until_future_complete():
    rclpy.init()
    node = Customer()
    while not node.client.wait_for_service(timeout_sec=1.0):
        node.say("waiting")
    future = node.client.call_async(node.request())
    rclpy.spin_until_future_complete(node, future)
    node.say(f"sum {future.result().sum}")
    node.destroy_node()
    rclpy.shutdown()


def until_future_complete_with_timeout():
    """The slow adder needs 0.5 s; this waits for 0.2 s at a time."""
    rclpy.init()
    node = Customer()
    future = node.client.call_async(node.request())
    while not future.done():
        rclpy.spin_until_future_complete(node, future, timeout_sec=0.2)
        node.say(f"done {future.done()}")


def spin_once_until_done():
    rclpy.init()
    node = Customer()
    future = node.client.call_async(node.request())
    while rclpy.ok():
        rclpy.spin_once(node)
        if future.done():
            node.say(f"sum {future.result().sum}")
            break


def done_callback():
    rclpy.init()
    node = Customer()
    future = node.client.call_async(node.request())
    future.add_done_callback(lambda future: node.say(f"sum {future.result().sum}"))
    rclpy.spin(node)


def many_calls():
    """All answers come in the order of the questions."""
    rclpy.init()
    node = Customer()
    futures = [node.client.call_async(node.request(a, 1)) for a in range(5)]
    for future in futures:
        rclpy.spin_until_future_complete(node, future)
        node.say(f"sum {future.result().sum}")


def no_one_answers():
    rclpy.init()
    node = Customer()
    node.say(f"there {node.client.wait_for_service(timeout_sec=1.5)}")
    future = node.client.call_async(node.request())
    rclpy.spin_until_future_complete(node, future, timeout_sec=1.0)
    node.say(f"done {future.done()}")


def call_in_a_callback(executor_class, group_class):
    """A program whose timer calls the service and waits, timer and client in one group of this kind."""

    def main():
        rclpy.init()
        node = Customer(group_class())
        executor = executor_class()
        executor.add_node(node)

        def ask():
            node.say(f"sum {node.client.call(node.request()).sum}")

        node.create_timer(1.0, ask, callback_group=node.group)
        executor.spin()

    return main


single_exclusive = call_in_a_callback(SingleThreadedExecutor, MutuallyExclusiveCallbackGroup)
single_reentrant = call_in_a_callback(SingleThreadedExecutor, ReentrantCallbackGroup)
multi_exclusive = call_in_a_callback(MultiThreadedExecutor, MutuallyExclusiveCallbackGroup)
multi_reentrant = call_in_a_callback(MultiThreadedExecutor, ReentrantCallbackGroup)


def spin_in_a_callback():
    """Waits in a callback for an answer that only the same executor could bring, in the default group."""
    rclpy.init()
    node = Customer()

    def ask():
        future = node.client.call_async(node.request())
        rclpy.spin_until_future_complete(node, future)

    node.create_timer(1.0, ask)
    rclpy.spin(node)


def awaits(group_class):
    """A program whose timer is a coroutine that awaits the answer."""

    def main():
        rclpy.init()
        node = Customer(group_class())

        async def ask():
            answer = await node.client.call_async(node.request())
            node.say(f"sum {answer.sum}")

        node.create_timer(1.0, ask, callback_group=node.group)
        rclpy.spin(node)

    return main


await_exclusive = awaits(MutuallyExclusiveCallbackGroup)
await_reentrant = awaits(ReentrantCallbackGroup)


class Wheel(Node):
    """Declares parameters, and learns when they change."""

    def __init__(self):
        super().__init__("wheel")
        self.declare_parameter("radius", 0.1)
        self.declare_parameter("name", "left")
        self.add_on_set_parameters_callback(self.check)
        self.say()

    def say(self):
        values = [self.get_parameter(name).value for name in ("radius", "name")]
        self.get_logger().info(" ".join(str(value) for value in values))

    def check(self, parameters):
        fine = all(p.value > 0 for p in parameters if p.name == "radius")
        return SetParametersResult(successful=fine, reason="" if fine else "a radius is positive")


class WheelThatSetsItself(Wheel):
    def __init__(self):
        super().__init__()
        self.create_timer(1.0, self.change)

    def change(self):
        for value in (0.2, -1.0):
            (result,) = self.set_parameters([Parameter("radius", value=value)])
            self.get_logger().info(f"{value}: {result.successful} {result.reason}".strip())
        self.say()


def parameter_services():
    """Asks another node for its parameters, and sets one, over its services."""
    rclpy.init()
    node = Node("asker")
    client = node.create_client(GetParameters, "/wheel/get_parameters")
    client.wait_for_service()
    future = client.call_async(GetParameters.Request(names=["radius"]))
    rclpy.spin_until_future_complete(node, future)
    node.get_logger().info(f"radius {future.result().values[0].double_value:g}")
    parameters = AsyncParameterClient(node, "wheel")
    parameters.wait_for_services()
    future = parameters.set_parameters([Parameter("radius", value=0.5)])
    rclpy.spin_until_future_complete(node, future)
    node.get_logger().info(f"set {future.result().results[0].successful}")


class AnswersInPairs(Node):
    """Answers with a pair, which its own send_response takes apart, as a library for asyncio does."""

    def __init__(self):
        super().__init__("adder")
        self.service = self.create_service(AddTwoInts, "add", lambda request, response: (response, 5))
        self.send, self.service.send_response = self.service.send_response, self.send_pair

    def send_pair(self, pair, header):
        response, response.sum = pair
        self.send(response, header)


class WatchesItself(Node):
    """Listens to what its own service and client publish of each call."""

    def __init__(self):
        super().__init__("watched")
        service = self.create_service(AddTwoInts, "add", lambda request, response: response)
        self.client = self.create_client(AddTwoInts, "add")
        for end in (service, self.client):
            end.configure_introspection(
                self.get_clock(), qos_profile_services_default, ServiceIntrospectionState.METADATA
            )
        self.create_subscription(AddTwoInts.Event, "add/_service_event", self.on_message, 10)
        self.timer = self.create_timer(1.0, self.ask)

    def ask(self):
        self.timer.cancel()
        self.client.call_async(AddTwoInts.Request())

    def on_message(self, event):
        self.get_logger().info(str(event.info.event_type))
