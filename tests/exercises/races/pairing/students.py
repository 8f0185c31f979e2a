"""Pairs of images and scans: right ones, and wrong ones named after their defect."""

import bisect
import contextlib
import threading
from collections import deque

import rclpy
from message_filters import ApproximateTimeSynchronizer, Subscriber, TimeSynchronizer
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import Image, LaserScan, TimeReference

PARTS = ("_seconds",)


def _seconds(msg):
    return Time.from_msg(msg.header.stamp).nanoseconds / 1e9


class Pairs(Node):
    """As one would write it; the wrong ones change one thing each."""

    slop, memory = 0.03, 1.0
    group = None

    def __init__(self):
        super().__init__("pairs")
        self.images, self.scans = [], []
        self.publisher = self.create_publisher(TimeReference, "/pairs", 10)
        self.subscribe()

    def subscribe(self):
        sensors = qos_profile_sensor_data
        self.create_subscription(
            Image, "/camera/image_raw", self.on_image, sensors, callback_group=self.group
        )
        self.create_subscription(LaserScan, "/scan", self.on_scan, sensors, callback_group=self.group)

    def on_image(self, image):
        scan = self.partner(image, self.scans)
        if scan is None:
            self.images.append(image)
        else:
            self.publish(image, scan)
        self.forget()

    def on_scan(self, scan):
        image = self.partner(scan, self.images)
        if image is None:
            self.scans.append(scan)
        else:
            self.publish(image, scan)
        self.forget()

    def partner(self, msg, waiting):
        for other in waiting:
            if abs(_seconds(other) - _seconds(msg)) <= self.slop:
                waiting.remove(other)
                return other
        return None

    def forget(self):
        now = self.get_clock().now().nanoseconds / 1e9
        self.images = [image for image in self.images if now - _seconds(image) < self.memory]
        self.scans = [scan for scan in self.scans if now - _seconds(scan) < self.memory]

    def publish(self, image, scan):
        pair = TimeReference(time_ref=scan.header.stamp)
        pair.header = image.header
        self.publisher.publish(pair)


class BoundedQueues(Pairs):
    """It keeps the last few, however old they are."""

    def __init__(self):
        super().__init__()
        self.images, self.scans = deque(maxlen=5), deque(maxlen=8)

    def forget(self):
        pass


class NearestOfAll(Pairs):
    """The nearest one, if it's near enough."""

    def partner(self, msg, waiting):
        nearest = min(waiting, key=lambda other: abs(_seconds(other) - _seconds(msg)), default=None)
        if nearest is None or abs(_seconds(nearest) - _seconds(msg)) > self.slop:
            return None
        waiting.remove(nearest)
        return nearest


class ForgetsFirst(Pairs):
    """It forgets before it looks, and only by the newest stamp of the topic."""

    def partner(self, msg, waiting):
        self.forget()
        return super().partner(msg, self.scans if isinstance(msg, Image) else self.images)


class ShortMemory(Pairs):
    memory = 0.6


class Synchronizer(Node):
    """message_filters, with a small queue and a slop."""

    queue, slop = 5, 0.03

    def __init__(self):
        super().__init__("pairs")
        self.publisher = self.create_publisher(TimeReference, "/pairs", 10)
        topics = [Subscriber(self, Image, "/camera/image_raw"), Subscriber(self, LaserScan, "/scan")]
        self.synchronizer = self.make(topics)
        self.synchronizer.registerCallback(self.on_pair)

    def make(self, topics):
        return ApproximateTimeSynchronizer(topics, queue_size=self.queue, slop=self.slop)

    def on_pair(self, image, scan):
        self.publisher.publish(TimeReference(header=image.header, time_ref=scan.header.stamp))


class Slots(Pairs):
    """A design of its own: a dictionary with a slot for each tenth of a second."""

    def __init__(self):
        super().__init__()
        self.slots = {}

    def on_image(self, image):
        self.fill(image, 0)

    def on_scan(self, scan):
        self.fill(scan, 1)

    def fill(self, msg, place):
        slot = self.slots.setdefault(round(_seconds(msg) * 10 - 0.1), [None, None])
        slot[place] = msg
        if None not in slot:
            self.publish(*slot)
            slot[:] = [None, None]
        newest = self.get_clock().now().nanoseconds / 1e8
        self.slots = {key: slot for key, slot in self.slots.items() if newest - key < 10}


