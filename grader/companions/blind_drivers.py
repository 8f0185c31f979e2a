"""Programs that drive the robot, without looking where: Twist on /cmd_vel, ten times a second."""

import functools
import math
import random
from collections.abc import Callable
from typing import ClassVar

from geometry_msgs.msg import Twist
from rclpy.node import Node

from grader.companions.drivers import Speeds, TimedNode, twist

HALF_TURN = 3.0  # s


class BlindDriver(TimedNode):
    """Publishes what `command` returns; each subclass drives in its own way."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)

    def tick(self, now: float) -> None:
        """Publish the next command, if there is one."""
        speeds = self.command(now)
        if speeds is not None:
            self.publisher.publish(twist(speeds))

    def command(self, now: float) -> Speeds | None:
        """Return what to publish at a time (s since the start); None for nothing."""
        raise NotImplementedError


class Wanderer(BlindDriver):
    """Drives a circle, so that the robot looks in all directions; the run's seed decides which."""

    def __init__(self) -> None:
        super().__init__("wanderer")
        self.speeds = random.uniform(0.3, 0.5), random.choice((-1, 1)) * random.uniform(0.5, 0.8)

    def command(self, now: float) -> Speeds:
        """Always the same."""
        return self.speeds


class Dizzy(BlindDriver):
    """Turns the robot to and fro: after `rest` seconds for `away` seconds; then it lets it stand."""

    rest, away, speed = 0.0, 24.0, 0.0  # s, s, m/s

    def __init__(self) -> None:
        super().__init__("dizzy")
        self.ticks, self.turn = 0, 0.0
        self.side = random.choice((-1.0, 1.0))

    def command(self, now: float) -> Speeds:
        """Fast to one side for 4 s, then slower to the other, and so on, to see all directions."""
        leg, tick = divmod(self.ticks, 40)
        if tick == 0:
            fast, slow = random.uniform(1.1, 1.4), random.uniform(0.4, 0.8)
            self.turn = self.side * (-slow if leg % 2 else fast)
        moves = 0 <= self.ticks / 10 - self.rest < self.away
        self.ticks += 1
        return (self.speed, self.turn) if moves else (0.0, 0.0)


class Circling(Dizzy):
    """Like Dizzy, but drives at the same time."""

    speed = 0.2


class LateStarter(Dizzy):
    """Like Dizzy, but lets the robot stand for the first 3 s, and from 19 s on."""

    rest, away = 3.0, 16.0


class CarelessDriver(BlindDriver):
    """Drives straight ahead without a look, and turns by chance."""

    def __init__(self) -> None:
        super().__init__("careless_driver")
        self.until, self.ahead, self.turn = 0.0, False, 0.0

    def command(self, now: float) -> Speeds:
        """Ahead for some seconds, then a turn on the spot, and so on."""
        if now >= self.until:
            self.ahead = not self.ahead
            self.until = now + (random.uniform(4.0, 8.0) if self.ahead else random.uniform(1.0, 2.0))
            self.turn = random.choice((-1.2, 1.2))
        return (0.4, 0.0) if self.ahead else (0.0, self.turn)


class CrashingDriver(BlindDriver):
    """Drives ahead. After some 4 s it publishes nothing for 3 s, then it carries on."""

    def __init__(self) -> None:
        super().__init__("crashing_driver")
        self.start = random.uniform(3.5, 4.5)

    def command(self, now: float) -> Speeds | None:
        """Ahead, except in the pause."""
        return None if self.start < now < self.start + 3.0 else (0.4, 0.0)


class Turner(BlindDriver):
    """Turns the robot on the spot."""

    def __init__(self, seed: int) -> None:
        super().__init__("turner")
        draw = random.Random(f"turner {seed}")
        self.turn = draw.choice((-1.0, 1.0)) * draw.uniform(0.3, 0.6)  # rad/s

    def command(self, now: float) -> Speeds:
        """Always the same."""
        return 0.0, self.turn


def turner(seed: int) -> list[Callable[[], Node]]:
    """Return the program of a seed, as companions of a run."""
    return [functools.partial(Turner, seed)]


class Rounds(BlindDriver):
    """Drives one circle after another, to the left."""

    speeds: ClassVar[Speeds] = (0.3, 0.5)

    def __init__(self) -> None:
        super().__init__("rounds")

    def command(self, now: float) -> Speeds:
        """Always the same."""
        return self.speeds


class Shuttle(BlindDriver):
    """Drives ahead for `leg` seconds, turns around, drives back, and so on."""

    leg: ClassVar[float] = 9.0

    def __init__(self) -> None:
        super().__init__("shuttle")

    def command(self, now: float) -> Speeds:
        """Ahead, or half a turn."""
        return (0.4, 0.0) if now % (self.leg + HALF_TURN) < self.leg else (0.0, math.pi / HALF_TURN)
