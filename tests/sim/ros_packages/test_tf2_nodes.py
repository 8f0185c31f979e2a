"""Listeners and broadcasters as tutorials have them, in runs: node, buffer and time work together."""

import math

import pytest
import rclpy
from geometry_msgs.msg import TransformStamped, Twist
from nav_msgs.msg import Odometry
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from tf2_msgs.msg import TFMessage
from tf2_msgs.srv import FrameGraph
from tf2_ros import (
    Buffer,
    StaticTransformBroadcaster,
    TransformBroadcaster,
    TransformException,
    TransformListener,
)
from tf_transformations import euler_from_quaternion, quaternion_from_euler

from sim import run


class Mount(Node):
    """Says once where the lidar sits."""

    def __init__(self):
        super().__init__("mount")
        self.broadcaster = StaticTransformBroadcaster(self)
        self.broadcaster.sendTransform(fixed("base_link", "base_scan", 0.2))
        self.broadcaster.sendTransform([fixed("base_link", "camera", 0.1)])


class Copy(Node):
    """Broadcasts where odometry has the robot, as another frame."""

    def __init__(self):
        super().__init__("copy")
        self.broadcaster = TransformBroadcaster(self)
        self.create_subscription(Odometry, "odom", self.on_message, 10)
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_timer(0.1, self.drive)

    def drive(self):
        command = Twist()
        command.linear.x, command.angular.z = 0.2, 0.5
        self.publisher.publish(command)

    def on_message(self, odom):
        sent = fixed("odom", "copy", odom.pose.pose.position.x)
        sent.header.stamp = odom.header.stamp
        sent.transform.translation.y = odom.pose.pose.position.y
        turn = odom.pose.pose.orientation
        yaw = euler_from_quaternion([turn.x, turn.y, turn.z, turn.w])[2]
        x, y, z, w = quaternion_from_euler(0, 0, yaw)
        turn = sent.transform.rotation
        turn.x, turn.y, turn.z, turn.w = float(x), float(y), float(z), float(w)
        self.broadcaster.sendTransform(sent)


class Listener(Node):
    """Looks up the pose of the lidar for a second and publishes what it measures."""

    def __init__(self):
        super().__init__("listener")
        self.buffer = Buffer(node=self)
        self.listener = TransformListener(self.buffer, self)
        self.create_timer(0.25, self.look)

    def look(self):
        try:
            found = self.buffer.lookup_transform("odom", "base_scan", Time())
        except TransformException as ex:
            self.get_logger().info(f"Could not transform: {ex}")
            return
        self.get_logger().info(f"{found.transform.translation.x:.3f} {found.transform.translation.y:.3f}")


class Awaiting(Node):
    """Waits for a frame that comes later, and for one that is there."""

    def __init__(self):
        super().__init__("awaiting")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self, tf_topic="/later")
        self.sender = self.create_publisher(TFMessage, "/later", 10)
        self.start = self.create_timer(0.1, self.look)
        self.wake = self.create_timer(1.0, self.send, callback_group=ReentrantCallbackGroup())

    async def look(self):
        self.start.cancel()
        found = await self.buffer.lookup_transform_async("a", "b", Time())
        again = await self.buffer.lookup_transform_full_async("a", Time(), "b", Time(), "a")
        self.get_logger().info(f"{found.transform.translation.x:g} {again == found}")

    def send(self):
        self.sender.publish(TFMessage(transforms=[fixed("a", "b", 3.0)]))


def own_thread():
    """A main() that waits in its own thread while the listener spins in another."""
    rclpy.init()
    node = rclpy.create_node("patient")
    buffer = Buffer()
    listener = TransformListener(buffer, node, spin_thread=True)
    soon = node.get_clock().now() + Duration(seconds=1)
    found = buffer.lookup_transform("odom", "base_link", soon, timeout=Duration(seconds=3))
    node.get_logger().info(f"{(soon - Time.from_msg(found.header.stamp)).nanoseconds} ns off")
    listener.executor.shutdown()
    node.destroy_node()
    rclpy.shutdown()


