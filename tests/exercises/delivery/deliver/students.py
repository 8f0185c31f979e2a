"""Delivery robots: right ones in three styles, and wrong ones named by their defect."""

import math

import rclpy
from geometry_msgs.msg import PoseArray, PoseStamped, Twist
from nav_msgs.msg import Path
from rclpy.executors import SingleThreadedExecutor
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
    *("one_process", "Careless", "Gate", "ByUtility", "Planner", "PathDriver", "OnEachMessage", "Localizer"),
    *("Watcher", "Smoother", "Gentle", "Everlasting", "Hasty"),
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


def one_process():
    """All three nodes in one program, which is killed and comes back as one."""
    rclpy.init()
    executor = SingleThreadedExecutor()
    for node in (Perception(), Decision(), Control()):
        executor.add_node(node)
    executor.spin()


OneProcess = Team(one_process)


class Careless(Control):
    """Leaves people to the gate."""

    away = 0.0

    def create_publisher(self, kind, topic, depth):
        return super().create_publisher(kind, f"{topic}_raw" if topic == "/cmd_vel" else topic, depth)


class Gate(Node):
    """Between control and the motors: lets a command pass while all it knows is new, and no one is near."""

    def __init__(self):
        super().__init__("gate")
        self.command, self.place, self.people, self.seen = Twist(), None, [], [-math.inf] * 3
        self.create_subscription(Twist, "/cmd_vel_raw", self.on_command, 10)
        self.create_subscription(PoseStamped, "/robot_pose", self.on_pose, 10)
        self.create_subscription(PoseArray, "/people", self.on_people, 10)
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.05, self.tick)

    def now(self):
        return self.get_clock().now().nanoseconds

    def on_command(self, command):
        self.command, self.seen[0] = command, self.now()

    def on_pose(self, pose):
        self.place = pose.pose.position.x, pose.pose.position.y
        self.seen[1] = Time.from_msg(pose.header.stamp).nanoseconds

    def on_people(self, people):
        self.people = [(pose.position.x, pose.position.y) for pose in people.poses]
        self.seen[2] = Time.from_msg(people.header.stamp).nanoseconds

    def tick(self):
        is_new = self.now() - min(self.seen) < 0.5e9
        is_free = is_new and all(math.dist(self.place, person) > 1.5 for person in self.people)
        self.publisher.publish(self.command if is_free else Twist())


WithAGate = Team(Perception, Decision, Careless, Gate)  # a design of its own


class ByUtility(Decision):
    """Each thing that it could do has a number; it does what has the largest one."""

    def choose(self):
        charging, empty = self.state == "charge", self.low - self.share
        offers = [(0.0, "rest", self.dock)]
        offers.append((5.0 if charging and self.share < self.enough else 60.0 * empty, "charge", self.dock))
        for order in self.orders.values():
            if order.status == Order.PICKED_UP:
                offers.append((9.0, f"deliver {order.id}", order.delivery))
            elif self.is_worth_it(order):
                offers.append((3.0 / (1.0 + self.way(order.pickup)), f"fetch {order.id}", order.pickup))
        return max(offers, key=lambda offer: offer[0])[1:]


ChoosesByUtility = Team(Perception, ByUtility, Control)


class Planner(Control):
    """Plans once a second, from wherever the robot is, and drives nothing."""

    def __init__(self):
        super().__init__()
        self.destroy_publisher(self.publisher)
        self.publisher, self.place = self.create_publisher(Path, "/path", 10), None

    def stand(self):
        pass

    def on_pose(self, message):
        self.place = message.pose.position.x, message.pose.position.y

    def look_again(self):
        if self.place is not None and self.goal is not None and self.solid is not None:
            way = self.plan(self.place)
            poses = [PoseStamped() for _ in way]
            for pose, (x, y) in zip(poses, way, strict=True):
                pose.pose.position.x, pose.pose.position.y = x, y
            self.publisher.publish(Path(poses=poses))


class PathDriver(Control):
    """Follows the newest path from its nearest point on, and needs no map."""

    def __init__(self):
        super().__init__()
        self.solid, self.place = True, None
        self.create_subscription(Path, "/path", self.on_path, 10)

    def on_map(self, grid):
        pass

    def look_again(self):
        pass

    def plan(self, start):
        return []

    def on_pose(self, message):
        self.place = message.pose.position.x, message.pose.position.y
        super().on_pose(message)

    def on_path(self, path):
        way = [(each.pose.position.x, each.pose.position.y) for each in path.poses]
        if way and self.place is not None:
            nearest = min(range(len(way)), key=lambda index: math.dist(way[index], self.place))
            self.way = way[nearest:]
        else:
            self.way = way


APlannerOfItsOwn = Team(Perception, Decision, Planner, PathDriver)


class OnEachMessage(Decision):
    """No timer decides, but each message that may change something."""

    def decide(self):
        if self.get_clock().now().nanoseconds - getattr(self, "decided", 0) > 0.2e9:
            self.decided = self.get_clock().now().nanoseconds
            super().decide()

    def on_order(self, order):
        super().on_order(order)
        self.decide()

    def on_battery(self, battery):
        super().on_battery(battery)
        self.decide()

    def on_pose(self, pose):
        super().on_pose(pose)
        self.decide()


EventDriven = Team(Perception, OnEachMessage, Control)


class Localizer(Perception):
    """Where it is, from odometry alone, as often as that comes."""

    def on_scan(self, scan):
        pass

    def on_odom(self, odom):
        super().on_odom(odom)
        self.scans += 1
        if self.map_to_odom is not None and self.scans % 2:
            x, y, yaw = self.locate()
            message = PoseStamped()
            message.header.stamp, message.header.frame_id = odom.header.stamp, "map"
            message.pose.position.x, message.pose.position.y = x, y
            message.pose.orientation.z, message.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
            self.pose_pub.publish(message)


class Watcher(Perception):
    """What is near: people and obstacles; where the robot is, others say."""

    def create_publisher(self, kind, topic, depth):
        return super().create_publisher(kind, "/watcher/pose" if topic == "/robot_pose" else topic, depth)


TwoPerceptions = Team(Localizer, Watcher, Decision, Control)


class Smoother(Gate):
    """A gate that speeds up gently, and stops at once."""

    speed = 0.0

    def tick(self):
        wanted = self.command.linear.x if self.now() - self.seen[0] < 0.3e9 else 0.0
        self.speed = min(wanted, self.speed + 0.02)
        command = Twist()
        command.linear.x, command.angular.z = self.speed, self.command.angular.z if wanted else 0.0
        if not wanted and self.now() - self.seen[0] < 0.3e9:
            command.angular.z = self.command.angular.z
        self.publisher.publish(command)


class Gentle(Careless):
    away = Control.away


SpeedsUpGently = Team(Perception, Decision, Gentle, Smoother)


class Everlasting(Gate):
    """A gate that never forgets a command: it repeats the last one while no news comes."""

    def tick(self):
        is_free = self.place is None or all(math.dist(self.place, person) > 1.5 for person in self.people)
        self.publisher.publish(self.command if is_free else Twist())


class Hasty(Careless):
    """Says nothing while its news is old."""

    def on_pose(self, message):
        if Time.from_msg(message.header.stamp).nanoseconds - self.received < 0.5e9:
            super().on_pose(message)

    def stand(self):
        pass


AGateThatForgetsNothing = Team(Perception, Decision, Hasty, Everlasting)


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
