"""A small system with one of everything. `python -m tests.sim.ros2.nodes` runs it as a program."""

import contextlib

import rclpy
from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts
from geometry_msgs.msg import PointStamped
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult
from rclpy.action import ActionServer
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.lifecycle import LifecycleNode
from rclpy.node import Node, NodeNameNonExistentError
from rclpy.qos import QoSProfile, qos_profile_sensor_data
from std_msgs.msg import Float64, String


class Talker(Node):
    """Publishes its position at 10 Hz, and has parameters of most types."""

    def __init__(self):
        super().__init__("talker")
        kept = QoSProfile(depth=1, durability=rclpy.qos.DurabilityPolicy.TRANSIENT_LOCAL)
        self.greeting = self.create_publisher(String, "greeting", kept)
        self.greeting.publish(String(data="hello"))
        self.place = self.create_publisher(PointStamped, "place", qos_profile_sensor_data)
        self.create_timer(0.1, self.tell)
        limits = FloatingPointRange(from_value=0.0, to_value=2.0)
        speed = ParameterDescriptor(description="How fast it goes", floating_point_range=[limits])
        self.declare_parameter("speed", 0.5, speed)
        self.declare_parameter("label", "robot")
        self.declare_parameter("gains.p", 3)
        self.declare_parameter("steps", [1, 2, 3])
        self.declare_parameter("fixed", True, ParameterDescriptor(read_only=True))
        self.add_on_set_parameters_callback(self.check)

    def tell(self):
        message = PointStamped()
        message.header.stamp = self.get_clock().now().to_msg()
        message.header.frame_id = "map"
        message.point.x = 1.5
        self.place.publish(message)

    def check(self, parameters):
        wrong = any(one.name == "label" and one.value == "" for one in parameters)
        return SetParametersResult(successful=not wrong, reason="it needs a label" if wrong else "")


class Listener(Node):
    """Subscribes to the levels, which only the tests publish."""

    def __init__(self):
        super().__init__("listener", namespace="/upstairs")
        self.create_subscription(Float64, "/level", self.on_message, 10)

    def on_message(self, message):
        self.get_logger().info(f"level {message.data:g}")


class Adder(Node):
    """A service."""

    def __init__(self):
        super().__init__("adder")
        self.create_service(AddTwoInts, "add", self.add)

    def add(self, request, response):
        response.sum = request.a + request.b
        return response


class Counter(Node):
    """An action."""

    def __init__(self):
        super().__init__("counter")
        self.server = ActionServer(self, Fibonacci, "fibonacci", self.count)

    def count(self, goal):
        numbers = [0, 1]
        while len(numbers) <= goal.request.order:
            numbers.append(numbers[-1] + numbers[-2])
            goal.publish_feedback(Fibonacci.Feedback(sequence=numbers))
        goal.succeed() if goal.request.order < 20 else goal.abort()
        return Fibonacci.Result(sequence=numbers)


class Lamp(LifecycleNode):
    """A node with a lifecycle."""

    def __init__(self):
        super().__init__("lamp")


NODES = (Talker, Listener, Adder, Counter, Lamp)
NAMES = ("talker", "/"), ("listener", "/upstairs"), ("adder", "/"), ("counter", "/"), ("lamp", "/")


def known_endpoints(node):
    """How many topics and services of the nodes another one knows by now."""
    queries = (
        node.get_publisher_names_and_types_by_node,
        node.get_subscriber_names_and_types_by_node,
        node.get_service_names_and_types_by_node,
    )
    with contextlib.suppress(NodeNameNonExistentError):
        return sum(len(query(*name)) for query in queries for name in NAMES)
    return 0


def main():
    """All of them in one program, until Ctrl-C. Prints how many topics and services they have."""
    rclpy.init()
    executor = SingleThreadedExecutor()
    nodes = [kind() for kind in NODES]
    for node in nodes:
        executor.add_node(node)
    print(known_endpoints(nodes[0]), flush=True)
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        executor.spin()


if __name__ == "__main__":
    main()
