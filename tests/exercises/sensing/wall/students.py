"""Wall followers: right ones, and wrong ones named by their defect."""

import math
import time

import numpy as np
import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.wait_for_message import wait_for_message
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Float32MultiArray

from tests.students.teams import Team

PARTS = "Eyes", "Wheels"


class WallFollower(Node):
    """As one would write it: two rules, and the turn grows with the error."""

    topic = "/cmd_vel"
    gain, distance, speed, limit, side = 2.0, 0.5, 0.3, 0.6, slice(230, 311)

    def __init__(self):
        super().__init__("wall_follower")
        self.publisher = self.create_publisher(Twist, self.topic, 10)
        self.create_subscription(LaserScan, "/scan", self.look, 10)

    def look(self, msg):
        command = Twist()
        ahead = min([*msg.ranges[:20], *msg.ranges[-20:]])
        self.choose(command, ahead, self.to_the_wall(msg.ranges[self.side]))
        self.publisher.publish(command)

    def to_the_wall(self, ranges):
        return max(0.0, min(ranges))

    def choose(self, command, ahead, wall):
        if ahead < self.limit:
            command.angular.z = 1.0
        else:
            command.linear.x = self.speed
            command.angular.z = self.gain * (self.distance - wall)


class LooksAhead(WallFollower):
    """Measures the wall a little ahead, so it does not swing."""

    def look(self, msg):
        command = Twist()
        ahead = min([*msg.ranges[:21], *msg.ranges[-20:]])
        self.choose(command, ahead, self.to_the_wall(msg.ranges[290:311]) * math.sin(math.radians(60)))
        self.publisher.publish(command)


class TutorialWallFollower(Node):
    """A tutorial's state machine: find the wall, turn left, follow the wall."""

    def __init__(self):
        super().__init__("wall_follow_node")
        self.regions = {"right": 10.0, "fright": 10.0, "front": 10.0}
        self.state = 0
        self.sub = self.create_subscription(LaserScan, "/scan", self.clbk_laser, qos_profile_sensor_data)
        self.pub = self.create_publisher(Twist, "/cmd_vel", 1)
        self.timer = self.create_timer(0.05, self.control)

    def clbk_laser(self, msg):
        self.regions = {
            "right": min(min(msg.ranges[252:288]), 10),
            "fright": min(min(msg.ranges[288:342]), 10),
            "front": min(min(msg.ranges[342:]), min(msg.ranges[:18]), 10),
        }
        self.take_action()

    def take_action(self):
        d = 0.6
        if self.regions["front"] < d:
            self.state = 1
        elif self.regions["fright"] < d:
            self.state = 2
        else:
            self.state = 0

    def find_wall(self):
        msg = Twist()
        msg.linear.x = 0.2
        msg.angular.z = -0.3
        return msg

    def turn_left(self):
        msg = Twist()
        msg.angular.z = 0.6
        return msg

    def follow_the_wall(self):
        msg = Twist()
        msg.linear.x = 0.25
        msg.angular.z = 0.3 if self.regions["fright"] < 0.55 else 0.0
        return msg

    def control(self):
        self.pub.publish((self.find_wall, self.turn_left, self.follow_the_wall)[self.state]())


def main():
    """A design of its own: the angle to the wall from two rays, as in courses on racing cars."""
    rclpy.init()
    node = rclpy.create_node("wall_follow")
    pub = node.create_publisher(Twist, "cmd_vel", 10)
    theta = math.radians(45)

    def callback(scan):
        b, a = max(0.1, scan.ranges[270]), max(0.1, scan.ranges[315])  # -inf is too close
        alpha = math.atan2(a * math.cos(theta) - b, a * math.sin(theta))
        future = b * math.cos(alpha) + 0.3 * math.sin(alpha)
        msg = Twist()
        if min(*scan.ranges[:15], *scan.ranges[-15:]) < 0.55:
            msg.angular.z = 1.2
        else:
            msg.linear.x = 0.25
            msg.angular.z = max(-1.0, min(1.0, -1.5 * (future - 0.5)))
        pub.publish(msg)

    node.create_subscription(LaserScan, "scan", callback, 10)
    rclpy.spin(node)


class BangBang(WallFollower):
    """Three answers and no more: too near, too far, or well."""

    def choose(self, command, ahead, wall):
        command.linear.x = 0.2
        if ahead < 0.6:
            command.linear.x, command.angular.z = 0.0, 0.8
        elif wall < 0.45:
            command.angular.z = 0.3
        elif wall > 0.55:
            command.angular.z = -0.3


class WithDerivative(WallFollower):
    """PD: the change of the error damps."""

    before = 0.0

    async def look(self, msg):
        super().look(msg)

    def choose(self, command, ahead, wall):
        error = self.distance - wall
        change, self.before = (error - self.before) * 20, error
        command.linear.x = 0.35 if ahead > 0.7 else 0.0
        command.angular.z = 1.5 * error + 0.5 * change if ahead > 0.7 else 1.5


