"""Lookouts: right ones, and wrong ones named by their defect."""

import math

import numpy as np
import rclpy
from rclpy.node import Node
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Float32, Float64

SECTORS = {"/front": 0, "/left": 90, "/right": -90}


class Lookout(Node):
    """As in the assignment, with the method filled in."""

    type, topics = Float64, tuple(SECTORS)

    def __init__(self):
        super().__init__("lookout")
        self.distances = {topic: self.create_publisher(self.type, topic, 10) for topic in self.topics}
        self.create_subscription(LaserScan, "/scan", self.look, 10)

    def look(self, msg):
        for topic, middle in SECTORS.items():
            self.say(topic, self.nearest(msg, middle))

    def say(self, topic, distance):
        self.distances[topic].publish(self.type(data=distance))

    def nearest(self, msg, middle):
        found = [math.inf]
        for index, distance in enumerate(msg.ranges):
            angle = math.degrees(msg.angle_min + index * msg.angle_increment)
            off = (angle - middle + 180) % 360 - 180
            if abs(off) <= 30 and not math.isnan(distance):
                found.append(distance)
        return max(0.0, min(found))


class LookoutWithNumpy(Lookout):
    """A design of its own: radians, arrays, and the wrap by the angle of a vector."""

    def nearest(self, msg, middle):
        angles = msg.angle_min + np.arange(len(msg.ranges)) * msg.angle_increment - math.radians(middle)
        ranges = np.array(msg.ranges)[np.cos(angles) >= math.cos(math.radians(30))]
        ranges = ranges[~np.isnan(ranges)]
        return float(max(ranges.min(initial=np.inf), 0.0))


class LookoutByIndex(Lookout):
    """From an angle to an index, and round the ring of rays."""

    def nearest(self, msg, middle):
        count = len(msg.ranges)
        center = (math.radians(middle) - msg.angle_min) / msg.angle_increment
        half = math.radians(30) / msg.angle_increment
        rays = [msg.ranges[i % count] for i in range(math.ceil(center - half), math.floor(center + half) + 1)]
        return max(0.0, min((r for r in rays if r == r), default=math.inf))


class LookoutWithTimer(Node):
    """Remembers the scan, and speaks ten times a second."""

    def __init__(self):
        super().__init__("sectors")
        self.pubs = [self.create_publisher(Float64, name, 1) for name in ("front", "left", "right")]
        self.scan = None
        self.create_subscription(LaserScan, "scan", self.keep, 1)
        self.create_timer(0.1, self.tick)

    def keep(self, msg):
        self.scan = msg

    def tick(self):
        if self.scan is None:
            return
        best = [math.inf] * 3
        angle = self.scan.angle_min
        for distance in self.scan.ranges:
            for index, middle in enumerate((0.0, math.pi / 2, -math.pi / 2)):
                if abs(math.remainder(angle - middle, math.tau)) < math.pi / 6 and distance < best[index]:
                    best[index] = max(distance, 0.0)
            angle += self.scan.angle_increment
        for publisher, distance in zip(self.pubs, best, strict=True):
            publisher.publish(Float64(data=distance))


def main():
    rclpy.init()
    node = rclpy.create_node("lookout")
    pubs = {name: node.create_publisher(Float64, name, 10) for name in SECTORS}

    def on_scan(msg):
        for name, middle in SECTORS.items():
            best = Float64(data=math.inf)
            for i, r in enumerate(msg.ranges):
                a = msg.angle_min + i * msg.angle_increment - math.radians(middle)
                if abs(math.atan2(math.sin(a), math.cos(a))) <= math.radians(30) and not math.isnan(r):
                    best.data = min(best.data, max(0.0, r))
            pubs[name].publish(best)

    node.create_subscription(LaserScan, "/scan", on_scan, 10)
    rclpy.spin(node)


class CountsRays(Lookout):
    """A tutorial's slices: right for this robot's lidar, and for no other."""

    def nearest(self, msg, middle):
        rays = [msg.ranges[i % 360] for i in range(middle - 30, middle + 31) if i % 360 < len(msg.ranges)]
        return max(0.0, min((r for r in rays if not math.isnan(r)), default=math.inf))


