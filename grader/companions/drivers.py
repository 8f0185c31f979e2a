"""Drivers of a robot: an operator with an emergency button, a navigator and a joystick, a rough driver."""

import itertools
import math
import random

from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_msgs.msg import Bool
from std_srvs.srv import Trigger

from sim.evidence import since_start

RAW, BUTTON, RESET = "/cmd_vel_raw", "/emergency", "/reset"
JOY, NAV = "/cmd_vel_joy", "/cmd_vel_nav"
Speeds = tuple[float, float]  # m/s, rad/s


def twist(speeds: Speeds) -> Twist:
    """Return a command with these speeds."""
    msg = Twist()
    msg.linear.x, msg.angular.z = speeds
    return msg


class TimedNode(Node):
    """Calls `tick` with the time ten times a second."""

    period = 0.1  # s

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.create_timer(self.period, lambda: self.tick(since_start(self.get_clock().now().to_msg())))

    def tick(self, now: float) -> None:
        """Do what is due at this time, s."""
        raise NotImplementedError


class EmergencyOperator(TimedNode):
    """Drives (Twist on /cmd_vel_raw) and holds the emergency button (Bool on /emergency, all the time).

    Presses it while driving, calls /reset with the button pressed, once or twice, releases it, drives on all
    the time, goes silent, calls /reset again, drives on later. Then the button's cable is cut for some time,
    in which it calls /reset once more.
    """

    period = 0.05

    def __init__(self) -> None:
        super().__init__("operator")
        steps = [(2.0, 3.0), (0.6, 0.9), (0.5, 0.8), (1.0, 1.4), (0.7, 0.9), (1.0, 1.4), (1.5, 2.0),
                 (1.6, 1.9)]
        times = list(itertools.accumulate(random.uniform(*step) for step in steps))
        self.press, refused, self.release, self.quiet, accepted, self.speak, self.cut, self.repaired = times
        sides = random.choice((-1.0, 1.0)), random.choice((-1.0, 1.0))
        self.speeds = [(random.uniform(0.15, 0.35), side * random.uniform(0.1, 0.5)) for side in sides]
        again = random.choice(([], [refused + 0.25]))  # so that counting the calls is no solution
        self.resets = [self.cut + random.uniform(1.1, 1.4), accepted, *again, refused]
        self.commands = self.create_publisher(Twist, RAW, 10)
        self.button = self.create_publisher(Bool, BUTTON, 10)
        self.client = self.create_client(Trigger, RESET)
        self.ticks = 0

    def tick(self, now: float) -> None:
        """Publish the button and call /reset; in the next tick, publish the command.

        So a command comes after a reset and before the button's next message: what releases then is noticed.
        """
        self.ticks += 1
        if self.ticks % 2 == 0:
            if not self.quiet <= now < self.speak:
                self.commands.publish(twist(self.speeds[now >= self.speak]))
            return
        if not self.cut <= now < self.repaired:
            self.button.publish(Bool(data=self.press <= now < self.release))
        if self.resets and now >= self.resets[-1]:
            self.resets.pop()
            if self.client.service_is_ready():
                self.client.call_async(Trigger.Request())


class Drivers(TimedNode):
    """A navigator (Twist on /cmd_vel_nav) and a joystick (on /cmd_vel_joy), each with pauses.

    The joystick begins with a stop. The navigator goes silent while the joystick drives; then both are.
    Each publishes ten times a second, in turn.
    """

    period = 0.05

    def __init__(self) -> None:
        super().__init__("drivers")
        self.turns = itertools.cycle((JOY, NAV))
        steps = [(1.8, 2.4), (0.7, 1.0), (0.9, 1.3), (1.6, 2.0), (1.0, 1.4), (0.9, 1.2), (1.8, 2.2),
                 (1.4, 1.8)]
        times = itertools.accumulate(random.uniform(*step) for step in steps)
        joy, moves, rests, again, falls, ends, back, last = times
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
        """Let one of them publish its command, or nothing."""
        turn = next(self.turns)
        for topic, begin, end, speeds in self.plan:
            if topic == turn and begin <= now < end:
                self.outlets[topic].publish(twist(speeds))


class RoughDriver(TimedNode):
    """Drives roughly (Twist on /cmd_vel_raw, at 20 Hz): fast, slow, backwards, not at all, NaN, infinite."""

    period = 0.05

    def __init__(self) -> None:
        super().__init__("rough")
        self.publisher = self.create_publisher(Twist, RAW, 10)
        draw, side = random.uniform, random.choice((-1.0, 1.0))
        commands = [
            (draw(0.15, 0.28), side * draw(0.2, 0.5)),
            (draw(0.5, 0.9), -side * draw(1.5, 2.5)),
            (-draw(0.1, 0.28), side * draw(0.6, 0.9)),
            (draw(0.2, 0.28), 0.0),
            (-draw(0.5, 0.9), side * draw(0.3, 0.8)),
        ]
        random.shuffle(commands)
        commands.insert(random.randint(1, 2), (0.0, 0.0))
        place = random.randint(4, 5)
        commands[place:place] = [(math.nan, math.inf), (-math.inf, math.nan)]
        lengths = [30 if math.isfinite(command[0]) else 10 for command in commands]
        lengths[commands.index((0.0, 0.0))] = 20
        self.ticks, self.plan = 0, list(zip(itertools.accumulate(lengths), commands, strict=True))

    def tick(self, now: float) -> None:
        """Publish the next command; nothing after the last one."""
        self.ticks += 1
        command = next((command for end, command in self.plan if self.ticks <= end), None)
        if command is not None:
            self.publisher.publish(twist(command))
