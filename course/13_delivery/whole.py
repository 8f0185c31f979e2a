"""The three programs of the delivery robot, as the lesson builds them, with a main for a launch file."""

import argparse
import math
import signal
import time

import rclpy
from floor import (
    LATCHED,
    Floor,
    away_from,
    points_of,
    pose_2d,
    pose_array,
    pose_stamped,
    seconds,
    steer,
)
from geometry_msgs.msg import PoseArray, PoseStamped, Twist
from nav_msgs.msg import OccupancyGrid
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.signals import SignalHandlerOptions
from sensor_msgs.msg import BatteryState, LaserScan
from std_msgs.msg import String
from tf2_ros import Buffer, TransformException, TransformListener
from warehouse_msgs.msg import Order


class Perception(Node):
    """Publishes the robot's pose, the obstacles, and the points where people are walking or just walked."""

    def __init__(self):
        super().__init__("perception")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.floor, self.seen, self.walked, self.scans = None, [], [], 0
        self.create_subscription(OccupancyGrid, "/map", self.on_map, LATCHED)
        self.create_subscription(LaserScan, "scan", self.on_scan, qos_profile_sensor_data)
        self.pose_pub = self.create_publisher(PoseStamped, "robot_pose", 10)
        self.people_pub = self.create_publisher(PoseArray, "people", 10)
        self.obstacles_pub = self.create_publisher(PoseArray, "obstacles", 10)

    def on_map(self, grid):
        """Store the map."""
        self.floor = Floor(grid)

    def on_scan(self, scan):
        """For every other scan, locate the robot and find the points that aren't on the map."""
        self.scans += 1
        if self.floor is None or self.scans % 2:
            return
        try:
            there = self.buffer.lookup_transform("map", scan.header.frame_id, scan.header.stamp).transform
        except TransformException:
            return  # not known yet; the next scan arrives soon
        pose = there.translation.x, there.translation.y, 2 * math.atan2(there.rotation.z, there.rotation.w)
        strange = self.floor.strange(points_of(scan, pose))
        self.tell(scan.header.stamp, pose, strange)

    def tell(self, stamp, pose, strange):
        """Publish the points and the pose, with the time of the scan."""
        now = seconds(stamp)
        before = [points for when, points in self.seen if now - when > 0.4]
        self.seen = [*((when, points) for when, points in self.seen if now - when < 1.0), (now, strange)]
        moved = away_from(strange, before[0] if before else [], 0.25)
        later = [(when, point) for when, point in self.walked if now - when < 5.0]
        self.walked = [(when, point) for when, point in later if away_from([point], moved, 0.2)]
        self.walked += [(now, point) for point in moved]
        self.obstacles_pub.publish(pose_array(stamp, strange))
        self.people_pub.publish(pose_array(stamp, [point for _, point in self.walked]))
        self.pose_pub.publish(pose_stamped(stamp, *pose))


def choose(state, share, orders, now):
    """Return the next state ("deliver", "charge", "fetch" or "rest") and its order, or None."""
    for order in orders:
        if order.status == Order.PICKED_UP:
            return "deliver", order
    if share < 0.35 or (state == "charge" and share < 0.9):
        return "charge", None
    waiting = [order for order in orders if order.status == Order.WAITING]
    in_time = [order for order in waiting if seconds(order.deadline) - now > 40.0]
    if in_time:
        return "fetch", min(in_time, key=lambda order: (seconds(order.deadline), order.id))
    return "rest", None


