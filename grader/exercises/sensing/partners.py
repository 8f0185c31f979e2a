"""Nodes of ours for 05_sensing: a strange lidar, drivers that take no care, and a radio link that fails."""

from __future__ import annotations

import math
import random

from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.time import Time
from sensor_msgs.msg import LaserScan

from sim.evidence import since_start

RAYS = 180


class StrangeLidar(Node):
    """Another robot's lidar: scans (LaserScan) on /scan, two a second.

    It has 180 rays, and its first one looks back. Distances come from the run's seed. In turn, all rays are
    well, some are lost (nan), some meet nothing (inf), or some meet what is too near (-inf).
    """

    def __init__(self) -> None:
        super().__init__("strange_lidar")
        self.publisher = self.create_publisher(LaserScan, "/scan", 10)
        self.count = 0
        self.create_timer(0.5, self.measure)

    def measure(self) -> None:
        """Make up a scan, and publish it."""
        ranges = [random.uniform(2.5, 3.0) for _ in range(RAYS)]
        for middle in range(0, RAYS, 15):  # something stands in each direction, in the sectors and between
            distance = random.uniform(0.4, 2.4)
            ranges[middle - 1], ranges[middle], ranges[(middle + 1) % RAYS] = distance, distance, distance
        (_leave, _lose, _clear, _come_near)[self.count % 4](ranges)
        self.count += 1
        msg = LaserScan(angle_min=-math.pi, angle_increment=math.tau / RAYS, range_min=0.12, range_max=3.5)
        msg.angle_max = msg.angle_min + (RAYS - 1) * msg.angle_increment
        msg.header.stamp, msg.header.frame_id = self.get_clock().now().to_msg(), "laser"
        msg.ranges = ranges
        self.publisher.publish(msg)


def _leave(ranges: list[float]) -> None:
    """All is well."""


def _lose(ranges: list[float]) -> None:
    """One ray in eight gets lost; always the first, and those ahead, to the left and to the right."""
    for ray in {0, 45, 90, 135, *random.sample(range(RAYS), RAYS // 8)}:
        ranges[ray] = math.nan


def _clear(ranges: list[float]) -> None:
    """Half of the world is empty: ahead and to the left, or to the right."""
    empty = range(73, 154) if random.random() < 0.5 else range(26, 65)
    for ray in empty:
        ranges[ray] = math.inf


def _come_near(ranges: list[float]) -> None:
    """Something comes nearer than the lidar can measure, in one of the three directions."""
    ranges[random.choice((45, 90, 135)) + random.randint(-8, 8)] = -math.inf


class Dizzy(Node):
    """Turns the robot to and fro: after `rest` seconds for `away` seconds; then it lets it stand."""

    rest, away, speed = 0.0, 24.0, 0.0  # s, s, m/s

    def __init__(self) -> None:
        super().__init__("dizzy")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.ticks, self.turn = 0, 0.0
        self.side = random.choice((-1.0, 1.0))
        self.create_timer(0.1, self.drive)

    def drive(self) -> None:
        """Fast to one side for 4 s, then slower to the other, and so on: so all directions are seen."""
        leg, tick = divmod(self.ticks, 40)
        if tick == 0:
            fast, slow = random.uniform(1.1, 1.4), random.uniform(0.4, 0.8)
            self.turn = self.side * (-slow if leg % 2 else fast)
        msg = Twist()
        if 0 <= self.ticks / 10 - self.rest < self.away:
            msg.linear.x, msg.angular.z = self.speed, self.turn
        self.ticks += 1
        self.publisher.publish(msg)


class Circling(Dizzy):
    """As Dizzy, and drives at the same time."""

    speed = 0.2


class LateStarter(Dizzy):
    """As Dizzy, but it lets the robot stand for the first 3 s, and from 19 s on."""

    rest, away = 3.0, 16.0


class CarelessDriver(Node):
    """Drives straight ahead (Twist on /cmd_vel, at 10 Hz) without a look, and turns by chance."""

    def __init__(self) -> None:
        super().__init__("careless_driver")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.until, self.ahead, self.turn = 0.0, False, 0.0
        self.create_timer(0.1, self.drive)

    def drive(self) -> None:
        """Ahead for some seconds, then a turn on the spot, and so on."""
        now = since_start(self.get_clock().now().to_msg())
        if now >= self.until:
            self.ahead = not self.ahead
            self.until = now + (random.uniform(4.0, 8.0) if self.ahead else random.uniform(1.0, 2.0))
            self.turn = random.choice((-1.2, 1.2))
        msg = Twist()
        if self.ahead:
            msg.linear.x = 0.4
        else:
            msg.angular.z = self.turn
        self.publisher.publish(msg)


class CrashingDriver(Node):
    """Drives ahead (Twist on /cmd_vel, at 10 Hz). After some 4 s it falls silent for 3 s, then it goes on."""

    def __init__(self) -> None:
        super().__init__("crashing_driver")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.start = random.uniform(3.5, 4.5)
        self.create_timer(0.1, self.drive)

    def drive(self) -> None:
        """Ahead, except in the pause."""
        now = since_start(self.get_clock().now().to_msg())
        if not self.start < now < self.start + 3.0:
            msg = Twist()
            msg.linear.x = 0.4
            self.publisher.publish(msg)


class Radio(Node):
    """The radio link that brings the robot's scans from /scan to /lidar. All is well with this one."""

    def __init__(self) -> None:
        super().__init__("radio")
        self.publisher = self.create_publisher(LaserScan, "/lidar", 10)
        self.waiting: list[LaserScan] = []
        self.create_subscription(LaserScan, "/scan", self.relay, 10)

    def relay(self, msg: LaserScan) -> None:
        """Pass the scans on that have waited as long as the link takes now."""
        now = self.get_clock().now()
        self.waiting.append(msg)
        delay = self.delay(since_start(now.to_msg()))
        while self.waiting and (now - Time.from_msg(self.waiting[0].header.stamp)).nanoseconds >= delay * 1e9:
            self.publisher.publish(self.waiting.pop(0))

    def delay(self, now: float) -> float:
        """How many seconds the link takes at the moment."""
        return 0.0


class BadRadio(Radio):
    """As Radio; but after some 11 s it is silent for 3 s, and after 17 s its scans come 1 s late for 3 s."""

    def __init__(self) -> None:
        super().__init__()
        self.silent, self.late = random.uniform(10.5, 11.5), random.uniform(16.5, 17.5)

    def relay(self, msg: LaserScan) -> None:
        """Nothing in the silence; what was said in it is lost."""
        if not self.silent < since_start(self.get_clock().now().to_msg()) < self.silent + 3.0:
            super().relay(msg)

    def delay(self, now: float) -> float:
        """One second, while the link is slow."""
        return 1.0 if self.late < now < self.late + 3.0 else 0.0
