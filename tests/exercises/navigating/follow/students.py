"""Followers of a path: right ones, and wrong ones named by their defect."""

import math

import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry, Path
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from tf2_msgs.msg import TFMessage

from tests.exercises.navigator.parts import Localized, carrot, steer


class Follower(Localized):
    """Pure pursuit, as the notebook has it; the wrong ones change a part."""

    ahead, near, speed, topic = 0.3, 0.1, 0.4, "/cmd_vel"

    def __init__(self):
        super().__init__("follower")
        self.path = []
        self.publisher = self.create_publisher(Twist, self.topic, 10)
        self.create_subscription(Path, "/plan", self.on_plan, 10)
        self.create_timer(0.1, self.drive)

    def on_plan(self, msg):
        self.path = [(pose.pose.position.x, pose.pose.position.y) for pose in msg.poses]

    def drive(self):
        command = Twist()
        if self.path and not self.is_lost and math.dist(self.pose[:2], self.path[-1]) > self.near:
            command.linear.x, command.angular.z = self.steer(self.carrot())
        self.publisher.publish(command)

    def carrot(self):
        return carrot(self.path, self.pose, self.ahead)

    def steer(self, point):
        return steer(self.pose, point, self.speed)


class FromPointToPoint(Follower):
    """A design of its own: drives to one point after the other, and turns as far as it is off."""

    index = 0

    def carrot(self):
        while self.index < len(self.path) - 1 and math.dist(self.pose[:2], self.path[self.index]) < 0.2:
            self.index += 1
        return self.path[self.index]

    def steer(self, point):
        x, y, yaw = self.pose
        off = math.remainder(math.atan2(point[1] - y, point[0] - x) - yaw, math.tau)
        return 0.3 * max(0.0, math.cos(off)) ** 3, max(-2.0, min(2.0, 3 * off))


def follower_main():
    """A loop that spins once in each turn; complex numbers for the pose."""
    rclpy.init()
    node = Node("follow_path")
    publisher = node.create_publisher(Twist, "cmd_vel", 10)
    frames, stamps, plans = {}, {}, []

    def on_tf(msg):
        for t in msg.transforms:
            stamps[t.child_frame_id] = Time.from_msg(t.header.stamp)
            move, turn = t.transform.translation, t.transform.rotation
            frames[t.child_frame_id] = complex(move.x, move.y), complex(turn.w, turn.z) ** 2

    node.create_subscription(TFMessage, "tf", on_tf, 10)
    node.create_subscription(Path, "plan", plans.append, 10)
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=0.1)
        if not plans or len(frames) < 2:
            continue
        if node.get_clock().now() - min(stamps.values()) > Duration(seconds=0.5):
            publisher.publish(Twist())
            continue
        place = frames["odom"][0] + frames["odom"][1] * frames["base_link"][0]
        heading = frames["odom"][1] * frames["base_link"][1]
        points = [complex(p.pose.position.x, p.pose.position.y) for p in plans[0].poses]
        if abs(points[-1] - place) < 0.07:
            break
        nearest = min(range(len(points)), key=lambda i: abs(points[i] - place))
        target = (points[min(nearest + 3, len(points) - 1)] - place) / heading
        command = Twist()
        command.linear.x = 0.3 if target.real > 2 * abs(target.imag) else 0.02
        command.angular.z = max(-1.5, min(1.5, 6 * target.imag / abs(target)))
        publisher.publish(command)
    publisher.publish(Twist())
    node.destroy_node()
    rclpy.shutdown()


class SlowInCurves(Follower):
    """A controller that receives /odom for its speed, and slows down in curves."""

    def __init__(self):
        super().__init__()
        self.create_subscription(Odometry, "/odom", lambda msg: self.drive(), 10)

    def steer(self, point):
        speed, turn = super().steer(point)
        return speed / (1 + abs(turn)), turn / (1 + abs(turn)) if speed else turn


class DrivesWithAnOldPose(Follower):
    """Takes the newest pose, however old."""

    @property
    def is_lost(self):
        return self.pose is None


class StandsStill(Follower):
    near = 1e9


class Misspelt(Follower):
    topic = "/cmd_val"


class LooksTooFar(Follower):
    """Cuts corners, and walls are there."""

    ahead = 1.2


class LooksAtTheNearest(Follower):
    """The nearest point is where the robot is already."""

    def carrot(self):
        return min(self.path, key=lambda point: math.dist(self.pose[:2], point))


class FirstFarPoint(Follower):
    """The first of all points that is far enough: soon that is the start."""

    def carrot(self):
        far = [point for point in self.path if math.dist(self.pose[:2], point) >= self.ahead]
        return far[0] if far else self.path[-1]


class StraightToTheEnd(Follower):
    def carrot(self):
        return self.path[-1]


class TurnsTheWrongWay(Follower):
    def steer(self, point):
        speed, turn = super().steer(point)
        return speed, -turn


class NeverTurns(Follower):
    def steer(self, point):
        return self.speed, 0.0


class NeverStops(Follower):
    near = -1.0


class StopsHalfAMetreBefore(Follower):
    near = 0.5


class ByOdometryAlone(Follower):
    """Takes where it is since the start for where it is in the map."""

    @property
    def pose(self):
        return self.frames.get("base_link")


class NeedsThePoseAtOnce(Follower):
    """Does not wait for the localization: the pose is None then."""

    def drive(self):
        command = Twist()
        if self.path and math.dist(self.pose[:2], self.path[-1]) > self.near:
            command.linear.x, command.angular.z = self.steer(self.carrot())
        self.publisher.publish(command)


class BearingInDegrees(Follower):
    def steer(self, point):
        x, y, yaw = self.pose
        off = math.degrees(math.remainder(math.atan2(point[1] - y, point[0] - x) - yaw, math.tau))
        return (0.4, off / 10) if abs(off) < 1.0 else (0.0, math.copysign(1.5, off))


class WideCurves(Follower):
    """Never turns on the spot, and too little."""

    def steer(self, point):
        x, y, yaw = self.pose
        off = math.remainder(math.atan2(point[1] - y, point[0] - x) - yaw, math.tau)
        return 0.4, 0.9 * off


class EmptyPath(Follower):
    """Does not wait for a path."""

    def drive(self):
        command = Twist()
        command.linear.x, command.angular.z = self.steer(self.path[0])
        self.publisher.publish(command)


class TurnForSpeed(Follower):
    """Gives the two numbers the wrong way round."""

    def steer(self, point):
        speed, turn = super().steer(point)
        return (turn, speed) if speed else (speed, turn)


class HalfTheCurvature(Follower):
    """Without the 2 it gets along, but swings out of each corner."""

    def steer(self, point):
        speed, turn = super().steer(point)
        return (speed, turn / 2) if speed else (speed, turn)


class ForgetsTheDistance(Follower):
    def steer(self, point):
        speed, turn = super().steer(point)
        return (speed, turn * math.dist(self.pose[:2], point)) if speed else (speed, turn)


class SpeedOnTheSpot(Follower):
    """Gives the two numbers the wrong way round where it should turn on the spot."""

    def steer(self, point):
        speed, turn = super().steer(point)
        return (speed, turn) if speed else (turn, speed)


class PlaceByDistance(Follower):
    def carrot(self):
        distances = [math.dist(self.pose[:2], point) for point in self.path]
        return self.path[min(distances) :][0]


class HardlyTurns(Follower):
    """Takes the curvature for degrees."""

    def steer(self, point):
        speed, turn = super().steer(point)
        return speed or 0.1, math.radians(turn)