class Decision(Node):
    """Chooses the next state twice a second and publishes its place on /goal_pose."""

    def __init__(self):
        super().__init__("decision")
        self.orders, self.share, self.dock, self.state = {}, 1.0, None, "rest"
        self.create_subscription(Order, "/orders", self.on_order, LATCHED)
        self.create_subscription(BatteryState, "battery_state", self.on_battery, 10)
        self.create_subscription(PoseStamped, "dock_pose", self.on_dock, LATCHED)
        self.goal_pub = self.create_publisher(PoseStamped, "goal_pose", 10)
        self.state_pub = self.create_publisher(String, "state", 10)
        self.create_timer(0.5, self.decide)

    def on_order(self, order):
        """Store a new order, or its new status."""
        self.orders[order.id] = order

    def on_battery(self, battery):
        """Store the battery's level, from 0 to 1."""
        self.share = battery.percentage

    def on_dock(self, dock):
        """Store the pose of the charger."""
        self.dock = dock

    def decide(self):
        """Choose the next state; publish it and its goal."""
        if self.dock is None:
            return
        now = seconds(self.get_clock().now().to_msg())
        before = self.state
        self.state, order = choose(before, self.share, self.orders.values(), now)
        if self.state != before:
            self.get_logger().info(f"{before} -> {self.state}")
        places = {"fetch": order and order.pickup, "deliver": order and order.delivery}
        self.goal_pub.publish(places.get(self.state, self.dock))
        self.state_pub.publish(String(data=self.state))


class Control(Node):
    """Drives to /goal_pose; stops while a person is walking nearby or its data are too old."""

    def __init__(self):
        super().__init__("control")
        self.floor = self.goal = self.pose = None
        self.people, self.obstacles, self.received, self.way = [], [], -math.inf, []
        self.create_subscription(OccupancyGrid, "/map", self.on_map, LATCHED)
        self.create_subscription(PoseArray, "people", self.on_people, 10)
        self.create_subscription(PoseArray, "obstacles", self.on_obstacles, 10)
        self.create_subscription(PoseStamped, "goal_pose", self.on_goal, 10)
        self.create_subscription(PoseStamped, "robot_pose", self.on_pose, 10)
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_timer(0.1, self.drive)
        self.create_timer(1.0, self.plan)

    def on_map(self, grid):
        """Store the map."""
        self.floor = Floor(grid)

    def on_people(self, people):
        """Store the points where people are walking."""
        self.people = [pose_2d(pose)[:2] for pose in people.poses]

    def on_obstacles(self, obstacles):
        """Store the obstacles that aren't on the map."""
        self.obstacles = [pose_2d(pose)[:2] for pose in obstacles.poses]

    def on_goal(self, goal):
        """Store the goal; a new one needs a new plan."""
        place = pose_2d(goal.pose)[:2]
        if place != self.goal:
            self.goal, self.way = place, []

    def on_pose(self, message):
        """Store the robot's pose and the time of its scan."""
        self.pose, self.received = pose_2d(message.pose), seconds(message.header.stamp)

    def plan(self):
        """Find a new path around the current obstacles, once a second."""
        if None not in (self.floor, self.goal, self.pose):
            self.way = self.floor.way(self.pose[:2], self.goal, self.obstacles)

    def is_safe(self):
        """Return whether the data are recent and no person is nearby."""
        age = seconds(self.get_clock().now().to_msg()) - self.received
        return age < 0.5 and all(math.dist(self.pose[:2], place) > 1.5 for place in self.people)

    def drive(self):
        """Drive a bit further along the path, or stop, ten times a second."""
        command = Twist()
        if self.way and self.is_safe():
            while len(self.way) > 1 and math.dist(self.pose[:2], self.way[0]) < 0.25:
                self.way.pop(0)
            if math.dist(self.pose[:2], self.goal) > 0.05:
                command.linear.x, command.angular.z = steer(self.pose, self.way[0])
        self.publisher.publish(command)


PROGRAMS = {"perception": Perception, "decision": Decision, "control": Control}


def main(name):
    """Run one of the three, by its name, until Ctrl-C or SIGTERM; Control stops the robot then."""
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    node = PROGRAMS[name]()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        if isinstance(node, Control):
            node.publisher.publish(Twist())
            time.sleep(0.2)  # so that it arrives
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("program", choices=PROGRAMS)
    main(parser.parse_known_args()[0].program)  # the others are ROS's
