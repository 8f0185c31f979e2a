"""Servers that add: right ones, and wrong ones named by their defect."""

import time
from functools import partial

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Adder(Node):
    """As in the assignment, with the line filled in."""

    type, service = AddTwoInts, "/add_two_ints"

    def __init__(self):
        super().__init__("adder")
        self.create_service(self.type, self.service, self.add)

    def add(self, request, response):
        response.sum = request.a + request.b
        return response


class SumServer(Node):
    """A whole program, in the form that tutorials show."""

    def __init__(self):
        super().__init__("sum_server")
        self.service = self.create_service(AddTwoInts, "add_two_ints", self.handle_sum)
        self.get_logger().info("Ready to add two ints.")

    def handle_sum(self, request, response):
        response.sum = request.a + request.b
        self.get_logger().info("%d + %d = %d" % (request.a, request.b, response.sum))  # noqa: UP031
        return response


def main(args=None):
    rclpy.init(args=args)
    sum_server = SumServer()
    try:
        rclpy.spin(sum_server)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        sum_server.destroy_node()
        rclpy.try_shutdown()


class AsyncAdder(Adder):
    """A design of its own: a coroutine answers."""

    async def add(self, request, response):
        response.sum = request.a + request.b
        return response


class AdderWithNewResponse(Adder):
    """Makes a response of its own."""

    def add(self, request, response):
        return AddTwoInts.Response(sum=request.a + request.b)


def main_with_function_and_threads():
    rclpy.init()
    node = rclpy.create_node("adder")

    def add(node, request, response):
        node.get_logger().info(f"{request.a} + {request.b}")
        response.sum = request.a + request.b
        return response

    node.create_service(
        AddTwoInts, "add_two_ints", partial(add, node), callback_group=ReentrantCallbackGroup()
    )
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(node)
    try:
        executor.spin()
    finally:
        executor.shutdown()
        node.destroy_node()
        rclpy.try_shutdown()


class SlowAdder(Adder):
    """Takes its time, and is right."""

    def add(self, request, response):
        time.sleep(0.4)
        return super().add(request, response)


class MisspeltService(Adder):
    service = "/add_to_ints"


class ServiceInNamespace(Adder):
    service = "~/add_two_ints"


class AnotherType(Adder):
    type = Trigger


class NoService(Adder):
    def __init__(self):
        Node.__init__(self, "adder")


class NameBeforeType(Adder):
    def __init__(self):
        Node.__init__(self, "adder")
        self.create_service("/add_two_ints", AddTwoInts, self.add)


class CallsTheCallback(Adder):
    def __init__(self):
        Node.__init__(self, "adder")
        self.create_service(AddTwoInts, "/add_two_ints", self.add())


class NoCallback(Adder):
    def __init__(self):
        Node.__init__(self, "adder")
        self.create_service(AddTwoInts, "/add_two_ints")


class ForgetsReturn(Adder):
    def add(self, request, response):
        response.sum = request.a + request.b


class ReturnsTheNumber(Adder):
    def add(self, request, response):
        return request.a + request.b


class SumNeverSet(Adder):
    def add(self, request, response):
        return response


class Multiplies(Adder):
    def add(self, request, response):
        response.sum = request.a * request.b
        return response


class CallbackWithoutResponse(Adder):
    def add(self, request):
        return AddTwoInts.Response(sum=request.a + request.b)


class DecimalSum(Adder):
    def add(self, request, response):
        response.sum = float(request.a + request.b)
        return response


class UnknownField(Adder):
    def add(self, request, response):
        response.sum = request.x + request.y
        return response


class NeverComesBack(Adder):
    """A loop without end in the callback."""

    def add(self, request, response):
        while True:
            pass


class ObjectForType(Adder):
    def __init__(self):
        Node.__init__(self, "adder")
        self.create_service(AddTwoInts(), "/add_two_ints", self.add)