class Sorted(Pairs):
    """A design of its own: scans in the order of their stamps, and bisection."""

    def on_scan(self, scan):
        image = self.partner(scan, self.images)
        if image is not None:
            self.publish(image, scan)
        else:
            bisect.insort(self.scans, scan, key=_seconds)
        self.forget()

    def on_image(self, image):
        at = bisect.bisect_left(self.scans, _seconds(image) - self.slop, key=_seconds)
        if at < len(self.scans) and _seconds(self.scans[at]) <= _seconds(image) + self.slop:
            self.publish(image, self.scans.pop(at))
        else:
            self.images.append(image)
        self.forget()


class StampsOnly(Pairs):
    """A design of its own: it keeps stamps in nanoseconds, not messages."""

    def __init__(self):
        super().__init__()
        self.waiting = {"image": deque(maxlen=6), "scan": deque(maxlen=10)}

    def on_image(self, image):
        self.match("image", "scan", image.header.stamp)

    def on_scan(self, scan):
        self.match("scan", "image", scan.header.stamp)

    def match(self, own, other, stamp):
        mine = Time.from_msg(stamp).nanoseconds
        for partner in self.waiting[other]:
            if abs(partner - mine) <= 30_000_000:
                self.waiting[other].remove(partner)
                found = {own: mine, other: partner}
                pair = TimeReference(time_ref=Time(nanoseconds=found["scan"]).to_msg())
                pair.header.stamp = Time(nanoseconds=found["image"]).to_msg()
                self.publisher.publish(pair)
                return
        self.waiting[own].append(mine)


class Locked(Pairs):
    """For several threads: a reentrant group, and a lock around both callbacks."""

    def __init__(self):
        self.lock, self.group = threading.Lock(), ReentrantCallbackGroup()
        super().__init__()

    def on_image(self, image):
        with self.lock:
            super().on_image(image)

    def on_scan(self, scan):
        with self.lock:
            super().on_scan(scan)


def main():
    """In several threads."""
    rclpy.init()
    executor = MultiThreadedExecutor(4)
    executor.add_node(Locked())
    with contextlib.suppress(KeyboardInterrupt):
        executor.spin()


class LatestWithLatest(Pairs):
    """Pairs each image with the newest scan."""

    def on_image(self, image):
        if self.scans:
            self.publish(image, self.scans[-1])

    def on_scan(self, scan):
        self.scans = [scan]


class NearestHoweverFar(Pairs):
    """Pairs with the nearest scan, even if the right one got lost."""

    def on_image(self, image):
        if self.scans:
            self.publish(image, min(self.scans, key=lambda scan: abs(_seconds(scan) - _seconds(image))))
        self.forget()

    def on_scan(self, scan):
        self.scans.append(scan)


class LargeSlop(Pairs):
    slop = 0.1


class Unbounded(Pairs):
    def forget(self):
        pass


class UnboundedSynchronizer(Synchronizer):
    queue = 1000


class EqualStamps(Synchronizer):
    """Stamps of two sensors are hardly ever equal: jitter drops all."""

    def make(self, topics):
        return TimeSynchronizer(topics, 10)



class QueueOfOne(Synchronizer):
    queue = 1


class ClearsAll(Pairs):
    """Forgets everything when a pair is made."""

    def publish(self, image, scan):
        super().publish(image, scan)
        self.images.clear()
        self.scans.clear()


class ByTimer(Pairs):
    """Looks for pairs five times a second."""

    def __init__(self):
        super().__init__()
        self.create_timer(0.2, self.look)

    def on_image(self, image):
        self.images.append(image)

    def on_scan(self, scan):
        self.scans.append(scan)

    def look(self):
        for image in list(self.images):
            scan = self.partner(image, self.scans)
            if scan is not None:
                self.images.remove(image)
                self.publish(image, scan)
        self.forget()



class StampedNow(Pairs):
    def publish(self, image, scan):
        pair = TimeReference(time_ref=scan.header.stamp)
        pair.header.stamp = self.get_clock().now().to_msg()
        self.publisher.publish(pair)



class Twice(Pairs):
    """A message that found its partner stays."""

    def partner(self, msg, waiting):
        near = [other for other in waiting if abs(_seconds(other) - _seconds(msg)) <= self.slop]
        return near[0] if near else None

    def on_image(self, image):
        self.images.append(image)
        super().on_image(image)

    def on_scan(self, scan):
        self.scans.append(scan)
        super().on_scan(scan)
        for image in self.images:
            other = self.partner(image, self.scans)
            if other is not None:
                self.publish(image, other)
