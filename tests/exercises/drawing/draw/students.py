"""Arms that draw: right ones, and wrong ones named by their defect."""

import cmath
import itertools
import math
from xml.etree import ElementTree

import numpy as np
import rclpy
from control_msgs.action import FollowJointTrajectory
from geometry_msgs.msg import Point32, Polygon
from rclpy.action import ActionClient
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

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


class OneGoalPerPoint(Artist):
    """Knows nothing of trajectories: each goal is one place, and the result of one sends the next."""

    def draw(self, figure):
        if self.upper is None:
            super().draw(figure)
            return
        self.left = list(figure.points)
        self.next(2.5)

    def next(self, seconds):
        goal = FollowJointTrajectory.Goal()
        goal.trajectory.joint_names = list(self.names)
        place = self.left.pop(0)
        point = JointTrajectoryPoint(positions=list(self.inverse(place.x, place.y)))
        point.time_from_start = Duration(seconds=seconds).to_msg()
        goal.trajectory.points.append(point)
        self.client.wait_for_server()
        self.client.send_goal_async(goal).add_done_callback(self.on_response)

    def on_response(self, future):
        future.result().get_result_async().add_done_callback(self.on_result)

    def on_result(self, future):
        if self.left:
            self.next(0.1)


class InACoroutine(Artist):
    """Reads from top to bottom: description, figure, there, draw; the elbow's place by complex numbers."""

    def __init__(self):
        Node.__init__(self, "artist")
        group = ReentrantCallbackGroup()
        self.figure = self.upper = None
        self.client = ActionClient(self, FollowJointTrajectory, ACTION, callback_group=group)
        self.create_subscription(String, "/robot_description", self.read, LATCHED)
        self.create_subscription(Polygon, "/figure", lambda msg: setattr(self, "figure", msg.points), LATCHED)
        self.timer = self.create_timer(0.1, self.work, callback_group=group)

    async def work(self):
        if self.figure is None or self.upper is None or not self.client.server_is_ready():
            return
        self.timer.cancel()
        for places, begin, step in (self.figure[:1], 2.5, 0.0), (self.figure[1:], 0.2, 0.15):
            points = [
                JointTrajectoryPoint(positions=self.inverse(place.x, place.y),
                                     time_from_start=Duration(seconds=begin + step * index).to_msg())
                for index, place in enumerate(places)
            ]  # fmt: skip
            goal = FollowJointTrajectory.Goal(
                trajectory=JointTrajectory(joint_names=self.names, points=points)
            )
            handle = await self.client.send_goal_async(goal)
            await handle.get_result_async()

    def inverse(self, x, y):
        goal = complex(x, y)
        along = (abs(goal) ** 2 + self.upper**2 - self.fore**2) / (2 * abs(goal))
        beside = math.copysign(math.sqrt(self.upper**2 - along**2), y)
        elbow = goal / abs(goal) * complex(along, beside)
        return [cmath.phase(elbow), cmath.phase((goal - elbow) / elbow)]


class SearchesATable(Artist):
    """A table of places for all angles, and a finer one around the best: no formula but the arm's own."""

    def inverse(self, x, y):
        side = -1.0 if y > 0 else 1.0
        middle, width = (math.atan2(y, x) - side, 1.5 * side), 1.6
        for _ in range(9):
            shoulders, elbows = (np.linspace(each - width, each + width, 25) for each in middle)
            elbows = np.clip(elbows, 0.05, 3.0) if side > 0 else np.clip(elbows, -3.0, -0.05)
            first, second = np.meshgrid(shoulders, elbows, indexing="ij")
            off = np.hypot(
                self.upper * np.cos(first) + self.fore * np.cos(first + second) - x,
                self.upper * np.sin(first) + self.fore * np.sin(first + second) - y,
            )
            row, column = np.unravel_index(off.argmin(), off.shape)
            middle, width = (shoulders[row], elbows[column]), width / 5
        return float(middle[0]), float(middle[1])


