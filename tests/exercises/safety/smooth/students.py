"""Limiters of speed and acceleration: right ones, and wrong ones named by their defect."""

import math

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node

LIMITS = ((0.3, 0.025), (1.0, 0.1))  # of linear.x and angular.z: the most, the step


class Limiter(Node):
    """As one would write it; the wrong ones change one thing each."""

    def __init__(self):
        super().__init__("limiter")
        self.last = [0.0, 0.0]
        self.commands = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(Twist, "/cmd_vel_raw", self.on_message, 10)

    def on_message(self, msg):
        requests = msg.linear.x, msg.angular.z
        self.last = [
            self.next(requested, last, *limits)
            for requested, last, limits in zip(requests, self.last, LIMITS, strict=True)
        ]
        answer = Twist()
        answer.linear.x, answer.angular.z = self.last
        self.commands.publish(answer)

    def next(self, requested, last, most, step):
        requested = self.cut(self.finite(requested), most)
        if requested * last < 0:
            return 0.0
        return self.grow(requested, last, step)

    def finite(self, requested):
        return requested if math.isfinite(requested) else 0.0

    def cut(self, requested, most):
        return max(-most, min(most, requested))

    def grow(self, requested, last, step):
        return math.copysign(min(abs(requested), abs(last) + step), requested)


class AllInTheEnd(Limiter):
    """Right answers, when no one drives any more."""

    def __init__(self):
        super().__init__()
        self.kept, self.commands_out = [], self.commands
        self.commands = self
        self.create_timer(9.9, self.tell)

    def publish(self, msg):
        self.kept.append(msg)

    def tell(self):
        self.commands = self.commands_out
        for msg in self.kept:
            self.commands.publish(msg)


class StraightThroughZero(Limiter):
    """A design of its own: from forwards to backwards in one step beyond 0."""

    def next(self, requested, last, most, step):
        return super().next(requested, last if requested * last > 0 else 0.0, most, step)


class WithNumbers(Limiter):
    """Without copysign."""

    def grow(self, requested, last, step):
        if requested > 0:
            return min(requested, max(last, 0.0) + step)
        return max(requested, min(last, 0.0) - step)


def main():
    rclpy.init()
    rclpy.spin(Limiter())


class NoLimit(Limiter):
    def cut(self, requested, most):
        return requested


class Jerks(Limiter):
    """Speeds at once."""

    def grow(self, requested, last, step):
        return requested


class JerksBackwards(Limiter):
    """Steps on the way up only."""

    def grow(self, requested, last, step):
        return min(requested, last + step)


class JerksThroughZero(Limiter):
    """The difference is at most a large step."""

    def next(self, requested, last, most, step):
        requested = self.cut(self.finite(requested), most)
        return requested if requested * last < 0 else self.grow(requested, last, step)


class BrakesGently(Limiter):
    """Each change is at most a step, also towards 0."""

    def next(self, requested, last, most, step):
        return last + self.cut(self.cut(self.finite(requested), most) - last, step)


class AsksForNanAndInf(Limiter):
    """There are two infinities."""

    def finite(self, requested):
        return 0.0 if math.isnan(requested) or requested == math.inf else requested


class SaysNothingToNonsense(Limiter):
    """Leaves bad requests unanswered."""

    def on_message(self, msg):
        if math.isfinite(msg.linear.x) and math.isfinite(msg.angular.z):
            super().on_message(msg)


class OneStepOnly(Limiter):
    """Forgets what it sent."""

    def next(self, requested, last, most, step):
        return super().next(requested, 0.0, most, step)
