"""Arms that draw: right ones, and wrong ones named by their defect."""

import itertools
import math
from xml.etree import ElementTree

from control_msgs.action import FollowJointTrajectory
from geometry_msgs.msg import Polygon
from rclpy.action import ActionClient
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
from trajectory_msgs.msg import JointTrajectoryPoint

ACTION = "/arm_controller/follow_joint_trajectory"
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Artist(Node):
    """As one would write it; the wrong ones change one thing each."""

    names = ("shoulder_joint", "elbow_joint")

    def __init__(self):
        super().__init__("artist")
        self.upper = self.fore = None
        self.client = ActionClient(self, FollowJointTrajectory, ACTION)
        self.create_subscription(String, "/robot_description", self.read, LATCHED)
        self.create_subscription(Polygon, "/figure", self.draw, LATCHED)

    def read(self, msg):
        robot = ElementTree.fromstring(msg.data)
        self.upper, self.fore = (
            float(robot.find(f"joint[@name='{name}']/origin").get("xyz").split()[0])
            for name in ("elbow_joint", "tip_joint")
        )

    def draw(self, figure):
        if self.upper is None:  # the description comes a moment later
            self.later = self.create_timer(0.1, lambda: (self.later.cancel(), self.draw(figure)))
            return
        goal = FollowJointTrajectory.Goal()
        goal.trajectory.joint_names = list(self.names)
        for index, place in enumerate(self.places(figure)):
            angles = self.inverse(place.x, place.y)
            time = Duration(seconds=self.time(index)).to_msg()
            goal.trajectory.points.append(JointTrajectoryPoint(positions=list(angles), time_from_start=time))
        self.client.wait_for_server()
        self.client.send_goal_async(goal)

    def places(self, figure):
        return figure.points

    def time(self, index):
        return 3.0 + 0.15 * index

    def inverse(self, x, y):
        elbow = self.side(y) * math.acos(self.cosine(x, y))
        inside = math.atan2(self.fore * math.sin(elbow), self.upper + self.fore * math.cos(elbow))
        return self.direction(x, y) - inside, elbow

    def cosine(self, x, y):
        return (x * x + y * y - self.upper**2 - self.fore**2) / (2 * self.upper * self.fore)

    def direction(self, x, y):
        return math.atan2(y, x)

    def side(self, y):
        return -1.0 if y > 0 else 1.0


class ByTheCosineLaw(Artist):
    """A design of its own: the shoulder's angle by the law of cosines, too."""

    def inverse(self, x, y):
        far = math.hypot(x, y)
        alpha = math.acos((far**2 + self.upper**2 - self.fore**2) / (2 * far * self.upper))
        beta = math.acos((self.upper**2 + self.fore**2 - far**2) / (2 * self.upper * self.fore))
        up = math.copysign(1.0, y)
        return math.atan2(y, x) + up * alpha, -up * (math.pi - beta)


class TriesBoth(Artist):
    """Both ways, and takes the one whose elbow bends away from the figure's side."""

    def inverse(self, x, y):
        ways = []
        for self.sign in (1.0, -1.0):
            ways.append(super().inverse(x, y))
        return min(ways, key=lambda way: way[1] * y)

    def side(self, y):
        return self.sign


class CorrectsStepByStep(Artist):
    """No formula for the angles: each correction brings the tip nearer, beginning at the last place."""

    last = None

    def inverse(self, x, y):
        shoulder, elbow = self.last or (math.atan2(y, x) - self.side(y), 2.0 * self.side(y))
        for _ in range(50):
            inner, outer = self.upper * math.sin(shoulder), self.fore * math.sin(shoulder + elbow)
            bottom, top = self.upper * math.cos(shoulder), self.fore * math.cos(shoulder + elbow)
            right, up = x - bottom - top, y - inner - outer
            size = self.upper * self.fore * math.sin(elbow)
            shoulder += (top * right + outer * up) / size
            elbow -= ((bottom + top) * right + (inner + outer) * up) / size
        self.last = shoulder, elbow
        return self.last


