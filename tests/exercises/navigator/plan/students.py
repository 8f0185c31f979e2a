"""Planners: right ones, and wrong ones named by their defect."""

import heapq
import itertools
import math
from collections import deque

import numpy as np
import rclpy
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import OccupancyGrid, Path
from rclpy.node import Node
from tf2_msgs.msg import TFMessage

from tests.exercises.navigator.parts import (
    LATCHED,
    STEPS,
    Localized,
    cells_of,
    find_path,
    neighbors,
    path_message,
    to_cell,
    to_point,
)


class Planner(Localized):
    """A*, as the notebook has it; the wrong ones change a part."""

    topic, weight, steps, frame = "/plan", 1.0, STEPS, "map"

    def __init__(self):
        super().__init__("planner")
        self.costmap = None
        self.publisher = self.create_publisher(Path, self.topic, 10)
        self.create_subscription(OccupancyGrid, "/global_costmap/costmap", self.on_costmap, LATCHED)
        self.create_subscription(PoseStamped, "/goal_pose", self.on_goal, 10)

    def on_costmap(self, msg):
        self.costmap = msg

    def on_goal(self, msg):
        info, goal = self.costmap.info, msg.pose.position
        start, end = to_cell(info, *self.pose[:2]), to_cell(info, goal.x, goal.y)
        way = self.find(cells_of(self.costmap).tolist(), start, end)
        self.publisher.publish(path_message([to_point(info, *cell) for cell in way], self.frame))

    def find(self, cells, start, goal):
        return find_path(cells, start, goal, self.weight, self.steps)


class Dijkstra(Planner):
    """The same without a guess."""

    weight = 0.0


class ClosedSet(Planner):
    """Keeps whole ways in the queue, and a set of cells that are done."""

    def find(self, cells, start, goal):
        count, done = itertools.count(), set()
        queue = [(math.dist(start, goal), next(count), 0.0, [start])]
        while queue:
            _, _, cost, way = heapq.heappop(queue)
            if way[-1] == goal:
                return way
            if way[-1] in done:
                continue
            done.add(way[-1])
            for there, step in neighbors(cells, way[-1]):
                if there not in done:
                    rank = cost + step + math.dist(there, goal)
                    heapq.heappush(queue, (rank, next(count), cost + step, [*way, there]))
        return []


def wavefront_main(args=None):
    """A design of its own: relaxes the whole grid with numpy, then walks downhill from the robot."""
    rclpy.init(args=args)
    node = Node("wavefront_planner")
    publisher = node.create_publisher(Path, "plan", 1)
    maps, frames = [], {}

    def on_tf(msg):
        for t in msg.transforms:
            move, turn = t.transform.translation, t.transform.rotation
            frames[t.header.frame_id] = complex(move.x, move.y), complex(turn.w, turn.z) ** 2

    def on_goal(msg):
        info = maps[-1].info
        free = cells_of(maps[-1]) == 0
        here = frames["map"][0] + frames["map"][1] * frames["odom"][0]
        column, row = to_cell(info, msg.pose.position.x, msg.pose.position.y)
        far = np.pad(np.full(free.shape, np.inf), 1, constant_values=np.inf)
        far[row + 1, column + 1] = 0.0 if free[row, column] else np.inf
        before = None
        while before is None or not np.array_equal(far, before):
            before = far.copy()
            for dx, dy in STEPS:
                moved = np.roll(before, (dy, dx), (0, 1)) + math.hypot(dx, dy)
                far[1:-1, 1:-1] = np.where(free, np.minimum(far, moved)[1:-1, 1:-1], np.inf)
        x, y = to_cell(info, here.real, here.imag)
        way = [(x, y)] if np.isfinite(far[y + 1, x + 1]) else []
        while way and far[way[-1][1] + 1, way[-1][0] + 1] > 0:
            x, y = way[-1]
            way.append(min(
                ((x + dx, y + dy) for dx, dy in STEPS),
                key=lambda c: far[c[1] + 1, c[0] + 1] + math.dist(c, (x, y)),
            ))  # fmt: skip
        publisher.publish(path_message([to_point(info, *cell) for cell in way]))

    node.create_subscription(OccupancyGrid, "global_costmap/costmap", maps.append, LATCHED)
    node.create_subscription(TFMessage, "tf", on_tf, 10)
    node.create_subscription(PoseStamped, "goal_pose", on_goal, 1)
    rclpy.spin(node)
    node.destroy_node()
    rclpy.shutdown()


