"""Guards: right ones, and wrong ones named by their defect."""

import math

import rclpy
from geometry_msgs.msg import Twist, Vector3
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import LaserScan


class Guard(Node):
    """As one would write it."""

    raw, half, limit = "/cmd_vel_raw", 31, 0.5

    def __init__(self):
        super().__init__("guard")
        self.scan = self.command = self.commanded = None
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(LaserScan, "/lidar", self.on_scan, 10)
        self.create_subscription(Twist, self.raw, self.on_command, 10)
        self.create_timer(0.05, self.decide)

    def on_scan(self, msg):
        self.scan = msg

    def on_command(self, msg):
        self.command, self.commanded = msg, self.get_clock().now()

    def decide(self):
        safe = Twist()
        if self.scan and self.command and self.scan_age() < 0.3 and self.command_age() < 0.3:
            self.filter(safe)
        self.publisher.publish(safe)

    def scan_age(self):
        return (self.get_clock().now() - Time.from_msg(self.scan.header.stamp)).nanoseconds / 1e9

    def command_age(self):
        return (self.get_clock().now() - self.commanded).nanoseconds / 1e9

    def filter(self, safe):
        safe.angular.z = self.command.angular.z
        if self.ahead() > self.limit:
            safe.linear.x = self.command.linear.x

    def ahead(self):
        return min([*self.scan.ranges[: self.half], *self.scan.ranges[-self.half :]])


class GuardInTheCallback(Node):
    """Decides when a command comes; a timer stops the robot where none does."""

    def __init__(self):
        super().__init__("safety_filter")
        self.front, self.stamp, self.commanded = 0.0, None, self.get_clock().now()
        self.create_timer(0.1, self.stop_without_commands)
        self.pub = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(LaserScan, "lidar", self.scan_cb, qos_profile_sensor_data)
        self.create_subscription(Twist, "cmd_vel_raw", self.cmd_cb, 10)

    def scan_cb(self, msg):
        front = [
            r
            for i, r in enumerate(msg.ranges)
            if math.cos(msg.angle_min + i * msg.angle_increment) > 0.8 and not math.isnan(r)
        ]
        self.front, self.stamp = min(front), Time.from_msg(msg.header.stamp)

    def stop_without_commands(self):
        if self.get_clock().now() - self.commanded > Duration(seconds=0.4):
            self.pub.publish(Twist())

    def cmd_cb(self, msg):
        self.commanded = self.get_clock().now()
        fresh = self.stamp is not None and self.get_clock().now() - self.stamp < Duration(seconds=0.4)
        if not fresh:
            msg = Twist()
        elif self.front < 0.5:
            msg.linear.x = min(msg.linear.x, 0.0)
        self.pub.publish(msg)


def main():
    """As tutorials write it, in one function; brakes gently as the wall comes near."""
    rclpy.init()
    node = rclpy.create_node("guard")
    pub = node.create_publisher(Twist, "/cmd_vel", 10)
    known = {"scan": None, "command": Twist(), "at": -1.0}

    def seconds():
        return node.get_clock().now().nanoseconds / 1e9

    def on_scan(msg):
        known["scan"] = msg

    def on_command(msg):
        known.update(command=msg, at=seconds())

    def tick():
        scan, command, out = known["scan"], known["command"], Twist()
        if scan is not None and seconds() - known["at"] < 0.5:
            measured = scan.header.stamp.sec + scan.header.stamp.nanosec * 1e-9
            if seconds() - measured < 0.5:
                ahead = min(scan.ranges[:35].tolist() + scan.ranges[-35:].tolist())
                out.linear.x = min(command.linear.x, max(0.0, ahead - 0.45))
                out.angular.z = command.angular.z
        pub.publish(out)

    node.create_subscription(LaserScan, "/lidar", on_scan, 10)
    node.create_subscription(Twist, "/cmd_vel_raw", on_command, 10)
    node.create_timer(0.1, tick)
    rclpy.spin(node)


class Watchdogs(Guard):
    """A design of its own: each source has a timer that stops the robot when it isn't reset."""

    def __init__(self):
        super().__init__()
        self.scan_dog = self.create_timer(0.3, self.forget_scan)
        self.command_dog = self.create_timer(0.3, self.forget_command)

    def on_scan(self, msg):
        age = (self.get_clock().now() - Time.from_msg(msg.header.stamp)).nanoseconds
        if age < 0.3e9:
            self.scan_dog.reset()
            self.scan = msg

    def on_command(self, msg):
        self.command_dog.reset()
        super().on_command(msg)

    def forget_scan(self):
        self.scan = None

    def forget_command(self):
        self.command = None

    def decide(self):
        safe = Twist()
        if self.scan and self.command:
            self.filter(safe)
        self.publisher.publish(safe)