class Asking(Node):
    """Asks the listener's service for its frames."""

    def __init__(self):
        super().__init__("asking")
        self.client = self.create_client(FrameGraph, "tf2_frames", callback_group=ReentrantCallbackGroup())
        self.timer = self.create_timer(1.0, self.look_up)

    async def look_up(self):
        self.timer.cancel()
        answer = await self.client.call_async(FrameGraph.Request())
        self.get_logger().info(answer.frame_yaml)


def fixed(parent: str, child: str, x: float) -> TransformStamped:
    sent = TransformStamped(child_frame_id=child)
    sent.header.frame_id = parent
    sent.transform.translation.x, sent.transform.rotation.w = x, 1.0
    return sent


def lines(recording) -> list[str]:
    assert [error.says for error in recording.errors] == []
    return [line.text for line in recording.logs if not line.from_course]


@pytest.fixture(scope="module")
def listened():
    return run(Mount, Copy, Listener, Asking, world="yard", seconds=2, quiet=True)


def test_a_listener_finds_what_robots_and_static_broadcasters_say(listened):
    positions = [line for line in lines(listened) if "parent" not in line]
    assert len(positions) == 8
    x, y = map(float, positions[-1].split())
    pose = listened.pose_at(1.95)
    assert x == pytest.approx(pose.x + 0.2 * math.cos(pose.yaw), abs=0.01)
    assert y == pytest.approx(pose.y + 0.2 * math.sin(pose.yaw), abs=0.01)


def test_a_broadcast_frame_has_the_pose_that_was_sent(listened):
    frames = {
        one.child_frame_id: one for message in listened.messages("/tf") for one in message.message.transforms
    }
    assert frames["copy"].transform == frames["base_link"].transform


def test_a_static_message_contains_all_that_was_sent_before(listened):
    sent = [
        [one.child_frame_id for one in message.message.transforms]
        for message in listened.messages("/tf_static")
        if message.sender == "/mount"
    ]
    assert sent == [["base_scan"], ["base_scan", "camera"]]


def test_a_buffer_with_a_node_offers_its_frames_as_a_service(listened):
    yaml = next(line for line in lines(listened) if "parent" in line)
    assert "base_scan: \n  parent: 'base_link'" in yaml


def test_topics_have_upstreams_settings(listened):
    ends = {(end.node, end.name): end.qos for end in listened.graph.ends("subscription")}
    assert (
        ends["/listener", "/tf"] | {"durability": "volatile", "reliability": "reliable", "depth": 100}
        == ends["/listener", "/tf"]
    )
    assert ends["/listener", "/tf_static"]["durability"] == "transient_local"
    ends = {(end.node, end.name): end.qos for end in listened.graph.ends("publisher")}
    assert (ends["/mount", "/tf_static"]["durability"], ends["/mount", "/tf_static"]["depth"]) == (
        "transient_local",
        1,
    )
    assert (ends["/copy", "/tf"]["durability"], ends["/copy", "/tf"]["depth"]) == ("volatile", 100)


def test_a_coroutine_awaits_a_transform():
    recording = run(Awaiting, seconds=2, quiet=True)
    assert lines(recording) == ["3 True"]
    assert recording.logs[0].stamp == pytest.approx(1.0)


def test_a_listener_with_a_thread_of_its_own_receives_while_main_waits():
    recording = run(own_thread, world="yard", seconds=3, quiet=True)
    assert lines(recording) == ["0 ns off"]


def test_equal_runs_are_equal(listened):
    assert run(Mount, Copy, Listener, Asking, world="yard", seconds=2, quiet=True).digest == listened.digest


def test_a_clock_that_jumps_back_empties_the_buffer(capfd):
    buffer = Buffer()
    buffer.set_transform(fixed("a", "b", 1.0), "test")
    buffer.time_jump_callback(None)
    assert not buffer.can_transform("a", "b", Time())
    assert "Detected jump back in time. Clearing tf buffer." in capfd.readouterr().err
