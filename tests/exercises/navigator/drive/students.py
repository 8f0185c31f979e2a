"""Drivers to (5, 5): right ones, a tutorial's listing among them, and wrong ones named by their defect."""

import math

import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node

from tests.exercises.navigator.compass.students import yaw_of


class GoToGoal(Node):
    """As the notebook has it; the wrong ones change a part."""

    topic, near, gain, speed = "/cmd_vel", 0.1, 2.0, 0.4

    def __init__(self):
        super().__init__("go_to_goal")
        self.publisher = self.create_publisher(Twist, self.topic, 10)
        self.create_subscription(Odometry, "/odom", self.on_odom, 10)

    def on_odom(self, msg):
        position, yaw = msg.pose.pose.position, yaw_of(msg.pose.pose.orientation)
        dx, dy = 5.0 - position.x, 5.0 - position.y
        command = Twist()
        self.steer(command, math.hypot(dx, dy), math.remainder(math.atan2(dy, dx) - yaw, math.tau))
        self.publisher.publish(command)

    def steer(self, command, distance, bearing):
        if distance > self.near:
            command.angular.z = self.gain * bearing
            command.linear.x = self.speed * max(0.0, math.cos(bearing))


class SimpleNavigator(Node):
    """A tutorial's listing: fixed goal, a control loop on a timer, states turn and drive."""

    def __init__(self):
        super().__init__("simple_navigator")
        self.goal_x = 5.0
        self.goal_y = 5.0
        self.x = 0.0
        self.y = 0.0
        self.yaw = 0.0
        self.cmd_vel_pub = self.create_publisher(Twist, "cmd_vel", 10)
        self.odom_sub = self.create_subscription(Odometry, "odom", self.odom_callback, 10)
        self.timer = self.create_timer(0.1, self.control_loop)
        self.get_logger().info("Navigator started")

    def odom_callback(self, msg):
        self.x = msg.pose.pose.position.x
        self.y = msg.pose.pose.position.y
        q = msg.pose.pose.orientation
        siny_cosp = 2 * (q.w * q.z + q.x * q.y)
        cosy_cosp = 1 - 2 * (q.y * q.y + q.z * q.z)
        self.yaw = math.atan2(siny_cosp, cosy_cosp)

    def control_loop(self):
        distance = math.sqrt((self.goal_x - self.x) ** 2 + (self.goal_y - self.y) ** 2)
        angle_to_goal = math.atan2(self.goal_y - self.y, self.goal_x - self.x)
        angle_error = angle_to_goal - self.yaw
        cmd = Twist()
        if distance < 0.1:
            self.get_logger().info("Goal reached!")
        elif abs(angle_error) > 0.1:
            cmd.angular.z = 0.5 if angle_error > 0 else -0.5
        else:
            cmd.linear.x = min(0.5, 0.5 * distance)
        self.cmd_vel_pub.publish(cmd)


def tutorial_main(args=None):
    """Its main(), without try and finally."""
    rclpy.init(args=args)
    navigator = SimpleNavigator()
    rclpy.spin(navigator)
    navigator.destroy_node()
    rclpy.shutdown()


def main_that_ends():
    """Spins once at a time, stops the robot, and ends."""
    rclpy.init()
    node = Node("go")
    publisher = node.create_publisher(Twist, "/cmd_vel", 1)
    seen = []
    node.create_subscription(Odometry, "/odom", seen.append, 1)
    while rclpy.ok():
        rclpy.spin_once(node)
        if not seen:
            continue
        pose = seen[-1].pose.pose
        to_goal = complex(5 - pose.position.x, 5 - pose.position.y)
        if abs(to_goal) < 0.08:
            break
        ahead = to_goal * complex(pose.orientation.w, -pose.orientation.z) ** 2
        command = Twist()
        command.linear.x = max(0.0, min(0.5, ahead.real))
        command.angular.z = max(-1.5, min(1.5, 3 * ahead.imag))
        publisher.publish(command)
    publisher.publish(Twist())
    node.destroy_node()
    rclpy.shutdown()


class OnACircle(GoToGoal):
    """A design of its own: turns on the spot first, then drives on the circle that leads to the goal."""

    def steer(self, command, distance, bearing):
        if distance < self.near:
            return
        if abs(bearing) > 0.5:
            command.angular.z = math.copysign(1.0, bearing)
            return
        command.linear.x = min(0.5, 0.1 + distance)
        command.angular.z = command.linear.x * 2 * math.sin(bearing) / distance


class AskedByTimer(GoToGoal):
    """A class with the pose kept apart, twice as often as odometry comes."""

    latest = None

    def __init__(self):
        super().__init__()
        self.create_timer(0.025, self.tick)

    def on_odom(self, msg):
        self.latest = msg

    def tick(self):
        if self.latest is not None:
            super().on_odom(self.latest)


class StandsStill(GoToGoal):
    speed = 0.0


class Misspelt(GoToGoal):
    topic = "/cmdvel"


class NeverTurns(GoToGoal):
    gain = 0.0


class TurnsAway(GoToGoal):
    gain = -2.0


class TurnsExactly(GoToGoal):
    """First turns to within 0.02 rad: but over a network the command to stop turning comes late."""

    def steer(self, command, distance, bearing):
        if distance < self.near:
            return
        if abs(bearing) > 0.02:
            command.angular.z = math.copysign(0.6, bearing)
        else:
            command.linear.x = 0.5


class NeverStops(GoToGoal):
    near = -1.0


class TooSlow(GoToGoal):
    speed = 0.08


class Backwards(GoToGoal):
    speed = -0.4


class OneCommand(GoToGoal):
    """Sends the right command once."""

    sent = False

    def on_odom(self, msg):
        if not self.sent:
            super().on_odom(msg)
        self.sent = True


class AlongTheAxes(GoToGoal):
    """First along x, then along y."""

    def on_odom(self, msg):
        position, yaw = msg.pose.pose.position, yaw_of(msg.pose.pose.orientation)
        command = Twist()
        if position.x < 4.95:
            command.linear.x = 0.5
        elif yaw < math.pi / 2 - 0.02:
            command.angular.z = 0.8 * (math.pi / 2 - yaw) + 0.05
        elif position.y < 4.95:
            command.linear.x = 0.4
        self.publisher.publish(command)


class FullSpeedInTheCurve(GoToGoal):
    """Looks away from the goal at first, and swings out far."""

    def steer(self, command, distance, bearing):
        if distance > self.near:
            command.linear.x, command.angular.z = 0.6, 0.25 * bearing


class WholeNumber(GoToGoal):
    def steer(self, command, distance, bearing):
        command.linear.x = 1


class PassesBy(GoToGoal):
    """Comes near, but not within 0.1 m, and goes on."""

    def steer(self, command, distance, bearing):
        if distance > self.near:
            command.linear.x, command.angular.z = 0.4, 0.2 * bearing


class WrongWayRound(GoToGoal):
    def steer(self, command, distance, bearing):
        if distance < self.near:
            super().steer(command, 1.0, bearing)


class DrivesThrough(GoToGoal):
    """Near the goal it carries on straight ahead."""

    near = 0.15

    def steer(self, command, distance, bearing):
        super().steer(command, distance, bearing)
        self.near = math.inf if distance < self.near else self.near
        if self.near == math.inf:
            command.linear.x = self.speed
