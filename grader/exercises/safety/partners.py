"""Nodes of ours for 12_safety: drivers, a button with a bad cable, and a machine that gets hot and tired."""

from __future__ import annotations

import itertools
import math
import random

from geometry_msgs.msg import Twist
from rclpy.node import Node
from sensor_msgs.msg import BatteryState, Temperature
from std_msgs.msg import Bool
from std_srvs.srv import Trigger

from sim.evidence import since_start

RAW, BUTTON, RESET = "/cmd_vel_raw", "/emergency", "/reset"
JOY, NAV = "/cmd_vel_joy", "/cmd_vel_nav"
BATTERY, MOTOR = "/battery_state", "/motor_temperature"
Speeds = tuple[float, float]  # m/s, rad/s


def twist(speeds: Speeds) -> Twist:
    """A command of these speeds."""
    msg = Twist()
    msg.linear.x, msg.angular.z = speeds
    return msg


class Timed(Node):
    """Looks at the clock ten times a second."""

    period = 0.1  # s

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.create_timer(self.period, lambda: self.tick(since_start(self.get_clock().now().to_msg())))

    def tick(self, now: float) -> None:
        """What there is to do at this moment, s."""
        raise NotImplementedError


class Operator(Timed):
    """Drives (Twist on /cmd_vel_raw) and holds the emergency button (Bool on /emergency, all the time).

    Presses it while driving, asks for /reset with the button in, once or twice, lets it go, drives on all the
    while, falls silent, asks for /reset again, and drives on later. Then the button's cable is broken for a
    while.
    """

    def __init__(self) -> None:
        super().__init__("operator")
        steps = [
            (2.0, 3.0),
            (0.6, 0.9),
            (0.5, 0.8),
            (1.0, 1.4),
            (0.7, 0.9),
            (1.0, 1.4),
            (1.5, 2.0),
            (1.6, 1.9),
        ]
        times = list(itertools.accumulate(random.uniform(*step) for step in steps))
        self.press, refused, self.release, self.quiet, accepted, self.speak, self.cut, self.mend = times
        sides = random.choice((-1.0, 1.0)), random.choice((-1.0, 1.0))
        self.speeds = [(random.uniform(0.15, 0.35), side * random.uniform(0.1, 0.5)) for side in sides]
        again = random.choice(([], [refused + 0.25]))  # who only counts the calls doesn't know how often
        self.resets = [accepted, *again, refused]
        self.commands = self.create_publisher(Twist, RAW, 10)
        self.button = self.create_publisher(Bool, BUTTON, 10)
        self.client = self.create_client(Trigger, RESET)

    def tick(self, now: float) -> None:
        """Say what holds now: the button first."""
        if not self.cut <= now < self.mend:
            self.button.publish(Bool(data=self.press <= now < self.release))
        if self.resets and now >= self.resets[-1]:
            self.resets.pop()
            if self.client.service_is_ready():
                self.client.call_async(Trigger.Request())
        if not self.quiet <= now < self.speak:
            self.commands.publish(twist(self.speeds[now >= self.speak]))


