"""Computes poses, paths and points that the map doesn't explain, for the three programs. It needs no node."""

import heapq
import math

import numpy as np
from geometry_msgs.msg import Pose, PoseArray, PoseStamped
from rclpy.qos import DurabilityPolicy, QoSProfile

LATCHED = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)  # late joiners receive it, too
CELL = 0.1  # m; the width of a cell in which paths are searched
CLEAR = 0.2  # m from the middle of the robot to obstacles


def seconds(stamp):
    """Return a message's stamp in s."""
    return stamp.sec + stamp.nanosec / 1e9


def pose_2d(pose):
    """Return a Pose as x (m), y (m) and yaw (rad)."""
    return pose.position.x, pose.position.y, 2 * math.atan2(pose.orientation.z, pose.orientation.w)


def posed(x, y, yaw=0.0):
    """Return a Pose on the floor."""
    pose = Pose()
    pose.position.x, pose.position.y = float(x), float(y)
    pose.orientation.z, pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return pose


def pose_stamped(stamp, x, y, yaw=0.0):
    """Return a PoseStamped in map."""
    message = PoseStamped(pose=posed(x, y, yaw))
    message.header.stamp, message.header.frame_id = stamp, "map"
    return message


def pose_array(stamp, points):
    """Return a PoseArray in map from points (x, y)."""
    message = PoseArray(poses=[posed(*point) for point in points])
    message.header.stamp, message.header.frame_id = stamp, "map"
    return message


def points_of(scan, pose):
    """Return the points (x, y) in map that the rays hit, as rows; pose: x, y and yaw of the lidar."""
    ranges = np.array(scan.ranges)
    rays = np.flatnonzero(np.isfinite(ranges))
    angles = pose[2] + scan.angle_min + rays * scan.angle_increment
    return np.column_stack((pose[0] + ranges[rays] * np.cos(angles), pose[1] + ranges[rays] * np.sin(angles)))


def away_from(points, others, reach):
    """Return the points that are farther than `reach` (m) from all the others."""
    return [point for point in points if all(math.dist(point, other) > reach for other in others)]


def thinned(points, gap=0.1):
    """Return some of the points, such that each is near (m) to one of these."""
    kept = []
    for point in points:
        kept += away_from([point], kept, gap)
    return kept


def steer(pose, point, speed=0.5):
    """Return the speed (m/s) and the turning rate (rad/s) that lead to a point."""
    distance = math.dist(pose[:2], point)
    off = math.remainder(math.atan2(point[1] - pose[1], point[0] - pose[0]) - pose[2], math.tau)
    forward = min(speed, 2 * distance) * math.cos(off) ** 3 if abs(off) < 0.8 else 0.0
    return forward, 3.0 * off


class Floor:
    """The map of the warehouse, made from an OccupancyGrid."""

    def __init__(self, grid):
        self.info = grid.info
        self.left, self.bottom = grid.info.origin.position.x, grid.info.origin.position.y
        self.solid = np.array(grid.data).reshape(grid.info.height, grid.info.width) > 50
        step = round(CELL / grid.info.resolution)
        self.known = self.near(0.15)
        self.closed = self.near(CLEAR - CELL / 2)[::step, ::step]

    def near(self, reach):
        """Return the cells of the map that are at most `reach` (m), along each axis, from an obstacle."""
        found = self.solid.copy()
        for _ in range(round(reach / self.info.resolution)):
            found[1:] |= found[:-1].copy()
            found[:-1] |= found[1:].copy()
            found[:, 1:] |= found[:, :-1].copy()
            found[:, :-1] |= found[:, 1:].copy()
        return found

    def strange(self, points):
        """Return the points (rows) that are more than 0.15 m from everything on the map."""
        column = ((points[:, 0] - self.left) / self.info.resolution).astype(int).clip(0, self.info.width - 1)
        row = ((points[:, 1] - self.bottom) / self.info.resolution).astype(int).clip(0, self.info.height - 1)
        return thinned(points[~self.known[row, column]].tolist())

    def way(self, start, goal, obstacles=()):
        """Return a path from start to goal, clear of the map and the obstacles; [] if there is none."""
        closed = self.closed.copy()
        for point in obstacles:
            column, row = self.cell(point)
            closed[max(row - 2, 0) : row + 3, max(column - 2, 0) : column + 3] = True
        first, last = self.cell(start), self.cell(goal)
        closed[last[1], last[0]] = False
        came = search(closed.tolist(), first, last)
        cells = [last]
        while came.get(cells[-1]):
            cells.append(came[cells[-1]])
        middle = [(self.left + (x + 0.5) * CELL, self.bottom + (y + 0.5) * CELL) for x, y in cells[1:-1]]
        return [*middle[::-1], tuple(goal)] if last in came else []

    def cell(self, point):
        """Return the cell (column, row) of a point."""
        return int((point[0] - self.left) / CELL), int((point[1] - self.bottom) / CELL)


def search(closed, first, last):
    """From which cell each cell is reached soonest, until the last one is: A* over rows of cells."""
    queue, came, cost = [(0.0, first)], {first: None}, {first: 0.0}
    while queue:
        _, here = heapq.heappop(queue)
        if here == last:
            break
        for right, up in ((1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1)):
            there, far = (here[0] + right, here[1] + up), cost[here] + math.hypot(right, up)
            if not closed[there[1]][there[0]] and far < cost.get(there, math.inf):
                came[there], cost[there] = here, far
                heapq.heappush(queue, (far + math.dist(there, last), there))
    return came
