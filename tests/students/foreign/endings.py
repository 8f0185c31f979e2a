"""Programs that end, hand over, change or restart parts of themselves while they run."""

import asyncio
import contextlib
import threading
import time

import rclpy
from geometry_msgs.msg import Twist
from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.signals import SignalHandlerOptions
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Bool, String
from std_srvs.srv import Empty, Trigger


class Done(Exception):
    """Raised by a callback that has nothing more to do."""


def ends_by_an_exception():
    """A callback leaves spin() by an exception of its own."""
    rclpy.init()
    node = rclpy.create_node("ends")
    outlet = node.create_publisher(String, "chatter", 10)
    left = iter(range(5))

    def tick():
        if next(left, None) is None:
            raise Done
        outlet.publish(String(data="soon"))

    node.create_timer(0.2, tick)
    with contextlib.suppress(Done):
        rclpy.spin(node)
    node.get_logger().info("done")
    node.destroy_node()
    rclpy.shutdown()


def quits_by_system_exit():
    """As the tutorials on unit tests do: SystemExit ends spin()."""
    rclpy.init()
    node = rclpy.create_node("quits")

    def check(message):
        node.get_logger().info("one scan is enough")
        raise SystemExit

    node.create_subscription(LaserScan, "scan", check, 10)
    with contextlib.suppress(SystemExit):
        rclpy.spin(node)
    rclpy.try_shutdown()


def shuts_down_in_a_callback():
    rclpy.init()
    node = rclpy.create_node("shuts_down")
    node.create_service(Empty, "quit", lambda request, response: response)
    node.create_timer(1.0, rclpy.shutdown)
    with contextlib.suppress(ExternalShutdownException):
        rclpy.spin(node)


def stops_the_robot_on_ctrl_c():
    """Handles Ctrl-C itself, so that it can still publish."""
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    node = rclpy.create_node("drives")
    outlet = node.create_publisher(Twist, "cmd_vel", 10)
    forward = Twist()
    forward.linear.x = 0.1
    node.create_timer(0.1, lambda: outlet.publish(forward))
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        outlet.publish(Twist())
        node.get_logger().info("stopped")
    finally:
        node.destroy_node()
        rclpy.shutdown()


class ChangesItsTopic(Node):
    """A parameter names its topic, and its publisher is made anew when that changes."""

    def __init__(self):
        super().__init__("changes")
        self.declare_parameter("topic", "first")
        self.declare_parameter("serial", 7, ParameterDescriptor(read_only=True))
        self.outlet = None
        self.open("first")
        self.add_on_set_parameters_callback(self.check)
        self.create_timer(0.3, lambda: self.outlet.publish(String(data="here")))
        self.change = self.create_timer(1.0, self.rename)

    def open(self, topic):
        if self.outlet is not None:
            self.destroy_publisher(self.outlet)
        self.outlet = self.create_publisher(String, topic, 10)

    def check(self, parameters):
        for parameter in parameters:
            if parameter.name == "topic":
                self.open(parameter.value)
        return SetParametersResult(successful=True)

    def rename(self):
        self.destroy_timer(self.change)
        self.set_parameters([Parameter("topic", value="second")])


class Supervises(Node):
    """Drives until a second node of its program takes over."""

    def __init__(self, name, begin, end):
        super().__init__(name)
        self.begin, self.end, self.ticks = begin, end, 0
        self.outlet = self.create_publisher(Twist, "cmd_vel", 10)
        self.active = self.create_publisher(Bool, f"{name}/active", 10)
        self.create_timer(0.1, self.tick)

    def tick(self):
        self.ticks += 1
        drives = self.begin <= self.ticks < self.end
        self.active.publish(Bool(data=drives))
        if drives:
            command = Twist()
            command.angular.z = 0.3
            self.outlet.publish(command)


def hands_over():
    """Two drivers, one after the other."""
    rclpy.init()
    executor = rclpy.executors.SingleThreadedExecutor()
    for node in (Supervises("one", 0, 12), Supervises("other", 12, 10_000)):
        executor.add_node(node)
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        executor.spin()


def bridges_to_asyncio():
    """asyncio has the main thread; callbacks pass what they receive to its queue."""

    async def main():
        loop, queue = asyncio.get_running_loop(), asyncio.Queue()
        node = rclpy.create_node("bridge")
        outlet = node.create_publisher(String, "nearest", 10)
        node.create_subscription(
            LaserScan, "scan", lambda scan: loop.call_soon_threadsafe(queue.put_nowait, scan), 10
        )
        threading.Thread(target=spin_quietly, args=(node,), daemon=True).start()
        while rclpy.ok():
            scan = await queue.get()
            outlet.publish(String(data=f"{min(scan.ranges):.2f}"))

    rclpy.init()
    with contextlib.suppress(KeyboardInterrupt):
        asyncio.run(main())


def spin_quietly(node):
    with contextlib.suppress(ExternalShutdownException):
        rclpy.spin(node)


def fire_and_forget():
    """Calls a service without a look at the answer, and sleeps between two calls."""
    rclpy.init()
    node = rclpy.create_node("forgets")
    client = node.create_client(Trigger, "reset_counts")
    threading.Thread(target=spin_quietly, args=(node,), daemon=True).start()
    with contextlib.suppress(KeyboardInterrupt):
        while rclpy.ok():
            if client.service_is_ready():
                client.call_async(Trigger.Request())
            time.sleep(0.5)
    node.destroy_node()


class ResetsCounts(Node):
    def __init__(self):
        super().__init__("resets")
        self.count = 0
        self.create_service(Trigger, "reset_counts", self.reset)
        self.create_timer(0.1, self.tick)

    def tick(self):
        self.count += 1

    def reset(self, request, response):
        response.success, response.message, self.count = True, f"it was {self.count}", 0
        return response


CORPUS = [
    (ends_by_an_exception,),
    (quits_by_system_exit,),
    (shuts_down_in_a_callback,),
    (stops_the_robot_on_ctrl_c,),
    (ChangesItsTopic,),
    (hands_over,),
    (bridges_to_asyncio,),
    (fire_and_forget, ResetsCounts),
]
