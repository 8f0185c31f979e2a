"""Right programs in styles that beginners' courses don't show, each for a diagnosis that could mistake it."""

import contextlib
import threading

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.parameter_event_handler import ParameterEventHandler
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.wait_for_message import wait_for_message
from std_msgs.msg import Int64, String


def spin(node, executor=None):
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(node, executor)


class NumberCounter(Node):
    """Passes on what no one sends yet."""

    def __init__(self):
        super().__init__("number_counter")
        self.create_subscription(Int64, "number", self.add, 10)
        self.publisher = self.create_publisher(Int64, "new_number", 10)

    def add(self, message):
        self.publisher.publish(message)


class WatchesParameters(Node):
    def __init__(self):
        super().__init__("watcher")
        self.handler = ParameterEventHandler(self)
        self.handler.add_parameter_callback("speed", "robot", self.changed)

    def changed(self, parameter):
        self.get_logger().info(str(parameter))


class HoldsParameters(Node):
    def __init__(self):
        super().__init__("blackboard")
        self.declare_parameters("", [("max_speed", 1.0), ("robot", "anna")])


def plain_functions():
    rclpy.init()
    node = rclpy.create_node("talker")
    publisher = node.create_publisher(String, "chatter", 10)
    node.create_timer(0.5, lambda: publisher.publish(String(data="hello")))
    spin(node)


def takes_one_message():
    rclpy.init()
    node = rclpy.create_node("taker")
    wait_for_message(String, node, "/chatter", time_to_wait=3.0)
    node.destroy_node()
    rclpy.shutdown()


def loops_by_itself():
    rclpy.init()
    node = rclpy.create_node("loop")
    publisher = node.create_publisher(String, "chatter", 10)
    rate = node.create_rate(5)
    threading.Thread(target=spin, args=(node,), daemon=True).start()
    while rclpy.ok():
        publisher.publish(String(data="hello"))
        try:
            rate.sleep()
        except rclpy.exceptions.ROSInterruptException:
            break


def looks_at_the_graph():
    rclpy.init()
    node = rclpy.create_node("looker")
    rclpy.spin_once(node, timeout_sec=1.0)
    print(node.get_topic_names_and_types())
    node.destroy_node()
    rclpy.shutdown()


def two_nodes_in_one_program():
    rclpy.init()
    executor = MultiThreadedExecutor()
    for node in (NumberCounter(), HoldsParameters()):
        executor.add_node(node)
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        executor.spin()


def spins_one_executor_after_another():
    rclpy.init()
    node = rclpy.create_node("client")
    client = node.create_client(AddTwoInts, "add")
    client.wait_for_service()
    rclpy.spin_until_future_complete(node, client.call_async(AddTwoInts.Request(a=1, b=2)))
    spin(node, MultiThreadedExecutor())


class Adder(Node):
    def __init__(self):
        super().__init__("adder")
        self.create_service(AddTwoInts, "add", self.add)

    def add(self, request, response):
        response.sum = request.a + request.b
        return response


class LatchesOnce(Node):
    qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)

    def __init__(self):
        super().__init__("map_server")
        self.create_publisher(String, "chatter", self.qos).publish(String(data="map"))


class TakesWhatIsLatched(Node):
    def __init__(self):
        super().__init__("map_client")
        self.create_subscription(String, "chatter", self.take, LatchesOnce.qos)

    def take(self, message):
        self.get_logger().info(message.data)


class DrivesRobot1(Node):
    """Numbered names of two robots, of which the other is not there."""

    def __init__(self):
        super().__init__("driver")
        self.publisher = self.create_publisher(String, "/robot1/command", 10)
        self.create_timer(0.5, lambda: self.publisher.publish(String()))


class IsRobot2(Node):
    def __init__(self):
        super().__init__("robot2")
        self.create_subscription(String, "/robot2/command", self.take, 10)

    def take(self, message):
        self.get_logger().info(message.data)


CORPUS = [
    (NumberCounter,),
    (WatchesParameters,),
    (HoldsParameters,),
    (plain_functions,),
    (plain_functions, takes_one_message),
    (loops_by_itself,),
    (looks_at_the_graph, plain_functions),
    (two_nodes_in_one_program,),
    (Adder, spins_one_executor_after_another),
    (LatchesOnce, TakesWhatIsLatched),
    (DrivesRobot1, IsRobot2),
    (NumberCounter, plain_functions),
]
