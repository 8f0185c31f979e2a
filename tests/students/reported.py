"""Small nodes with the mistakes that people report most often on public trackers, and their partners."""

import asyncio
import contextlib
import threading
import time

import rclpy
from example_interfaces.action import Fibonacci
from geometry_msgs.msg import TransformStamped
from lifecycle_msgs.srv import ChangeState
from rcl_interfaces.srv import SetParameters
from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.lifecycle import LifecycleNode
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String
from tf2_ros import Buffer, StaticTransformBroadcaster, TransformBroadcaster, TransformListener

from sim import Process


def spin(node, executor):
    executor.add_node(node)
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        executor.spin()


class Ticker(Node):
    def __init__(self):
        super().__init__("ticker")
        self.create_timer(0.1, self.get_clock().now)


def spun_by_two_executors():
    rclpy.init()
    node, first = Ticker(), SingleThreadedExecutor()
    first.add_node(node)
    threading.Thread(target=first.spin, daemon=True).start()
    spin(node, SingleThreadedExecutor())


def spun_once_beside_its_executor():
    rclpy.init()
    node = Ticker()
    threading.Thread(target=spin, args=(node, MultiThreadedExecutor()), daemon=True).start()
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=0.1)


class PausesWithAsyncio(Node):
    def __init__(self):
        super().__init__("pauser")
        self.create_timer(0.5, self.tick)

    async def tick(self):
        await asyncio.sleep(0.1)


class Scanner(Node):
    """Publishes scans five times a second, and its transform only twice."""

    def __init__(self):
        super().__init__("scanner")
        self.broadcaster = TransformBroadcaster(self)
        self.publisher = self.create_publisher(LaserScan, "scan", 10)
        self.create_timer(0.5, self.broadcast)
        self.create_timer(0.2, self.scan)

    def broadcast(self):
        transform = TransformStamped(child_frame_id="base")
        transform.header.stamp, transform.header.frame_id = self.get_clock().now().to_msg(), "world"
        self.broadcaster.sendTransform(transform)

    def scan(self):
        scan = LaserScan()
        scan.header.stamp, scan.header.frame_id = self.get_clock().now().to_msg(), "base"
        self.publisher.publish(scan)


class LooksUpAtTheStamp(Node):
    frame = "world"

    def __init__(self):
        super().__init__("mapper")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.create_timer(1.1, self.begin)

    def begin(self):
        self.create_subscription(LaserScan, "scan", self.take, 10)

    def take(self, scan):
        self.buffer.lookup_transform(self.frame, scan.header.frame_id, self.when(scan))

    def when(self, scan):
        return scan.header.stamp


class LooksUpTooOld(LooksUpAtTheStamp):
    def when(self, scan):
        return rclpy.time.Time(seconds=1_735_689_600, clock_type=rclpy.clock.ClockType.ROS_TIME)


class LooksUpAMisspeltFrame(LooksUpAtTheStamp):
    frame = "wrold"


class LooksUpAnIsland(LooksUpAtTheStamp):
    frame = "sea"

    def when(self, scan):
        return rclpy.time.Time()


def island():
    """Publishes a transform that is not connected with the scanner's."""
    node = Node("island")
    sent = TransformStamped(child_frame_id="island")
    sent.header.frame_id, sent.transform.rotation.w = "sea", 1.0
    node.broadcaster = StaticTransformBroadcaster(node)
    node.broadcaster.sendTransform(sent)
    return node


class Camera(LifecycleNode):
    def __init__(self):
        super().__init__("camera")


class ActivatesItself(Camera):
    def __init__(self):
        super().__init__()
        self.create_timer(0.5, self.trigger_activate)


class ActivatesTooEarly(Node):
    def __init__(self):
        super().__init__("manager")
        self.client = self.create_client(ChangeState, "/camera/change_state")
        self.timer = self.create_timer(0.5, self.activate)

    def activate(self):
        self.timer.cancel()
        request = ChangeState.Request()
        request.transition.id = 3
        self.client.call_async(request)


class Named(Node):
    def __init__(self):
        super().__init__("named")
        self.declare_parameter("names", [])


def named_at_the_start():
    return Process(Named, parameters={"names": ["a", "b"]})


class NamesOthers(Node):
    def __init__(self):
        super().__init__("setter")
        self.client = self.create_client(SetParameters, "/named/set_parameters")
        self.timer = self.create_timer(0.5, self.set)

    def set(self):
        self.timer.cancel()
        names = Parameter("names", value=["a", "b"]).to_parameter_msg()
        self.client.call_async(SetParameters.Request(parameters=[names]))


class Counting(Node):
    """Counts for two seconds. held: what its cancel callback sleeps, s."""

    held = 2.0

    def __init__(self):
        super().__init__("counting")
        group = ReentrantCallbackGroup()
        self.server = ActionServer(
            self, Fibonacci, "count", self.execute, callback_group=group, cancel_callback=self.on_cancel
        )

    def on_cancel(self, goal):
        time.sleep(self.held)
        return CancelResponse.ACCEPT

    def execute(self, goal):
        for _ in range(20):
            if goal.is_cancel_requested:
                goal.canceled()
                return Fibonacci.Result()
            time.sleep(0.1)
        goal.succeed()
        return Fibonacci.Result()


class CountingPromptly(Counting):
    held = 0.0


def sleeps_in_its_cancel_callback():
    rclpy.init()
    spin(Counting(), MultiThreadedExecutor())


def cancels_promptly():
    rclpy.init()
    spin(CountingPromptly(), MultiThreadedExecutor())


class Canceling(Node):
    after = 1.0

    def __init__(self):
        super().__init__("canceling")
        self.client = ActionClient(self, Fibonacci, "count")
        self.timer = self.create_timer(0.1, self.begin)

    def begin(self):
        self.timer.cancel()
        self.client.wait_for_server()
        self.client.send_goal_async(Fibonacci.Goal(order=3)).add_done_callback(self.accepted)

    def accepted(self, future):
        self.goal = future.result()
        self.timer = self.create_timer(self.after, self.cancel)

    def cancel(self):
        self.timer.cancel()
        self.goal.cancel_goal_async()


class CancelingInTheLastMoment(Canceling):
    after = 1.95


class Once(Node):
    def __init__(self):
        super().__init__("once")
        self.create_publisher(String, "chatter", 10).publish(String(data="hello"))


LATCHED = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class OnceWithALifespan(Node):
    def __init__(self):
        super().__init__("once")
        qos = QoSProfile(depth=10, lifespan=Duration(seconds=0.1), durability=LATCHED.durability)
        self.publisher = self.create_publisher(String, "chatter", qos)
        self.timer = self.create_timer(0.5, self.tick)

    def tick(self):
        self.publisher.publish(String(data="hello"))
        self.timer.cancel()


class Listener(Node):
    qos = 10

    def __init__(self):
        super().__init__("listener")
        self.create_subscription(String, "chatter", self.take, self.qos)

    def take(self, message):
        self.get_logger().info(message.data)


class LatchedListener(Listener):
    qos = LATCHED


def listens_late():
    time.sleep(1.0)
    rclpy.init()
    spin(Listener(), SingleThreadedExecutor())


def listens_late_to_latched():
    time.sleep(1.0)
    rclpy.init()
    spin(LatchedListener(), SingleThreadedExecutor())