class FirstRayLooksBack(Lookout):
    """Front in the middle of the ranges, as other lidars have it."""

    def nearest(self, msg, middle):
        count = len(msg.ranges)
        center = count // 2 + round(middle * count / 360)
        rays = [msg.ranges[i % count] for i in range(center - count // 12, center + count // 12 + 1)]
        return max(0.0, min((r for r in rays if not math.isnan(r)), default=math.inf))


class NoWrap(Lookout):
    """Forgets that 350 degrees are -10."""

    def nearest(self, msg, middle):
        found = [math.inf]
        for index, distance in enumerate(msg.ranges):
            angle = math.degrees(msg.angle_min + index * msg.angle_increment)
            if abs(angle - middle) <= 30 and not math.isnan(distance):
                found.append(distance)
        return max(0.0, min(found))


class LeftIsRight(Lookout):
    def nearest(self, msg, middle):
        return super().nearest(msg, -middle)


class TooNarrow(Lookout):
    def nearest(self, msg, middle):
        rays = list(msg.ranges)
        start = round((math.radians(middle) - msg.angle_min) / msg.angle_increment)
        return max(0.0, rays[start % len(rays)])


class KeepsNan(Lookout):
    """numpy's min is nan as soon as one of the rays is."""

    def nearest(self, msg, middle):
        angles = msg.angle_min + np.arange(len(msg.ranges)) * msg.angle_increment - math.radians(middle)
        return float(np.maximum(np.array(msg.ranges)[np.cos(angles) >= math.cos(math.pi / 6)].min(), 0.0))


class NanIsZero(Lookout):
    def nearest(self, msg, middle):
        msg.ranges = [0.0 if math.isnan(r) else r for r in msg.ranges]
        return super().nearest(msg, middle)


class LeavesOutInfinity(Lookout):
    """Only finite distances count: what is too near, is not seen at all."""

    def nearest(self, msg, middle):
        msg.ranges = [r if math.isfinite(r) else math.nan for r in msg.ranges]
        return super().nearest(msg, middle)


class FarIsRangeMax(Lookout):
    def nearest(self, msg, middle):
        return min(super().nearest(msg, middle), msg.range_max)


class MinusInfinity(Lookout):
    def nearest(self, msg, middle):
        found = super().nearest(msg, middle)
        return -math.inf if found == 0.0 else found


class SilentWhenEmpty(Lookout):
    def say(self, topic, distance):
        if math.isfinite(distance):
            super().say(topic, distance)


class MinOfNothing(Lookout):
    def nearest(self, msg, middle):
        angles = msg.angle_min + np.arange(len(msg.ranges)) * msg.angle_increment - math.radians(middle)
        ranges = np.array(msg.ranges)[np.cos(angles) >= math.cos(math.pi / 6)]
        return float(ranges[np.isfinite(ranges)].min())


class SmallNumbers(Lookout):
    type = Float32


class OnlyTheFront(Lookout):
    topics = ("/front",)

    def say(self, topic, distance):
        if topic == "/front":
            super().say(topic, distance)


class InRadians(Lookout):
    """Takes an angle in radians for one in degrees."""

    def nearest(self, msg, middle):
        found = [math.inf]
        for index, distance in enumerate(msg.ranges):
            off = (msg.angle_min + index * msg.angle_increment - middle + 180) % 360 - 180
            if abs(off) <= 30 and not math.isnan(distance):
                found.append(distance)
        return max(0.0, min(found))


class Greatest(Lookout):
    def nearest(self, msg, middle):
        return max(r for r in msg.ranges if not math.isnan(r))


class Within(Lookout):
    """A sector of another width."""

    half = 30

    def nearest(self, msg, middle):
        angles = msg.angle_min + np.arange(len(msg.ranges)) * msg.angle_increment - math.radians(middle)
        inside = np.cos(angles) >= math.cos(math.radians(self.half))
        return max(0.0, float(np.nanmin(np.array(msg.ranges)[inside])))


class TenDegrees(Within):
    half = 10


class SixtyDegrees(Within):
    half = 60


PARTS = ("Within",)


class ReturnsInTheLoop(Lookout):
    def nearest(self, msg, middle):
        for index, distance in enumerate(msg.ranges):
            angle = math.degrees(msg.angle_min + index * msg.angle_increment)
            off = (angle - middle + 180) % 360 - 180
            return distance if abs(off) <= 30 else math.inf


class GivesTheList(Lookout):
    """Puts what it gets into the message at once, as the assignment does."""

    def look(self, msg):
        self.distances["/front"].publish(Float64(data=self.nearest(msg, 0)))

    def nearest(self, msg, middle):
        return list(msg.ranges)