class SmoothAndTimed(Artist):
    """Five times as many points as the figure has, with velocities; each takes as long as its joints need."""

    def draw(self, figure):
        if self.upper is None:
            super().draw(figure)
            return
        dense = []
        for a, b in itertools.pairwise(figure.points):
            dense += [(a.x + (b.x - a.x) * k / 5, a.y + (b.y - a.y) * k / 5) for k in range(5)]
        dense.append((figure.points[-1].x, figure.points[-1].y))
        angles = np.unwrap([self.inverse(x, y) for x, y in dense], axis=0)
        steps = np.abs(np.diff(angles, axis=0)).max(axis=1) / 0.9 + 0.02
        times = np.concatenate([[3.0], 3.0 + np.cumsum(steps)])
        rates = np.gradient(angles, times, axis=0)
        rates[-1] = 0.0
        goal = FollowJointTrajectory.Goal()
        goal.trajectory.joint_names = list(self.names)
        goal.trajectory.points = [
            JointTrajectoryPoint(positions=row.tolist(), velocities=rate.tolist(),
                                 time_from_start=Duration(seconds=float(time)).to_msg())
            for row, rate, time in zip(angles, rates, times, strict=True)
        ]  # fmt: skip
        self.client.wait_for_server()
        self.client.send_goal_async(goal)


def main():
    """No class: waits for both messages, then for the results."""
    rclpy.init()
    node, box = rclpy.create_node("artist"), {}
    node.create_subscription(String, "robot_description", lambda msg: box.update(robot=msg.data), LATCHED)
    node.create_subscription(Polygon, "figure", lambda msg: box.update(figure=msg.points), LATCHED)
    while len(box) < 2:
        rclpy.spin_once(node)
    joints = {joint.get("name"): joint for joint in ElementTree.fromstring(box["robot"]).iter("joint")}
    l1, l2 = (
        math.hypot(*map(float, joints[name].find("origin").get("xyz").split()[:2]))
        for name in ("elbow_joint", "tip_joint")
    )
    trajectory = JointTrajectory(joint_names=["elbow_joint", "shoulder_joint"])  # the order is free
    for number, p in enumerate(box["figure"]):
        q2 = -math.copysign(math.acos((p.x**2 + p.y**2 - l1**2 - l2**2) / 2 / l1 / l2), p.y)
        q1 = math.atan2(p.y, p.x) - math.atan2(l2 * math.sin(q2), l1 + l2 * math.cos(q2))
        stamp = Duration(seconds=4.0 + 0.2 * number).to_msg()
        trajectory.points.append(JointTrajectoryPoint(positions=[q2, q1], time_from_start=stamp))
    client = ActionClient(node, FollowJointTrajectory, ACTION)
    client.wait_for_server()
    sent = client.send_goal_async(FollowJointTrajectory.Goal(trajectory=trajectory))
    rclpy.spin_until_future_complete(node, sent)
    rclpy.spin_until_future_complete(node, sent.result().get_result_async())
    node.destroy_node()
    rclpy.shutdown()


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


class EveryEighthPoint(Artist):
    """Cuts the curves."""

    def places(self, figure):
        return figure.points[::8]


class NeverSends(Artist):
    def draw(self, figure):
        pass


class OtherNames(Artist):
    names = ("shoulder", "elbow")


class OneGoalPerPointAtOnce(OneGoalPerPoint):
    """Doesn't wait for results: each goal takes the place of the one before."""

    def next(self, seconds):
        super().next(seconds)
        if self.left:
            self.next(0.2)

    def on_response(self, future):
        pass


class HalfByGoals(OneGoalPerPoint):
    def draw(self, figure):
        figure.points = figure.points[: len(figure.points) // 2]
        super().draw(figure)


class HurriesByGoals(OneGoalPerPoint):
    """A goal for each point, and no time for any: 0.02 s, while the arm runs after them."""

    def on_result(self, future):
        if self.left:
            self.next(0.02)


class SendsNoNames(Artist):
    names = ()


class LiftsToTheMiddle(Artist):
    """Goes to the figure's middle between any two points."""

    def places(self, figure):
        x = sum(place.x for place in figure.points) / len(figure.points)
        y = sum(place.y for place in figure.points) / len(figure.points)
        return [each for place in figure.points for each in (place, Point32(x=x, y=y))]
