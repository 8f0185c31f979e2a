"""Controls of a delivery robot: right ones, and wrong ones named by their defect."""

import math

import rclpy
from geometry_msgs.msg import PoseArray, PoseStamped, Twist
from nav_msgs.msg import OccupancyGrid
from rclpy.node import Node

from grader.exercises.delivery import LATCHED, Floor, pose_2d, seconds, steer


class Control(Node):
    """As one would write it; the wrong ones change one thing each."""

    people_topic = "/people"

    def __init__(self):
        super().__init__("control")
        self.floor = self.goal = self.pose = None
        self.people, self.obstacles, self.way = [], [], []
        self.pose_at = self.people_at = -math.inf
        self.create_subscription(OccupancyGrid, "/map", self.on_map, LATCHED)
        self.create_subscription(PoseArray, self.people_topic, self.on_people, 10)
        self.create_subscription(PoseArray, "/obstacles", self.on_obstacles, 10)
        self.create_subscription(PoseStamped, "/goal_pose", self.on_goal, 10)
        self.create_subscription(PoseStamped, "/robot_pose", self.on_pose, 10)
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, self.drive)
        self.create_timer(1.0, self.plan)

    def on_map(self, grid):
        self.floor = Floor(grid)

    def on_obstacles(self, obstacles):
        self.obstacles = [pose_2d(pose)[:2] for pose in obstacles.poses]

    def on_goal(self, goal):
        place = pose_2d(goal.pose)[:2]
        if place != self.goal:
            self.goal, self.way = place, []

    def on_people(self, people):
        self.people = [pose_2d(pose)[:2] for pose in people.poses]
        self.people_at = self.when(people)

    def on_pose(self, message):
        self.pose, self.pose_at = pose_2d(message.pose), self.when(message)

    def when(self, message):
        return seconds(message.header.stamp)

    def now(self):
        return self.get_clock().now().nanoseconds / 1e9

    def plan(self):
        if None not in (self.floor, self.goal, self.pose):
            self.way = self.floor.way(self.pose[:2], self.goal, self.obstacles)

    def is_old(self):
        return self.now() - min(self.pose_at, self.people_at) > 0.5

    def limit(self):
        if self.is_old():
            return 0.0
        nearest = min((math.dist(self.pose[:2], place) for place in self.people), default=math.inf)
        return self.allowed(nearest)

    def allowed(self, nearest):
        if nearest < 1.5:
            return 0.0
        return 0.2 if nearest < 2.5 else 0.5

    def drive(self):
        command = Twist()
        limit = self.limit()
        if self.way and limit > 0:
            while len(self.way) > 1 and math.dist(self.pose[:2], self.way[0]) < 0.25:
                self.way.pop(0)
            if math.dist(self.pose[:2], self.goal) > 0.05:
                command.linear.x, command.angular.z = steer(self.pose, self.way[0], limit)
        self.publisher.publish(command)


class Careful(Control):
    """Stands and slows a bit earlier, and is slower."""

    def is_old(self):
        return self.now() - min(self.pose_at, self.people_at) > 0.4

    def allowed(self, nearest):
        if nearest < 1.6:
            return 0.0
        return 0.18 if nearest < 2.6 else 0.48


class Smooth(Control):
    """A design of its own: the nearer, the slower."""

    def allowed(self, nearest):
        return 0.0 if nearest < 1.5 else min(0.5, 0.1 + 0.1 * (nearest - 1.5) / 1.0 + 0.3 * (nearest > 2.5))


def main():
    rclpy.init()
    rclpy.spin(Control())


class NoOneCounts(Control):
    """Looks at ages only."""

    def allowed(self, nearest):
        return 0.5


class NeverSlow(Control):
    """As in the lesson: one limit."""

    def allowed(self, nearest):
        return 0.0 if nearest < 1.5 else 0.5


class SlowIsEnough(Control):
    """Creeps past people."""

    def allowed(self, nearest):
        return 0.2 if nearest < 2.5 else 0.5


class AnyAgeWillDo(Control):
    """Believes the last news forever."""

    def is_old(self):
        return self.pose is None


class TwoSeconds(Control):
    """Another limit for ages."""

    def is_old(self):
        return self.now() - min(self.pose_at, self.people_at) > 2.0


class HasNoPatience(Control):
    """Enough where news come every 0.1 s and take no time: but over a network they do."""

    def is_old(self):
        return self.now() - min(self.pose_at, self.people_at) > 0.15


class WhenItCame(Control):
    """Takes the time at which news came for the time at which it was seen."""

    def when(self, message):
        return self.now()


class WhenPeopleCame(Control):
    """By their arrival, and only the pose by its stamp."""

    def on_people(self, people):
        super().on_people(people)
        self.people_at = self.now()


class SaysNothing(Control):
    """Publishes no stop: the motor driver will do it."""

    def drive(self):
        if self.limit() > 0:
            super().drive()


class NeverGoesOn(Control):
    """What has stopped stays stopped."""

    stopped = False

    def limit(self):
        limit = super().limit()
        self.stopped = self.stopped or (limit == 0 and self.pose is not None and self.now() % 1000 > 5)
        return 0.0 if self.stopped else limit


class RestsWhereItStopped(NeverGoesOn):
    """The same, once it has been at the first place."""

    places = 0

    def on_goal(self, goal):
        before = self.goal
        super().on_goal(goal)
        self.places += self.goal != before
        self.stopped = self.stopped and self.places > 1


class Creeps(Control):
    """So slow that no fault meets it."""

    def allowed(self, nearest):
        return min(0.18, super().allowed(nearest))


class DeafToPeople(Control):
    """Receives of people on a topic of its own."""

    people_topic = "/who_walks"