class KeepsTheNearestBeside(Node):
    """The nearest ray belongs at -90 degrees: it turns until it is there, and drives as far as it is."""

    def __init__(self):
        super().__init__("nearest")
        self.pub = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(LaserScan, "scan", self.on_scan, qos_profile_sensor_data)

    def on_scan(self, msg):
        ranges = np.maximum(np.array(msg.ranges), 0.0)
        angles = msg.angle_min + np.arange(len(ranges)) * msg.angle_increment
        near = ranges <= ranges.min() + 0.01  # several rays, and all that are too close to be measured
        bearing = math.atan2(np.sin(angles[near]).sum(), np.cos(angles[near]).sum())
        off = math.remainder(bearing + math.pi / 2, math.tau)
        command = Twist()
        command.linear.x = 0.25 if abs(off) < 0.5 and ranges[:15].min() > 0.55 else 0.0
        command.angular.z = 1.0 if ranges[:15].min() < 0.55 else off + 1.5 * (0.5 - float(ranges.min()))
        self.pub.publish(command)


class FitsALine(WallFollower):
    """Least squares through all points on the right: the line's distance, and the way it runs."""

    def look(self, msg):
        ranges = np.maximum(np.array(msg.ranges), 0.05)
        angles = np.radians(np.arange(360))
        xs, ys = ranges * np.cos(angles), ranges * np.sin(angles)
        beside = slice(250, 311)
        slope, offset = np.polyfit(xs[beside], ys[beside], 1)
        command, ahead = Twist(), ranges[np.r_[0:20, 340:360]].min()
        command.linear.x = 0.3 if ahead > 0.7 else 0.0
        error = 0.5 - abs(offset) / math.hypot(1.0, slope)
        command.angular.z = 2.0 * float(error) + 2.5 * math.atan(slope) if ahead > 0.7 else 1.2
        self.publisher.publish(command)


class QuarterTurns(WallFollower):
    """States with names; a corner is a quarter turn to the left by odometry, and the rest is a straight line."""

    def __init__(self):
        super().__init__()
        self.state, self.yaw, self.until = "along", None, 0.0
        self.create_subscription(Odometry, "/odom", self.on_odometry, 10)

    def on_odometry(self, msg):
        turn = msg.pose.pose.orientation
        self.yaw = 2 * math.atan2(turn.z, turn.w)

    def choose(self, command, ahead, wall):
        if self.yaw is None:
            return
        if self.state == "along" and ahead < 0.55:
            self.state, self.until = "corner", self.yaw + math.pi / 2
        if self.state == "corner":
            left = math.remainder(self.until - self.yaw, math.tau)
            command.angular.z = max(-1.0, min(1.0, 2.0 * left))
            if abs(left) < 0.05:
                self.state = "along"
        else:
            command.linear.x, command.angular.z = 0.3, max(-0.8, min(0.8, 1.5 * (0.5 - wall)))


class AimsAtAPoint(WallFollower):
    """Pure pursuit of a point 0.5 m from the wall and a little ahead; the wall ahead counts as much as the one beside."""

    def look(self, msg):
        ahead = max(0.0, min([*msg.ranges[:20], *msg.ranges[-20:]]))
        side = max(0.0, min(msg.ranges[240:301]))
        x, y = 0.5, 0.5 - side
        if ahead < 0.75:
            x, y = ahead - 0.5, max(y, 0.35)
        command, angle = Twist(), math.atan2(y, x)
        command.linear.x = 0.3 * max(0.0, math.cos(angle))
        command.angular.z = 2.0 * angle
        self.publisher.publish(command)


class Eyes(Node):
    """One half: the distances ahead and to the right, on a topic of its own."""

    def __init__(self):
        super().__init__("eyes")
        self.pub = self.create_publisher(Float32MultiArray, "/distances", 10)
        self.create_subscription(LaserScan, "/scan", self.on_scan, qos_profile_sensor_data)

    def on_scan(self, msg):
        ahead, right = min([*msg.ranges[:20], *msg.ranges[-20:]]), min(msg.ranges[230:311])
        self.pub.publish(Float32MultiArray(data=[max(0.0, each) for each in (ahead, right)]))


class Wheels(Node):
    """The other half: a PID controller on a timer, whose sum is cleared in corners."""

    def __init__(self):
        super().__init__("wheels")
        self.pub = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(Float32MultiArray, "/distances", self.on_distances, 10)
        self.create_timer(0.05, self.tick)
        self.distances, self.total, self.before = None, 0.0, 0.0

    def on_distances(self, msg):
        self.distances = msg.data

    def tick(self):
        if self.distances is None:
            return
        command, (ahead, right) = Twist(), self.distances
        error = 0.5 - right
        self.total = 0.0 if ahead < 0.6 else max(-0.5, min(0.5, self.total + 0.05 * error))
        change, self.before = (error - self.before) / 0.05, error
        if ahead < 0.6:
            command.angular.z = 1.0
        else:
            command.linear.x = 0.28
            command.angular.z = 2.0 * error + 0.1 * self.total + 0.2 * change
        self.pub.publish(command)


