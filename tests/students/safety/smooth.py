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
        wishes = msg.linear.x, msg.angular.z
        self.last = [
            self.next(wish, last, *limits)
            for wish, last, limits in zip(wishes, self.last, LIMITS, strict=True)
        ]
        answer = Twist()
        answer.linear.x, answer.angular.z = self.last
        self.commands.publish(answer)

    def next(self, wish, last, most, step):
        wish = self.cut(self.finite(wish), most)
        if wish * last < 0:
            return 0.0
        return self.grow(wish, last, step)

    def finite(self, wish):
        return wish if math.isfinite(wish) else 0.0

    def cut(self, wish, most):
        return max(-most, min(most, wish))

    def grow(self, wish, last, step):
        return math.copysign(min(abs(wish), abs(last) + step), wish)


class AllInTheEnd(Limiter):
    """Right answers, when nobody drives any more."""

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

    def next(self, wish, last, most, step):
        return super().next(wish, last if wish * last > 0 else 0.0, most, step)


class WithNumbers(Limiter):
    """Without copysign."""

    def grow(self, wish, last, step):
        if wish > 0:
            return min(wish, max(last, 0.0) + step)
        return max(wish, min(last, 0.0) - step)


def main():
    rclpy.init()
    rclpy.spin(Limiter())


class NoLimit(Limiter):
    def cut(self, wish, most):
        return wish


class OnlyForwards(Limiter):
    """Cut at the upper end only."""

    def cut(self, wish, most):
        return min(most, wish)


class Jerks(Limiter):
    """Speeds at once."""

    def grow(self, wish, last, step):
        return wish


class JerksBackwards(Limiter):
    """Steps on the way up only."""

    def grow(self, wish, last, step):
        return min(wish, last + step)


class JerksThroughZero(Limiter):
    """The difference is at most a large step."""

    def next(self, wish, last, most, step):
        wish = self.cut(self.finite(wish), most)
        return wish if wish * last < 0 else self.grow(wish, last, step)


class BrakesGently(Limiter):
    """Each change is at most a step, also towards 0."""

    def next(self, wish, last, most, step):
        return last + self.cut(self.cut(self.finite(wish), most) - last, step)


class LetsNonsenseThrough(Limiter):
    def finite(self, wish):
        return wish


class KeepsOnWithNonsense(Limiter):
    """A bad wish is left out, and what was sent last is sent again."""

    def on_message(self, msg):
        if math.isfinite(msg.linear.x) and math.isfinite(msg.angular.z):
            super().on_message(msg)
        else:
            answer = Twist()
            answer.linear.x, answer.angular.z = self.last
            self.commands.publish(answer)


class SaysNothingToNonsense(Limiter):
    """Leaves bad wishes unanswered."""

    def on_message(self, msg):
        if math.isfinite(msg.linear.x) and math.isfinite(msg.angular.z):
            super().on_message(msg)


class OneStepOnly(Limiter):
    """Forgets what it sent."""

    def next(self, wish, last, most, step):
        return super().next(wish, 0.0, most, step)


class Stands(Limiter):
    """Nothing can happen."""

    def next(self, wish, last, most, step):
        return 0.0
