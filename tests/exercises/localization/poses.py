"""What the answers of these exercises have in common: poses, and distances to the nearest wall."""

import math

import numpy as np
from geometry_msgs.msg import Pose


def yaw_of(turn):
    return 2 * math.atan2(turn.z, turn.w)


def pose_of(x, y, yaw):
    pose = Pose()
    pose.position.x, pose.position.y = float(x), float(y)
    pose.orientation.z, pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return pose


def field_of(cells, resolution, most=0.5):
    field = np.full(cells.shape, most)
    rows, columns = np.nonzero(cells == 100)
    reach = math.ceil(most / resolution)
    for up in range(-reach, reach + 1):
        for right in range(-reach, reach + 1):
            row, column = rows + up, columns + right
            inside = (row >= 0) & (row < len(cells)) & (column >= 0) & (column < len(cells[0]))
            there = row[inside], column[inside]
            field[there] = np.minimum(field[there], math.hypot(up, right) * resolution)
    return field


def step(a, b):
    cos, sin = math.cos(a[2]), math.sin(a[2])
    dx, dy = b[0] - a[0], b[1] - a[1]
    return cos * dx + sin * dy, cos * dy - sin * dx, math.remainder(b[2] - a[2], math.tau)
