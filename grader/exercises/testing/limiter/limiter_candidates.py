"""Implementations of the node `Limiter`: three right ones, and ten that break a line of its contract each."""

from functools import partial
from typing import Any

from grader.companions.candidates import Candidates, in_order

GIVEN = """\
import math

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float64
from std_srvs.srv import SetBool


class Limiter(Node):
    def __init__(self, **options):
        super().__init__("limiter", **options)
        self.declare_parameter("limit", 0.5)  # m/s
        self.held = False
        self.speeds = self.create_publisher(Float64, "speed", 10)
        self.create_subscription(Float64, "request", self.on_request, 10)
        self.create_service(SetBool, "hold", self.on_hold)
        self.silence = self.create_timer(0.5, self.on_silence)
        self.silence.cancel()

    def on_request(self, msg):
        limit = self.get_parameter("limit").value
        speed = max(-limit, min(limit, msg.data)) if math.isfinite(msg.data) else 0.0
        self.speeds.publish(Float64(data=0.0 if self.held else speed))
        self.silence.reset()

    def on_silence(self):
        self.silence.cancel()
        self.speeds.publish(Float64(data=0.0))

    def on_hold(self, request, response):
        self.held = request.data
        response.success = True
        return response


def main():
    rclpy.init()
    rclpy.spin(Limiter())
"""
CLAMP, NUMBER = "max(-limit, min(limit, msg.data))", "if math.isfinite(msg.data) else"
CANCEL = "        self.silence.cancel()\n        self.speeds.publish"
OTHER = """\
from math import copysign, inf

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float64
from std_srvs.srv import SetBool


class Limiter(Node):
    def __init__(self, **options):
        super().__init__("limiter", **options)
        self.declare_parameter("limit", 0.5)
        self.on, self.last = True, None
        self.output = self.create_publisher(Float64, "speed", 10)
        self.subscription = self.create_subscription(Float64, "request", self.callback, 10)
        self.service = self.create_service(SetBool, "hold", self.switch)
        self.timer = self.create_timer(0.02, self.look)

    def callback(self, msg):
        self.last = self.get_clock().now()
        speed = 0.0
        if self.on and -inf < msg.data < inf:
            speed = copysign(min(abs(msg.data), self.get_parameter("limit").value), msg.data)
        self.output.publish(Float64(data=speed))

    def look(self):
        if self.last is not None and (self.get_clock().now() - self.last).nanoseconds >= 500_000_000:
            self.last = None
            self.output.publish(Float64())

    def switch(self, request, response):
        self.on = not request.data
        response.success, response.message = True, "" if self.on else "held"
        return response


def main():
    rclpy.init()
    rclpy.spin(Limiter())
"""
RIGHT = (  # what differs from the given file in one line may be right, too
    GIVEN.replace(CLAMP, "min(limit, max(-limit, msg.data))"),
    OTHER,
    GIVEN.replace(CLAMP, "sorted((-limit, msg.data, limit))[1]").replace("0.5, self", "0.52, self"),
)
WRONG = tuple(
    GIVEN.replace(old, new)
    for old, new in (
        (CLAMP, "min(limit, msg.data)"),
        (CLAMP, "max(-limit, msg.data)"),
        ('self.get_parameter("limit").value', "0.5"),
        (
            'limit = self.get_parameter("limit").value',
            'limit = self.__dict__.setdefault("_limit", self.get_parameter("limit").value)',
        ),
        (NUMBER, "if True else"),
        (NUMBER, "if not math.isnan(msg.data) else"),
        ("0.0 if self.held else speed", "speed"),
        ("self.held = request.data", "self.held = True"),
        ("        self.silence.reset()\n", ""),
        (CANCEL, CANCEL.replace("        self.silence.cancel()\n", "")),
    )
)


def candidates(seed: int) -> list[tuple[bool, str]]:
    """Return whether it is right, and the text of each candidate, in the order of a seed."""
    return in_order("limiter", seed, RIGHT, WRONG)


def companions(seed: int) -> list[Any]:
    """Return the programs of a seed."""
    return [partial(Candidates, candidates(seed))]
