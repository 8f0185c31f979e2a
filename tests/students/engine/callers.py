"""Services and clients in unusual numbers, at unusual times, and with unusual classes."""

import threading
import time

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node
from rclpy.qos import QoSProfile

from tests.students.engine.services import Adder, Customer


class Second(Customer):
    """Another client of the adder, which asks the same at the same time."""

    def __init__(self):
        Node.__init__(self, "second")
        self.client = self.create_client(AddTwoInts, "add")
        self.client.service_is_ready()
        self.client.call_async(self.request())


class First(Customer):
    def __init__(self):
        super().__init__()
        self.client.call_async(self.request())


class AsksAtOnce(Node):
    """Asks the moment its client is made, twice without a look, and then with one: only that is answered."""

    def __init__(self):
        super().__init__("customer")
        self.ask(5)
        self.timer = self.create_timer(1.0, self.again)

    def ask(self, number, looks=False):
        client = self.create_client(AddTwoInts, "add")
        if looks:
            client.wait_for_service()
        client.call_async(AddTwoInts.Request(a=number)).add_done_callback(self.on_response)
        return client

    def again(self):
        self.timer.cancel()
        client = self.ask(6)
        self.ask(7, looks=True)
        self.create_timer(0.5, lambda: client.call_async(AddTwoInts.Request(a=8)))

    def on_response(self, future):
        self.get_logger().info(f"sum {future.result().sum}")


def asks_itself_at_once():
    """A program that has the server, too, needs no time to find it."""
    rclpy.init()
    executor = rclpy.executors.SingleThreadedExecutor()
    for node in (Adder(), AsksAtOnce()):
        executor.add_node(node)
    executor.spin()


class OtherAdder(Adder):
    """Offers the same service from another node, and adds one more."""

    def __init__(self):
        Node.__init__(self, "other")
        self.create_service(AddTwoInts, "add", self.add)

    def add(self, request, response):
        response.sum = request.a + request.b + 1
        return response


def two_servers():
    """Both in one program, so that their order is known."""
    rclpy.init()
    executor = rclpy.executors.SingleThreadedExecutor()
    for node in (Adder(), OtherAdder()):
        executor.add_node(node)
    executor.spin()


class Flood(Customer):
    """Sends twelve requests at once; a service keeps ten."""

    def __init__(self):
        super().__init__()
        self.create_timer(1.0, self.ask)

    def ask(self):
        for number in range(12):
            self.client.call_async(self.request(number, 0))


class ShortMemory(Adder):
    """A service that keeps only the last two requests."""

    def __init__(self):
        Node.__init__(self, "adder")
        self.create_service(AddTwoInts, "add", self.add, qos_profile=QoSProfile(depth=2))


class Raises(Adder):
    def add(self, request, response):
        raise ValueError("no sum today")


class ReturnsText(Adder):
    def add(self, request, response):
        return "5"


class ChangesTheRequest(Adder):
    def add(self, request, response):
        request.a, request.b = 100, 100
        response.sum = 5
        return response


class OddResponse(AddTwoInts.Response):
    """A response whose field raises when it is read a second time."""

    def __init__(self):
        super().__init__(sum=5)
        self.reads = 0

    @property
    def sum(self):
        self.reads += 1
        if self.reads > 1:
            raise KeyError("read once")
        return 5

    @sum.setter
    def sum(self, value):
        pass


class ReturnsAnOddResponse(Adder):
    def add(self, request, response):
        return OddResponse()


def asks_with_text():
    rclpy.init()
    node = Customer()
    try:
        node.client.call_async("2 + 3")
    except TypeError as error:
        node.say(str(error))
    node.client.call("2 + 3")


def calls_from_a_thread():
    """Client.call() blocks a thread while main() spins."""
    rclpy.init()
    node = Customer()

    def ask():
        time.sleep(1.0)
        node.say(f"sum {node.client.call(node.request()).sum}")

    threading.Thread(target=ask, daemon=True).start()
    rclpy.spin(node)


def goes_away():
    """Asks, and is gone before the slow adder answers."""
    rclpy.init()
    node = Customer()
    node.client.call_async(node.request())
    node.destroy_node()
    rclpy.shutdown()


def gives_up():
    """Client.call() with a timeout; the answer comes too late, and it is not reported."""
    rclpy.init()
    node = Customer()
    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
    node.say(f"{node.client.call(node.request(), timeout_sec=0.2)}")
    time.sleep(1.0)


def never_spins():
    rclpy.init()
    node = Customer()
    future = node.client.call_async(node.request())
    while not future.done():
        time.sleep(0.1)


def asks_past_the_client():
    """Sends a request with the insides of rclpy's client."""
    rclpy.init()
    node = Customer()
    node.client.handle.send_request(node.request())
    rclpy.spin(node)


class CallsForEver(Customer):
    def __init__(self):
        super().__init__()
        self.create_timer(1.0, self.ask)

    def ask(self):
        while True:
            self.client.call_async(self.request())


class OwnCall(Customer):
    """Replaces rclpy's method by its own, which calls it."""

    def __init__(self):
        super().__init__()
        call_async, self.client.call_async = self.client.call_async, self.ask
        call_async(self.request(1, 1))
        self.client.call_async(self.request(2, 2), call_async)

    def ask(self, request, call_async):
        return call_async(request)


class ForgetsPendingRequests(Customer):
    """Clears what its client waits for: the answers come to no one."""

    def __init__(self):
        super().__init__()
        self.client.call_async(self.request())
        self.client._pending_requests.clear()


class DestroysItsService(Adder):
    """Takes one request, and offers the service no more."""

    def __init__(self):
        Node.__init__(self, "adder")
        self.service = self.create_service(AddTwoInts, "add", self.add)

    def add(self, request, response):
        self.create_timer(0.5, lambda: self.destroy_service(self.service))
        return super().add(request, response)


class OncePerSecond(Customer):
    def __init__(self):
        super().__init__()
        self.create_timer(1.0, lambda: self.client.call_async(self.request()))
