"""Students' nodes in the other process that try to tamper with the evidence."""

import contextlib
import gc
import os
import signal
import sys

from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_msgs.msg import String

from sim import Recording
from sim.ros.fibers.scheduler import active
from sim.world import MobileRobot, Simulation


class Honest(Node):
    """Publishes "hello" at 10 Hz, and never moves the robot."""

    def __init__(self):
        super().__init__("honest")
        self.publisher = self.create_publisher(String, "chat", 10)
        self.create_publisher(Twist, "cmd_vel", 10)
        self.ticks = 0
        self.create_timer(0.1, self.tick)

    def tick(self):
        self.ticks += 1
        self.publisher.publish(String(data="hello"))
        if self.ticks == 5:
            self.try_it()

    def try_it(self):
        """What it tries."""


class Teleporter(Honest):
    """Searches memory for the robot."""

    def try_it(self):
        for thing in gc.get_objects():
            if isinstance(thing, MobileRobot | Simulation):
                self.get_logger().error("found the robot")


class Forger(Honest):
    """Changes all recordings in memory."""

    def try_it(self):
        for thing in gc.get_objects():
            if type(thing) is Recording:
                thing.published[:] = [message._replace(stamp=0.0) for message in thing.published]
                thing.path.append(None)
                thing.ended = None


class Hurried(Honest):
    """Advances its own clock by a minute."""

    def try_it(self):
        active().now += 60_000_000_000


class Lazy(Honest):
    """Stops its own clock."""

    def try_it(self):
        type(active()).now = property(lambda self: 0, lambda self, now: None)


class Spy(Honest):
    """Logs the seeds that it finds, and a random number."""

    def try_it(self):
        import random

        found = [str(thing.seed) for thing in gc.get_objects() if type(thing) is Recording]
        self.get_logger().info(f"{','.join(found)} {random.random()} {os.environ.get('COURSE_SECRET')}")


class Garbage(Honest):
    """Publishes invalid bytes."""

    def try_it(self):
        self.publisher.publish(b"\0\1\0\0\xff\xff\xff\xff")


class Heavy(Honest):
    """Publishes a message that is too long for the wire."""

    def try_it(self):
        self.publisher.publish(String(data="x" * 80_000_000))


class Killed(Honest):
    def try_it(self):
        os.kill(os.getpid(), signal.SIGKILL)


class Stopped(Honest):
    def try_it(self):
        os.kill(os.getpid(), signal.SIGSTOP)


class Exits(Honest):
    def try_it(self):
        sys.exit(3)


class Scribbler(Honest):
    """Writes into every socket it has."""

    def try_it(self):
        for descriptor in range(3, 64):
            with contextlib.suppress(OSError):
                os.write(descriptor, b"\0\0\0\1\x80")
