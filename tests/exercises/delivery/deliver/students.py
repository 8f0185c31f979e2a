"""Delivery robots: right ones in three styles, and wrong ones named by their defect."""

import math

from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.time import Time
from sensor_msgs.msg import BatteryState
from std_msgs.msg import Bool
from warehouse_msgs.msg import Order

from tests.bench.delivery.control import Control
from tests.bench.delivery.decision import Decision
from tests.bench.delivery.perception import Perception
from tests.students.teams import Team

PARTS = (
    *("sequence", "first_of", "Tree", "Charger", "Clerk", "Chaser", "Repeating", "Sulking", "Restless"),
    *("Unsocial", "Close", "Forgetful", "ByTheMap", "Patient", "Faithful", "Tight", "Quiet"),
)

StateMachine = Team(Perception, Decision, Control)


def sequence(*steps):
    """Every step has to hold; the last one says where to go."""

    def tick(robot):
        found = None
        for step in steps:
            found = step(robot)
            if not found:
                return None
        return found

    return tick


def first_of(*branches):
    """The first branch that says where to go."""
    return lambda robot: next((found for branch in branches if (found := branch(robot))), None)


class Tree(Decision):
    """Rules as a behavior tree: each leaf is a question or a place."""

    def __init__(self):
        super().__init__()
        self.charging = False
        carry = sequence(self.load, lambda robot: ("deliver", robot.load().delivery))
        charge = sequence(Tree.tired, lambda robot: ("charge", robot.dock))
        fetch = sequence(self.best, lambda robot: ("fetch", robot.best().pickup))
        self.tree = first_of(carry, charge, fetch, lambda robot: ("rest", robot.dock))

    def load(self, robot=None):
        return next((order for order in self.orders.values() if order.status == Order.PICKED_UP), None)

    def tired(self):
        self.charging = self.share < (self.enough if self.charging else self.low)
        return self.charging

    def best(self, robot=None):
        waiting = [order for order in self.orders.values() if self.is_worth_it(order)]
        return min(waiting, key=lambda order: (self.way(order.pickup), order.id), default=None)

    def choose(self):
        return self.tree(self)


BehaviorTree = Team(Perception, Tree, Control)  # a design of its own


class Charger(Node):
    """One skill: says on /tired when the battery needs the charger."""

    def __init__(self):
        super().__init__("charger")
        self.tired = False
        self.publisher = self.create_publisher(Bool, "/tired", 10)
        self.create_subscription(BatteryState, "/battery_state", self.on_battery, 10)

    def on_battery(self, battery):
        self.tired = battery.percentage < (0.9 if self.tired else 0.35)
        self.publisher.publish(Bool(data=self.tired))


class Clerk(Decision):
    """The other skill: which order. It learns of the battery from the charger alone."""

    def __init__(self):
        super().__init__()
        self.create_subscription(Bool, "/tired", self.on_tired, 10)

    def on_battery(self, battery):
        pass

    def on_tired(self, tired):
        self.share = 0.0 if tired.data else 1.0


OneNodePerSkill = Team(Control, Charger, Clerk, Perception)


class Chaser(Control):
    """A person nearby is where it wants to go."""

    def on_goal(self, goal):
        pass

    def on_obstacles(self, obstacles):
        pass

    def on_people(self, people):
        super().on_people(people)
        places, self.people = self.people, []
        if places and (self.goal is None or math.dist(self.goal, places[0]) > 0.5):
            self.goal, self.way = places[0], []


TakesPeopleForGoals = Team(Perception, Decision, Chaser)


class Unsocial(Perception):
    """What walks is an obstacle as any other."""

    def tell(self, publisher, stamp, points):
        super().tell(publisher, stamp, [] if publisher is self.people_pub else points)


ForgetsWhoWalks = Team(Unsocial, Decision, Control)


class Close(Control):
    """Keeps away from people, but not far enough."""

    away = 0.7


PassesTooClose = Team(Perception, Decision, Close)


class Repeating(Control):
    """A timer repeats the last command forever, however old it is."""

    def __init__(self):
        super().__init__()
        self.last, self.out = Twist(), self.publisher
        self.publisher = self
        self.create_timer(0.1, lambda: self.out.publish(self.last))

    def publish(self, command):
        self.last = command

    def stand(self):
        pass


DrivesBlind = Team(Perception, Decision, Repeating)


class Sulking(Control):
    """Stands forever when it was without news once."""

    def on_pose(self, message):
        stamp = Time.from_msg(message.header.stamp).nanoseconds
        self.sulks = getattr(self, "sulks", False) or stamp - getattr(self, "before", stamp) > 1e9
        self.before = stamp
        if self.sulks:
            self.publisher.publish(Twist())
        else:
            super().on_pose(message)


NeverGoesOn = Team(Perception, Decision, Sulking)


class Restless(Decision):
    low = -1.0


NeverCharges = Team(Perception, Restless, Control)


class Forgetful(Decision):
    """Receives orders that come while it is there, and no other."""

    def create_subscription(self, kind, topic, callback, profile, **rest):
        return super().create_subscription(kind, topic, callback, 10 if kind is Order else profile, **rest)


LosesOrders = Team(Perception, Forgetful, Control)


class ByTheMap(Control):
    def on_obstacles(self, obstacles):
        pass


NeverReplans = Team(Perception, Decision, ByTheMap)


class Patient(ByTheMap):
    """Waits until what is in its way has gone."""

    def on_obstacles(self, obstacles):
        self.ahead = [(pose.position.x, pose.position.y) for pose in obstacles.poses]

    def follow(self, x, y, yaw):
        speed, turn = super().follow(x, y, yaw)
        offs = [(px - x, py - y) for px, py in getattr(self, "ahead", [])]
        near = [math.atan2(dy, dx) for dx, dy in offs if math.hypot(dx, dy) < 0.6]
        return 0.0 if any(abs(math.remainder(way - yaw, math.tau)) < 0.7 for way in near) else speed, turn


WaitsForTheBox = Team(Perception, Decision, Patient)


class Faithful(Decision):
    """Keeps to the order that it has begun with, until it is delivered."""

    begun = None

    def choose(self):
        mine = self.orders.get(self.begun)
        if mine is not None and mine.status == Order.CANCELED:
            return f"fetch {mine.id}", mine.pickup
        state, goal = super().choose()
        if state.startswith("fetch"):
            self.begun = int(state.split()[1])
        return state, goal


KeepsToACanceledOrder = Team(Perception, Faithful, Control)


class Tight(Control):
    clear = 0.1


ScrapesShelves = Team(Perception, Decision, Tight)


class Quiet(Control):
    """Publishes nothing while its news is old."""

    def on_pose(self, message):
        if Time.from_msg(message.header.stamp).nanoseconds - self.received < 0.5e9:
            super().on_pose(message)

    def stand(self):
        pass


SilentWhileBlind = Team(Perception, Decision, Quiet)
OnlyControl = Team(Control)
OnlyPerception = Team(Perception)
