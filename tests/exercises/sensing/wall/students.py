"""Wall followers: right ones, and wrong ones named by their defect."""

import math

import rclpy
from geometry_msgs.msg import Twist
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan


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
