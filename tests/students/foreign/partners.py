"""Nodes of several parts: zero is an answer, names are alike, nodes hold nodes, timers end."""

import contextlib
import math
import time

import rclpy
from example_interfaces.srv import AddTwoInts, Trigger
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.time import Time
from std_msgs.msg import Float64
from tf2_ros import Buffer, TransformException, TransformListener


class Adder(Node):
    def __init__(self):
        super().__init__("adder")
        self.create_service(AddTwoInts, "add", self.add)

    def add(self, request, response):
        response.sum = request.a + request.b
        return response


class AddsZeros(Node):
    def __init__(self):
        super().__init__("adds_zeros")
        self.client = self.create_client(AddTwoInts, "add")
        self.create_timer(0.5, self.tick)

    def tick(self):
        self.client.call_async(AddTwoInts.Request()).add_done_callback(self.log)

    def log(self, future):
        self.get_logger().info(str(future.result()))


class IsMoving(Node):
    """Says no: the robot stands."""

    def __init__(self):
        super().__init__("is_moving")
        self.moving = False
        self.create_subscription(Odometry, "/odom", self.receive, 10)
        self.create_service(Trigger, "is_moving", self.answer)
        self.create_service(Trigger, "is_moving_now", self.answer_with_new)

    def receive(self, message):
        self.moving = abs(message.twist.twist.linear.x) > 0.01

    def answer(self, request, response):
        response.success = self.moving
        return response

    def answer_with_new(self, request, response):
        return Trigger.Response(success=self.moving)


class AsksWhetherItMoves(AddsZeros):
    service = "is_moving"

    def __init__(self):
        Node.__init__(self, "asks")
        self.client = self.create_client(Trigger, self.service)
        self.create_timer(0.5, self.tick)

    def tick(self):
        self.client.call_async(Trigger.Request()).add_done_callback(self.log)


class AsksWhetherItMovesNow(AsksWhetherItMoves):
    service = "is_moving_now"


class WarmsUp(Node):
    """Its timer ends after a while; later a service works for most of a second."""

    def __init__(self):
        super().__init__("warms_up")
        self.count = 0
        self.timer = self.create_timer(0.1, self.tick)
        self.create_service(Trigger, "work", self.work)

    def tick(self):
        self.count += 1
        if self.count == 5:
            self.timer.cancel()
            self.get_logger().info("warm")

    def work(self, request, response):
        time.sleep(0.8)
        response.success = True
        return response


class WantsWork(AddsZeros):
    def __init__(self):
        Node.__init__(self, "wants_work")
        self.client = self.create_client(Trigger, "work")
        self.timer = self.create_timer(1.0, self.tick)

    def tick(self):
        self.timer.cancel()
        self.client.call_async(Trigger.Request()).add_done_callback(self.log)


class Publishes(Node):
    def __init__(self, topic):
        super().__init__("publishes_" + topic)
        publisher = self.create_publisher(Float64, topic, 10)
        self.create_timer(0.2, lambda: publisher.publish(Float64()))


class Subscribes(Node):
    def __init__(self, topic):
        super().__init__("subscribes_" + topic)
        self.create_subscription(Float64, topic, lambda message: self.get_logger().info("received"), 10)


def spin(*nodes):
    executor = SingleThreadedExecutor()
    for node in nodes:
        executor.add_node(node)
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        executor.spin()


class Container(Node):
    """Holds the nodes of its program, and does nothing else."""

    def __init__(self):
        super().__init__("container")
        self.parts = Publishes("number"), Subscribes("number")


def container():
    rclpy.init()
    node = Container()
    spin(node, *node.parts)


class WantsCommands(Node):
    """For a node that passes commands on, and takes no part in this run."""

    def __init__(self):
        super().__init__("wants_commands")
        self.publisher = self.create_publisher(Twist, "cmd_vel_in", 10)
        self.create_timer(0.1, lambda: self.publisher.publish(Twist()))


class ListensInAThread(Node):
    """tf2_ros spins the node in a thread, and so does main()."""

    def __init__(self):
        super().__init__("listens")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self, spin_thread=True)
        self.create_timer(0.1, self.tick)

    def tick(self):
        with contextlib.suppress(TransformException):
            found = self.buffer.lookup_transform("odom", "base_link", Time()).transform.translation
            self.get_logger().info(f"{math.hypot(found.x, found.y):.2f} m", throttle_duration_sec=1.0)


ALIKE = (
    ("global_plan", "local_plan"),
    ("ping", "pong"),
    ("enable_motor", "disable_motor"),
    ("increase", "decrease"),
    ("lock", "unlock"),
    ("speed_set", "speed_get"),
    ("speed", "set_speed"),
    ("height", "weight"),
)


def unconnected(published, subscribed):
    """A program whose two nodes have another partner each, which take no part in the run."""

    def program():
        rclpy.init()
        spin(Publishes(published), Subscribes(subscribed))

    program.__name__ = f"{published}_and_{subscribed}"
    return program


CORPUS = [
    (Adder, AddsZeros),
    (IsMoving, AsksWhetherItMoves),
    (IsMoving, AsksWhetherItMovesNow),
    (WarmsUp, WantsWork),
    (container,),
    (WantsCommands,),
    (ListensInAThread,),
    *((unconnected(*names),) for names in ALIKE),
]