class PlansAgainAndAgain(Planner):
    """Publishes the plan twice a second, as Nav2 does, as long as no one sends another goal."""

    goal = None

    def __init__(self):
        super().__init__()
        self.create_timer(0.5, self.again)

    def on_goal(self, msg):
        self.goal = msg
        super().on_goal(msg)

    def again(self):
        if self.goal is not None:
            super().on_goal(self.goal)


class FourNeighbors(Planner):
    """No diagonal steps: the ways are longer."""

    steps = STEPS[:4]


class EstimatesTimesEight(Planner):
    """In a hurry: what is near the goal comes first, whatever it costs to get there."""

    weight = 8.0


class EstimatesTimesTwo(Planner):
    weight = 2.0


class FewestSteps(Planner):
    """Counts a diagonal step as one."""

    def find(self, cells, start, goal):
        queue, came_from = deque([start]), {start: None}
        while queue and goal not in came_from:
            here = queue.popleft()
            for there, _ in neighbors(cells, here, STEPS[4:] + STEPS[:4]):
                if there not in came_from:
                    came_from[there] = here
                    queue.append(there)
        way = [goal] if goal in came_from else []
        while way and came_from[way[-1]] is not None:
            way.append(came_from[way[-1]])
        return way[::-1]


class FirstWayWins(Planner):
    """Never finds a shorter way to a cell that was seen; and puts the last one first."""

    def find(self, cells, start, goal):
        stack, came_from = [start], {start: None}
        while stack and goal not in came_from:
            here = stack.pop()
            for there, _ in neighbors(cells, here):
                if there not in came_from:
                    came_from[there] = here
                    stack.append(there)
        way = [goal] if goal in came_from else []
        while way and came_from[way[-1]] is not None:
            way.append(came_from[way[-1]])
        return way[::-1]


class Backwards(Planner):
    def find(self, cells, start, goal):
        return super().find(cells, start, goal)[::-1]


class WithoutTheStart(Planner):
    """Stops reading the way back too early."""

    def find(self, cells, start, goal):
        return super().find(cells, start, goal)[10:]


class EveryTenth(Planner):
    def find(self, cells, start, goal):
        way = super().find(cells, start, goal)
        return way[::10] + way[-1:]


class StraightLine(Planner):
    """As if there were no walls."""

    def find(self, cells, start, goal):
        count = max(abs(goal[0] - start[0]), abs(goal[1] - start[1]))
        dx, dy = goal[0] - start[0], goal[1] - start[1]
        shares = [step / count for step in range(count + 1)]
        return [(round(start[0] + dx * share), round(start[1] + dy * share)) for share in shares]


class NeverPushes(Planner):
    """Finds nothing, for nothing comes into the queue."""

    def find(self, cells, start, goal):
        return []


class NoFrame(Planner):
    frame = ""


class Misspelt(Planner):
    topic = "/path"


class RaisesWithoutAWay(Planner):
    def find(self, cells, start, goal):
        way = super().find(cells, start, goal)
        if not way:
            raise KeyError(goal)
        return way


class GivesNoWayBack(Planner):
    def find(self, cells, start, goal):
        way = super().find(cells, start, goal)[::-1]
        return way.reverse()


class SwapsXAndY(Planner):
    """Turns a cell into (y, x)."""

    def on_goal(self, msg):
        info, goal = self.costmap.info, msg.pose.position
        start, end = to_cell(info, *self.pose[:2]), to_cell(info, goal.x, goal.y)
        way = self.find(cells_of(self.costmap).tolist(), start, end)
        self.publisher.publish(path_message([to_point(info, *cell)[::-1] for cell in way]))