class Drivers(Timed):
    """A navigator (Twist on /cmd_vel_nav) and a joystick (on /cmd_vel_joy), each with pauses.

    The joystick begins with a stop. The navigator falls silent while the joystick drives; then both are.
    Each speaks ten times a second, in turn.
    """

    period = 0.05

    def __init__(self) -> None:
        super().__init__("drivers")
        self.turns = itertools.cycle((JOY, NAV))
        steps = [
            (1.8, 2.4),
            (0.7, 1.0),
            (0.9, 1.3),
            (1.6, 2.0),
            (1.0, 1.4),
            (0.9, 1.2),
            (1.8, 2.2),
            (1.4, 1.8),
        ]
        joy, moves, rests, again, falls, ends, back, last = itertools.accumulate(
            random.uniform(*one) for one in steps
        )
        self.outlets = {topic: self.create_publisher(Twist, topic, 10) for topic in (JOY, NAV)}
        side = random.choice((-1.0, 1.0))
        slow, fast = random.uniform(0.1, 0.2), random.uniform(0.25, 0.35)
        nav, turn = (slow, side * random.uniform(0.2, 0.5)), (0.0, -side * random.uniform(0.6, 1.2))
        self.plan = [
            (NAV, 0.0, falls, nav),
            (JOY, joy, moves, (0.0, 0.0)),
            (JOY, moves, rests, (-slow, 0.0)),
            (JOY, again, ends, turn),
            (NAV, back, last, (fast, 0.0)),
        ]

    def tick(self, now: float) -> None:
        """One of them says what it wants now, or nothing."""
        turn = next(self.turns)
        for topic, begin, end, speeds in self.plan:
            if topic == turn and begin <= now < end:
                self.outlets[topic].publish(twist(speeds))


class Rough(Timed):
    """Drives without feeling (Twist on /cmd_vel_raw, at 20 Hz): fast, slow, back, not at all, nonsense."""

    period = 0.05

    def __init__(self) -> None:
        super().__init__("rough")
        self.publisher = self.create_publisher(Twist, RAW, 10)
        draw, side = random.uniform, random.choice((-1.0, 1.0))
        wishes = [
            (draw(0.15, 0.28), side * draw(0.2, 0.5)),
            (draw(0.5, 0.9), -side * draw(1.5, 2.5)),
            (-draw(0.1, 0.28), side * draw(0.6, 0.9)),
            (draw(0.2, 0.28), 0.0),
            (-draw(0.5, 0.9), side * draw(0.3, 0.8)),
        ]
        random.shuffle(wishes)
        wishes.insert(random.randint(1, 2), (0.0, 0.0))
        wishes.insert(random.randint(4, 5), (math.nan, math.inf))
        lengths = [20 if wish[0] in (0.0, math.inf) or math.isnan(wish[0]) else 30 for wish in wishes]
        self.ticks, self.plan = 0, list(zip(itertools.accumulate(lengths), wishes, strict=True))

    def tick(self, now: float) -> None:
        """The next wish; nothing after the last one."""
        self.ticks += 1
        wish = next((wish for end, wish in self.plan if self.ticks <= end), None)
        if wish is not None:
            self.publisher.publish(twist(wish))


LEVELS = {
    BATTERY: ((0.32, 0.95), (0.12, 0.28), (0.02, 0.08), None),
    MOTOR: ((20.0, 58.0), (62.0, 78.0), (82.0, 99.0), None),
}


class Patient(Timed):
    """A battery (BatteryState, percentage 0 to 1) and a motor (Temperature, Celsius), 5 times a second.

    Well, so so, badly, silent: in an order that the seed gives, each its own.
    """

    period, phase = 0.2, 2.6  # s

    def __init__(self) -> None:
        super().__init__("patient")
        self.plan = {topic: self._drawn(*levels) for topic, levels in LEVELS.items()}
        self.batteries = self.create_publisher(BatteryState, BATTERY, 10)
        self.motors = self.create_publisher(Temperature, MOTOR, 10)

    def _drawn(self, *levels: tuple[float, float] | None) -> list[float | None]:
        order = random.sample(levels, 4)
        while order[0] is None:
            random.shuffle(order)
        order.append(random.choice(levels[:3]))
        return [None if level is None else round(random.uniform(*level), 3) for level in order]

    def tick(self, now: float) -> None:
        """Both say how they are now, or nothing."""
        level, heat = (self.plan[topic][min(int(now / self.phase), 4)] for topic in (BATTERY, MOTOR))
        stamp = self.get_clock().now().to_msg()
        if level is not None:
            msg = BatteryState(percentage=level)
            msg.header.stamp = stamp
            self.batteries.publish(msg)
        if heat is not None:
            msg = Temperature(temperature=heat)
            msg.header.stamp = stamp
            self.motors.publish(msg)
