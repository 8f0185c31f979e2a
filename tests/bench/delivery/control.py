"""Control: drive there, and keep clear of everybody."""

import math
from heapq import heappop, heappush

import numpy as np
from geometry_msgs.msg import PoseArray, PoseStamped, Twist
from nav_msgs.msg import OccupancyGrid
from rclpy.node import Node
from rclpy.time import Time

from tests.bench.delivery.floor import KEPT, near, wrapped, yaw_of


class Control(Node):
    """Drives to /goal_pose on the shortest free way, and stands while a person is near."""

    speed, clear, away = 0.5, 0.2, 1.5  # m/s; m from the middle to what is solid; m from people
    size = 0.1  # m; a cell of the plan

    def __init__(self):
        super().__init__("control")
        self.solid = self.pose = self.goal = None
        self.people, self.obstacles, self.received, self.way = [], [], -math.inf, []
        self.placed = -math.inf
        self.create_subscription(OccupancyGrid, "/map", self.on_map, KEPT)
        self.create_subscription(PoseArray, "/people", self.on_people, 10)
        self.create_subscription(PoseArray, "/obstacles", self.on_obstacles, 10)
        self.create_subscription(PoseStamped, "/goal_pose", self.on_goal, 10)
        self.create_subscription(PoseStamped, "/robot_pose", self.on_pose, 10)
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(1.0, self.look_again)
        self.create_timer(0.1, self.stand)

    def on_map(self, grid):
        self.origin = grid.info.origin.position.x, grid.info.origin.position.y
        step = round(self.size / grid.info.resolution)
        cells = np.array(grid.data, dtype=np.int8).reshape(grid.info.height, grid.info.width) > 50
        cells = near(cells, round(self.clear / grid.info.resolution) - 1)
        self.solid = cells[::step, ::step]

    def on_people(self, people):
        self.people = [(pose.position.x, pose.position.y) for pose in people.poses]
        self.received = Time.from_msg(people.header.stamp).nanoseconds

    def on_obstacles(self, obstacles):
        self.obstacles = [(pose.position.x, pose.position.y) for pose in obstacles.poses]

    def on_goal(self, goal):
        place = goal.pose.position.x, goal.pose.position.y
        if place != self.goal:
            self.goal, self.way = place, []

    def look_again(self):
        """Once a second: is the way still free?"""
        if self.way and any(math.dist(a, b) < self.clear for a in self.way for b in self.obstacles):
            self.way = []

    def stand(self):
        """No one says any more where the robot is: say so to the motors, again and again."""
        if self.get_clock().now().nanoseconds - self.placed > 0.5e9:
            self.publisher.publish(Twist())

    def on_pose(self, message):
        self.placed = self.get_clock().now().nanoseconds
        x, y = message.pose.position.x, message.pose.position.y
        late = Time.from_msg(message.header.stamp).nanoseconds - self.received > 0.5e9
        person = any(math.dist((x, y), place) < self.away for place in self.people)
        command = Twist()
        if not (late or person or self.goal is None or self.solid is None):
            self.way = self.way or self.plan((x, y))
            command.linear.x, command.angular.z = self.follow(x, y, yaw_of(message.pose.orientation))
        self.publisher.publish(command)

    def follow(self, x, y, yaw):
        """Velocities along the way: m/s, rad/s."""
        if not self.way:
            return 0.0, 0.0
        while len(self.way) > 1 and math.dist((x, y), self.way[0]) < 0.25:
            self.way.pop(0)
        left = math.dist((x, y), self.way[0])
        if len(self.way) == 1 and left < 0.04:
            return 0.0, 0.0
        off = wrapped(math.atan2(self.way[0][1] - y, self.way[0][0] - x) - yaw)
        speed = self.speed if len(self.way) > 1 else min(self.speed, left + 0.03)
        return (speed * math.cos(off) ** 3 if abs(off) < 0.8 else 0.0), 3.0 * off

    def plan(self, start):
        """Points from here to the goal, or [] where there is no way now: A* over cells."""
        solid = self.solid.copy()
        for point in self.obstacles:
            column, row = self.cell(point)
            solid[max(row - 2, 0) : row + 3, max(column - 2, 0) : column + 3] = True
        solid, first, last = solid.tolist(), self.cell(start), self.cell(self.goal)
        costs, came, queue = {first: 0.0}, {}, [(0.0, first)]
        while queue:
            _, here = heappop(queue)
            if here == last:
                break
            for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)):
                cell = here[0] + dx, here[1] + dy
                if solid[cell[1]][cell[0]] and cell != last:
                    continue
                cost = costs[here] + math.hypot(dx, dy)
                if cost < costs.get(cell, math.inf):
                    costs[cell], came[cell] = cost, here
                    heappush(queue, (cost + math.dist(cell, last), cell))
        if last not in came:
            return [self.goal] if first == last else []
        way, cell = [self.goal], came[last]
        while cell != first:
            middle = zip(self.origin, cell, strict=True)
            way.append(tuple(low + (index + 0.5) * self.size for low, index in middle))
            cell = came[cell]
        return way[::-1]

    def cell(self, point):
        return tuple(int((value - low) / self.size) for value, low in zip(point, self.origin, strict=True))
