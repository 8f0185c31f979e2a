"""Streams that a controller takes: a sensor that is late at times, marks for a cart, and pictures."""

import random

from rclpy.duration import Duration
from rclpy.node import Node
from std_msgs.msg import Float64, Header, UInt8MultiArray

PERIOD = 0.02  # s, of the sensor
QUICK, SLOW, OFTEN = (0.001, 0.007), (0.012, 0.018), 0.15  # s on the way, and how often it is slow
FIRST_MARK, SECOND_MARK, MARKS = (5.0, 6.0), (10.5, 11.5), (0.3, 0.5)  # s, s, m
PICTURES, PIXELS = 0.7, 12  # s between two


class Sensor(Node):
    """Measures 50 times a second, exactly, and publishes the Header on /beat, a little late."""

    def __init__(self) -> None:
        super().__init__("sensor")
        self.publisher = self.create_publisher(Header, "/beat", 10)
        self.create_timer(PERIOD, self.measure)

    def measure(self) -> None:
        """Measure now, and publish when that is processed."""
        header = Header(stamp=self.get_clock().now().to_msg(), frame_id="sensor")
        seconds = random.uniform(*(SLOW if random.random() < OFTEN else QUICK))
        self.get_clock().sleep_for(Duration(seconds=seconds))
        self.publisher.publish(header)


class Marks(Node):
    """Publishes ten times a second on /mark (Float64, m) where the cart has to be.

    First in the middle, from 5 s to 6 s on at one side, and from 10.5 s to 11.5 s on at the other.
    """

    def __init__(self) -> None:
        super().__init__("marks")
        self.publisher = self.create_publisher(Float64, "/mark", 10)
        side = random.choice((-1.0, 1.0))
        self.plan = [(random.uniform(*SECOND_MARK), -side * random.uniform(*MARKS))]
        self.plan += [(random.uniform(*FIRST_MARK), side * random.uniform(*MARKS)), (0.0, 0.0)]
        self.ticks = 0
        self.create_timer(0.1, self.tick)

    def tick(self) -> None:
        """Publish the mark that holds now."""
        mark = next(mark for begin, mark in self.plan if begin <= self.ticks * 0.1)
        self.ticks += 1
        self.publisher.publish(Float64(data=round(mark, 3)))


class Camera(Node):
    """Publishes a picture (UInt8MultiArray on /picture), twelve pixels in a row, every 0.7 s."""

    def __init__(self) -> None:
        super().__init__("camera")
        self.publisher = self.create_publisher(UInt8MultiArray, "/picture", 10)
        self.create_timer(PICTURES, self.take)

    def take(self) -> None:
        """Publish the next picture; one of its pixels is the brightest."""
        self.publisher.publish(UInt8MultiArray(data=random.sample(range(256), PIXELS)))
