"""What the navigator computes: cells, plans and steering. It needs no ROS, so it can be tried alone."""

import heapq
import math

import numpy as np


def yaw_of(orientation):
    """The yaw of a quaternion, in rad."""
    return 2 * math.atan2(orientation.z, orientation.w)


def cells_of(msg):
    """The cells of a map, as an array of rows."""
    return np.array(msg.data, dtype=np.int8).reshape(msg.info.height, msg.info.width)


def to_cell(info, x, y):
    """The cell (column, row) that holds a point."""
    column = math.floor((x - info.origin.position.x) / info.resolution)
    return column, math.floor((y - info.origin.position.y) / info.resolution)


def to_point(info, column, row):
    """The middle of a cell, in m."""
    x = info.origin.position.x + (column + 0.5) * info.resolution
    return x, info.origin.position.y + (row + 0.5) * info.resolution


def inflate(cells, reach):
    """A copy with 100 wherever an occupied cell is at most `reach` cells away."""
    inflated = cells.copy()
    rows, columns = np.nonzero(cells == 100)
    around = range(-math.ceil(reach), math.ceil(reach) + 1)
    for up, right in [(up, right) for up in around for right in around if math.hypot(up, right) <= reach]:
        row, column = rows + up, columns + right
        inside = (row >= 0) & (row < len(cells)) & (column >= 0) & (column < len(cells[0]))
        inflated[row[inside], column[inside]] = 100
    return inflated


def neighbors(cells, cell):
    """The free cells around a cell, and how far they are, in cells."""
    column, row = cell
    for right, up in ((1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1)):
        x, y = column + right, row + up
        if 0 <= x < len(cells[0]) and 0 <= y < len(cells) and cells[y][x] == 0:
            yield (x, y), math.hypot(right, up)


def reconstruct_path(came_from, goal):
    """The cells from the start to the goal; none if the search never reached it."""
    cells = [goal] if goal in came_from else []
    while cells and came_from[cells[-1]] is not None:
        cells.append(came_from[cells[-1]])
    return cells[::-1]


def search(cells, start, goal):
    """The cells from start to goal, by A*; none where nothing leads there."""
    queue, came_from, cost = [(0.0, start)], {start: None}, {start: 0.0}
    while queue:
        _, here = heapq.heappop(queue)
        if here == goal:
            break
        for there, step in neighbors(cells, here):
            if cost[here] + step < cost.get(there, math.inf):
                cost[there], came_from[there] = cost[here] + step, here
                heapq.heappush(queue, (cost[there] + math.dist(there, goal), there))
    return reconstruct_path(came_from, goal)


def distance_and_bearing(x, y, yaw, goal):
    """How far the goal is (m), and how far to turn to face it (rad, positive to the left)."""
    dx, dy = goal[0] - x, goal[1] - y
    return math.hypot(dx, dy), math.remainder(math.atan2(dy, dx) - yaw, math.tau)


def rest_of(path, pose):
    """The path from the point on that is nearest to the robot."""
    distances = [math.dist(pose[:2], point) for point in path]
    return path[distances.index(min(distances)) :]


def carrot(path, pose, ahead=0.3):
    """The first point of the rest that is so far away (m)."""
    return next((point for point in rest_of(path, pose) if math.dist(pose[:2], point) >= ahead), path[-1])


def steer(pose, point, speed=0.4):
    """The speed (m/s) and the turn (rad/s) that lead to a point, on a circle."""
    distance, bearing = distance_and_bearing(*pose, point)
    if abs(bearing) > 1.0:
        return 0.0, math.copysign(1.5, bearing)  # far to the side: turn on the spot
    return speed, speed * 2 * math.sin(bearing) / distance