class TipAtOneSpeed(Artist):
    """The times come from the lengths of the lines: the tip moves at the same speed everywhere."""

    def places(self, figure):
        steps = [math.dist((a.x, a.y), (b.x, b.y)) for a, b in itertools.pairwise(figure.points)]
        self.done = [0.0, *itertools.accumulate(steps)]
        return figure.points

    def time(self, index):
        return 3.0 + 10.0 * self.done[index] / self.done[-1]


class GoesThereFirst(Artist):
    """Two goals: one to the first point, and when that has succeeded, the figure."""

    def draw(self, figure):
        if self.upper is None:
            super().draw(figure)
            return
        self.figure = figure
        self.send([(figure.points[0], 2.5)]).add_done_callback(self.on_response)

    def on_response(self, future):
        future.result().get_result_async().add_done_callback(self.on_result)

    def on_result(self, future):
        self.send([(place, 0.1 + 0.15 * index) for index, place in enumerate(self.figure.points)])

    def send(self, rows):
        goal = FollowJointTrajectory.Goal()
        goal.trajectory.joint_names = list(self.names)
        for place, seconds in rows:
            point = JointTrajectoryPoint(positions=list(self.inverse(place.x, place.y)))
            point.time_from_start = Duration(seconds=seconds).to_msg()
            goal.trajectory.points.append(point)
        self.client.wait_for_server()
        return self.client.send_goal_async(goal)


class ElbowMirrored(Artist):
    def side(self, y):
        return 1.0 if y > 0 else -1.0


class ElbowAlwaysNegative(Artist):
    """Right for figures to the left, and into the table for those to the right."""

    def side(self, y):
        return -1.0


class AtanInsteadOfAtan2(Artist):
    def direction(self, x, y):
        return math.atan(x / y)


class AtanOfTheQuotient(Artist):
    """Right where x > 0; behind the shoulder it is half a turn off."""

    def direction(self, x, y):
        return math.atan(y / x)


class Degrees(Artist):
    def inverse(self, x, y):
        return tuple(math.degrees(angle) for angle in super().inverse(x, y))


class ForgetsTheBend(Artist):
    def inverse(self, x, y):
        return math.atan2(y, x), super().inverse(x, y)[1]


class LengthsByHeart(Artist):
    """Those of the lesson's arm."""

    def read(self, msg):
        self.upper, self.fore = 0.5, 0.4


class JointsSwapped(Artist):
    names = ("elbow_joint", "shoulder_joint")


class MirroredAtTheAxis(Artist):
    def inverse(self, x, y):
        return super().inverse(x, -y)


class WithoutASquare(Artist):
    """acos of too much: ValueError."""

    def cosine(self, x, y):
        return (x * x + y * y + self.upper**2 + self.fore**2) / (2 * self.upper * self.fore)


class TimesDoNotRise(Artist):
    def time(self, index):
        return 3.0


class FirstPointAtZero(Artist):
    """No time to get to the first point: the arm runs after it, and cuts the corners."""

    def time(self, index):
        return 0.02 * index


class JumpsToTheFirstPoint(Artist):
    """The first point at once, the others as they should be."""

    def time(self, index):
        return super().time(index) if index else 0.0


class HalfOfIt(Artist):
    def places(self, figure):
        return figure.points[: len(figure.points) // 2]


class EveryEighthPoint(Artist):
    """Cuts the curves."""

    def places(self, figure):
        return figure.points[::8]


class NeverSends(Artist):
    def draw(self, figure):
        pass


class StaysWhereItIs(Artist):
    """Who doesn't move touches no table."""

    def places(self, figure):
        return figure.points[:2]

    def inverse(self, x, y):
        return 0.0, 0.0


class OtherNames(Artist):
    names = ("shoulder", "elbow")
