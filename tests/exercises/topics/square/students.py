"""Drivers of a square: right ones, and wrong ones named by their defect."""

import math
import signal
import time

import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions


class SquareDriver(Node):
    """By ticks of a timer: 2 s for each side, 2 s for each corner."""

    topic, sides, speed, turn = "/cmd_vel", 4, 0.5, math.pi / 4
    period = 0.1

    def __init__(self):
        super().__init__("square_driver")
        self.publisher = self.create_publisher(Twist, self.topic, 10)
        self.ticks = 0
        self.create_timer(self.period, self.drive)

    def drive(self):
        msg = Twist()
        side, tick = divmod(self.ticks, 40)
        if side < self.sides:
            self.steer(msg, tick)
        self.ticks += 1
        self.publisher.publish(msg)

    def steer(self, msg, tick):
        if tick < 20:
            msg.linear.x = self.speed
        else:
            msg.angular.z = self.turn


def main_that_sleeps():
    """Ends by itself, without a last command."""
    rclpy.init()
    node = Node("square")
    publisher = node.create_publisher(Twist, "cmd_vel", 10)

    def drive(speed, turn, seconds):
        msg = Twist()
        msg.linear.x, msg.angular.z = speed, turn
        for _ in range(round(seconds * 20)):
            publisher.publish(msg)
            time.sleep(0.05)

    for _ in range(4):
        drive(0.25, 0.0, 4.0)
        drive(0.0, math.pi / 2, 1.0)
    publisher.publish(Twist())
    node.destroy_node()
    rclpy.shutdown()


class SquareByOdometry(Node):
    """Looks where it is: straight on to the next corner, then turn until it looks along the next side."""

    corners = ((1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0))

    def __init__(self):
        super().__init__("square")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.leg = 0
        self.create_subscription(Odometry, "/odom", self.drive, 10)

    def drive(self, odometry):
        msg = Twist()
        if self.leg < 4:
            pose = odometry.pose.pose
            yaw = 2 * math.atan2(pose.orientation.z, pose.orientation.w)
            dx, dy = self.corners[self.leg][0] - pose.position.x, self.corners[self.leg][1] - pose.position.y
            error = math.remainder(math.atan2(dy, dx) - yaw, math.tau)
            if math.hypot(dx, dy) < 0.03:
                self.leg += 1
            elif abs(error) > 0.2:
                msg.angular.z = math.copysign(0.8, error)
            else:
                msg.linear.x, msg.angular.z = min(0.4, math.hypot(dx, dy) + 0.05), error
        self.publisher.publish(msg)


class SquareInOneCallback(Node):
    """A one-shot timer whose callback drives the whole way and waits with the clock's sleep."""

    def __init__(self):
        super().__init__("square")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.timer = self.create_timer(0.5, self.go)

    def go(self):
        self.timer.cancel()
        for speed, turn in [(0.4, 0.0), (0.0, math.pi / 5)] * 4:
            msg = Twist()
            msg.linear.x, msg.angular.z = speed, turn
            for _ in range(25):
                self.publisher.publish(msg)
                time.sleep(0.1)
        self.publisher.publish(Twist())


class SlowSquare(SquareDriver):
    """Takes 58 s of the 60."""

    def drive(self):
        msg = Twist()
        side, tick = divmod(self.ticks, 145)
        if side < 4 and tick < 125:
            msg.linear.x = 0.08
        elif side < 4:
            msg.angular.z = math.pi / 4
        self.ticks += 1
        self.publisher.publish(msg)


class StandsStill(SquareDriver):
    sides = 0


class MisspeltTopic(SquareDriver):
    topic = "/cmd_val"


class TurnsRight(SquareDriver):
    turn = -math.pi / 4


class DegreesNotRadians(SquareDriver):
    turn = 45.0


class ThreeSides(SquareDriver):
    sides = 3


class NeverStops(SquareDriver):
    sides = 10**6


class LazyDriver(SquareDriver):
    """Lesson 2's: a command every 2 s."""

    period = 2.0


class CommandsTooRarely(Node):
    """One command for each side and corner: the robot stops on its own 0.5 s later."""

    def __init__(self):
        super().__init__("square_driver")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.leg = 0
        self.create_timer(2.0, self.drive)

    def drive(self):
        msg = Twist()
        if self.leg < 8:
            msg.linear.x, msg.angular.z = ((0.5, 0.0), (0.0, math.pi / 4))[self.leg % 2]
        self.leg += 1
        self.publisher.publish(msg)


class DrivesSideways(SquareDriver):
    """A differential drive has no linear.y."""

    def steer(self, msg, tick):
        side = self.ticks // 40
        setattr(msg.linear, "xyxy"[side], 0.25 if side < 2 else -0.25)


class WholeNumber(SquareDriver):
    def steer(self, msg, tick):
        msg.linear.x = 1


class LeavesTheStopToTheRobot(SquareDriver):
    """Falls silent after the last corner, in place of a last command."""

    def drive(self):
        if self.ticks < 160:
            super().drive()


def main_that_leaves_ctrl_c_to_itself(args=None):
    """Right, too: ROS is still up at its end, so that it can stop the robot."""
    rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    node = SquareDriver()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.publisher.publish(Twist())
        time.sleep(0.2)
        node.destroy_node()
        rclpy.try_shutdown()