class SilentWithoutCommands(GuardInTheCallback):
    """Trusts the robot to stop by itself when the driver falls silent."""

    def stop_without_commands(self):
        pass


class SilentWhileBlind(Guard):
    """Publishes only what it lets through, and no zeros."""

    def decide(self):
        if self.scan and self.command and self.scan_age() < 0.3 and self.command_age() < 0.3:
            super().decide()


class TurnsBetween(Guard):
    """Right 20 times a second, and between that it does as it likes."""

    def decide(self):
        super().decide()
        timer = self.create_timer(0.03, lambda: (timer.cancel(), self.turn()))

    def turn(self):
        self.publisher.publish(Twist(angular=Vector3(z=2.0)))


class NoWatchdog(Guard):
    """Trusts the last of everything."""

    def scan_age(self):
        return 0.0

    command_age = scan_age


class ForgetsTheDriver(Guard):
    def command_age(self):
        return 0.0


class ForgetsTheScan(Guard):
    def scan_age(self):
        return 0.0


class AgeSinceItCame(Guard):
    """Looks when the scan came, not when it was measured."""

    def on_scan(self, msg):
        super().on_scan(msg)
        self.came = self.get_clock().now()

    def scan_age(self):
        return (self.get_clock().now() - self.came).nanoseconds / 1e9


class LooksAtAgesInTheScanCallback(Guard):
    """No scan, no look."""

    old = False

    def on_scan(self, msg):
        super().on_scan(msg)
        self.old = super().scan_age() > 0.3

    def scan_age(self):
        return 1.0 if self.old else 0.0


class SlowDog(Guard):
    """Waits for 2 s before it calls something old."""

    def scan_age(self):
        return super().scan_age() - 1.7

    def command_age(self):
        return super().command_age() - 1.7


class AgeInMilliseconds(Guard):
    def scan_age(self):
        return super().scan_age() * 1000


class NeverForgives(Guard):
    """Once stopped, stopped forever."""

    stopped = False

    def decide(self):
        if self.scan and self.command:
            self.stopped |= self.scan_age() > 0.3 or self.command_age() > 0.3
        if not self.stopped:
            super().decide()


class StopsEverything(Guard):
    """Takes the turn away, too: the robot can never leave the wall."""

    def filter(self, safe):
        if self.ahead() > self.limit:
            super().filter(safe)


class LetsEverythingThrough(Guard):
    limit = -1.0


class LeavesOutInfinity(Guard):
    """Where nothing is in range, no ray is left."""

    def ahead(self):
        rays = [*self.scan.ranges[: self.half], *self.scan.ranges[-self.half :]]
        return min(ray for ray in rays if math.isfinite(ray))


class LooksThroughAStraw(Guard):
    half = 4


class StopsLate(Guard):
    limit = 0.14


class StopsAllRound(Guard):
    """min() of all rays: what stands beside the robot stops it."""

    limit = 0.8

    def ahead(self):
        return min(self.scan.ranges)


class AlwaysZero(Guard):
    def filter(self, safe):
        """Safe, and of no use."""


class ForgetsTheTurn(Guard):
    def filter(self, safe):
        super().filter(safe)
        safe.angular.z = 0.0


class ListensToTheRobotsTopic(Guard):
    """Receives itself in place of the driver."""

    raw = "/cmd_vel"


class NoScanYet(Guard):
    """Uses the scan before the first one is there."""

    def __init__(self):
        super().__init__()
        self.command, self.commanded = Twist(), self.get_clock().now()
        self.create_timer(0.01, self.ahead)


class Rarely(Guard):
    """Decides every second."""

    def __init__(self):
        super().__init__()
        self.timers_ = [timer.cancel() for timer in self.timers]
        self.create_timer(1.0, self.decide)


class NeverSaysThatAllIsWell(Guard):
    """A test without `return`."""

    def decide(self):
        safe = Twist()
        if self.is_well():
            self.filter(safe)
        self.publisher.publish(safe)

    def is_well(self):
        bool(self.scan and self.command and self.scan_age() < 0.3 and self.command_age() < 0.3)


class SubtractsTheStamp(Guard):
    """The stamp of a message is no Time of rclpy."""

    def scan_age(self):
        return (self.get_clock().now() - self.scan.header.stamp).nanoseconds / 1e9
