"""Programs around ROS's libraries: goals in a queue, awaited transforms, images, caches."""

import collections
import contextlib
import functools
import threading

import numpy as np
import rclpy
import sensor_msgs_py.point_cloud2 as pc2
from example_interfaces.action import Fibonacci
from geometry_msgs.msg import TransformStamped
from message_filters import Cache, Subscriber
from nav_msgs.msg import Odometry
from rclpy.action import ActionClient, ActionServer, GoalResponse
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image, PointCloud2
from std_msgs.msg import Header
from tf2_ros import Buffer, StaticTransformBroadcaster, TransformListener


class QueuesGoals(Node):
    """One goal after the other, as in rclpy's examples: what is accepted waits in a queue."""

    def __init__(self):
        super().__init__("queues")
        self.queue, self.lock, self.current = collections.deque(), threading.Lock(), None
        self.server = ActionServer(
            self, Fibonacci, "queued", self.execute,
            goal_callback=lambda goal: GoalResponse.ACCEPT,
            handle_accepted_callback=self.accepted,
            callback_group=ReentrantCallbackGroup(),
        )  # fmt: skip

    def accepted(self, handle):
        with self.lock:
            if self.current is None:
                self.current = handle
                handle.execute()
            else:
                self.queue.append(handle)

    def execute(self, handle):
        try:
            for number in range(handle.request.order):
                handle.publish_feedback(Fibonacci.Feedback(sequence=[number]))
                self.get_clock().sleep_for(rclpy.duration.Duration(seconds=0.1))
            handle.succeed()
            return Fibonacci.Result(sequence=list(range(handle.request.order)))
        finally:
            with self.lock:
                self.current = self.queue.popleft() if self.queue else None
                if self.current is not None:
                    self.current.execute()


def queues_goals():
    rclpy.init()
    with (
        contextlib.suppress(KeyboardInterrupt, ExternalShutdownException),
        MultiThreadedExecutor() as executor,
    ):
        executor.add_node(QueuesGoals())
        executor.spin()


class SendsThree(Node):
    """Three goals at once, whose results it counts."""

    def __init__(self):
        super().__init__("sends")
        self.client, self.done = ActionClient(self, Fibonacci, "queued"), 0
        self.timer = self.create_timer(0.2, self.send)

    def send(self):
        if not self.client.server_is_ready():
            return
        self.timer.cancel()
        for order in (1, 2, 3):
            future = self.client.send_goal_async(Fibonacci.Goal(order=order))
            future.add_done_callback(functools.partial(self.accepted, order))

    def accepted(self, order, future):
        future.result().get_result_async().add_done_callback(lambda result: self.count(order))

    def count(self, order):
        self.done += 1
        self.get_logger().info(f"goal {order} is done, {self.done} of 3")


class AwaitsAFrame(Node):
    """A coroutine awaits a transform that its own program sends a little later."""

    def __init__(self):
        super().__init__("awaits_frame")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.sender = StaticTransformBroadcaster(self)
        self.group = MutuallyExclusiveCallbackGroup()
        self.ask = self.create_timer(0.1, self.look, callback_group=self.group)
        self.later = self.create_timer(0.5, self.send)

    async def look(self):
        self.ask.cancel()
        await self.buffer.wait_for_transform_async("tool", "flange", rclpy.time.Time())
        found = self.buffer.lookup_transform("tool", "flange", rclpy.time.Time())
        self.get_logger().info(f"{found.transform.translation.z:.1f} m")

    def send(self):
        self.later.cancel()
        sent = TransformStamped(child_frame_id="flange")
        sent.header.frame_id, sent.header.stamp = "tool", self.get_clock().now().to_msg()
        sent.transform.translation.z = 0.2
        self.sender.sendTransform(sent)


class Pictures(Node):
    """Images and point clouds, made with numpy."""

    def __init__(self):
        super().__init__("pictures")
        self.images = self.create_publisher(Image, "image", qos_profile_sensor_data)
        self.clouds = self.create_publisher(PointCloud2, "points", qos_profile_sensor_data)
        self.create_timer(0.5, self.draw)

    def draw(self):
        header = Header(frame_id="camera", stamp=self.get_clock().now().to_msg())
        pixels = np.zeros((12, 16, 3), np.uint8)
        pixels[3:9, 4:12] = 255, 0, 0
        height, width, _ = pixels.shape
        self.images.publish(
            Image(
                header=header,
                height=height,
                width=width,
                encoding="rgb8",
                step=3 * width,
                data=pixels.tobytes(),
            )
        )
        points = np.random.default_rng(1).random((10, 3), dtype=np.float32)
        self.clouds.publish(pc2.create_cloud_xyz32(header, points))


class SeesPictures(Node):
    def __init__(self):
        super().__init__("sees")
        self.create_subscription(Image, "image", self.on_image, qos_profile_sensor_data)
        self.create_subscription(PointCloud2, "points", self.on_cloud, qos_profile_sensor_data)

    def on_image(self, image):
        pixels = np.frombuffer(image.data, np.uint8).reshape(image.height, image.width, 3)
        self.get_logger().info(f"{int((pixels[..., 0] > 128).sum())} red pixels")

    def on_cloud(self, cloud):
        self.get_logger().info(f"{len(pc2.read_points_numpy(cloud))} points")


class Remembers(Node):
    """A cache of odometry, asked for what was half a second ago."""

    def __init__(self):
        super().__init__("remembers")
        self.cache = Cache(Subscriber(self, Odometry, "odom"), 100)
        self.outlet = self.create_publisher(Odometry, "odom_before", 10)
        self.create_timer(0.5, self.look_back)

    def look_back(self):
        then = self.get_clock().now() - rclpy.duration.Duration(seconds=0.5)
        found = self.cache.getElemBeforeTime(then)
        if found is not None:
            self.outlet.publish(found)


CORPUS = [
    (queues_goals, SendsThree),
    (AwaitsAFrame,),
    (Pictures, SeesPictures),
    (Remembers,),
]