EyesAndWheels = Team(Eyes, Wheels)


def loop():
    """Sense, think, act, and wait for the next scan: no callback, no class."""
    rclpy.init()
    node = Node("wall_follower")
    publisher = node.create_publisher(Twist, "cmd_vel", 10)
    while rclpy.ok():
        got, scan = wait_for_message(LaserScan, node, "scan", qos_profile=qos_profile_sensor_data)
        if not got:
            continue
        front = [r for i, r in enumerate(scan.ranges) if i < 20 or i > 340]
        right = [r for i, r in enumerate(scan.ranges) if 230 <= i <= 310]
        twist = Twist()
        if min(front) < 0.6:
            twist.angular.z = 1.0
        else:
            twist.linear.x = 0.3
            twist.angular.z = 2.0 * (0.5 - max(0.0, min(right)))
        publisher.publish(twist)


class TurnsInfinitely(WallFollower):
    """Where the wall is too close, the distance is -inf, and so is the turn: the robot refuses it."""

    def to_the_wall(self, ranges):
        return min(ranges)


class Nervous(WallFollower):
    """Far too large a gain: it wobbles, but it gets round."""

    gain = 40.0


class WallOnTheLeft(WallFollower):
    """Goes round the other way: at the first wall it turns right."""

    side = slice(50, 131)

    def choose(self, command, ahead, wall):
        super().choose(command, ahead, wall)
        command.angular.z *= -1.0


class StraightOn(WallFollower):
    """Never looks at the wall on its right, and turns left at the walls ahead."""

    gain = 0.0


class NeverTurns(WallFollower):
    """Steers, but does not see the wall ahead."""

    limit = 0.0


class SignTurned(WallFollower):
    gain = -2.0


class TooFarAway(WallFollower):
    distance = 1.1
    limit = 1.2


class TooNear(WallFollower):
    distance, limit = 0.2, 0.25


class TooNearToMeasure(TooNear):
    """Too near, and where the lidar can't measure that, the turn is infinite."""

    def to_the_wall(self, ranges):
        return min(ranges)


class FallsAsleep(WallFollower):
    """Gets round, and after 70 s no longer looks ahead."""

    def __init__(self):
        super().__init__()
        self.evening = self.get_clock().now() + Duration(seconds=70)

    def choose(self, command, ahead, wall):
        asleep = self.get_clock().now() > self.evening
        super().choose(command, math.inf if asleep else ahead, 0.5 if asleep else wall)


class TooSlow(WallFollower):
    speed = 0.05


class StandsStill(WallFollower):
    speed, gain = 0.0, 0.0


class TurnsRightAtWalls(WallFollower):
    def choose(self, command, ahead, wall):
        super().choose(command, ahead, wall)
        if ahead < self.limit:
            command.angular.z = -1.0


class Wanders(WallFollower):
    """Turns until it is free, in place of following."""

    def choose(self, command, ahead, wall):
        if min(ahead, wall) < 0.4:
            command.angular.z = 1.0
        else:
            command.linear.x = 0.3


class IndexTooLarge(WallFollower):
    def look(self, msg):
        super().look(msg)
        msg.ranges[360]


class MisspeltTopic(WallFollower):
    topic = "cmd_vell"


class IntoTheCorner(WallFollower):
    """Has no rule for the wall ahead."""

    def choose(self, command, ahead, wall):
        super().choose(command, math.inf, wall)


class ByTheClock(Node):
    """Knows the room by heart: 8 s straight on, a quarter turn, and again."""

    def __init__(self):
        super().__init__("clock")
        self.pub = self.create_publisher(Twist, "/cmd_vel", 10)
        self.begin = self.get_clock().now()
        self.create_timer(0.1, self.tick)

    def tick(self):
        command = Twist()
        into = ((self.get_clock().now() - self.begin).nanoseconds / 1e9) % 9.57
        command.linear.x, command.angular.z = (0.3, 0.0) if into < 8.0 else (0.0, 1.0)
        self.pub.publish(command)


class EverySecondScan(WallFollower):
    """A callback that sleeps: it acts on what was."""

    def look(self, msg):
        time.sleep(1.0)
        super().look(msg)


class GoesBackAndForth(WallFollower):
    """In a corner it turns round, and follows the wall on its other side."""

    way = 1.0

    def look(self, msg):
        if min([*msg.ranges[:20], *msg.ranges[-20:]]) < 0.5:
            self.way = -1.0
        command = Twist()
        command.linear.x = 0.2 * self.way
        self.publisher.publish(command)
