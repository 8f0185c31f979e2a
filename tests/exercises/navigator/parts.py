"""What the nodes of several exercises are built of: the pose in the map, maps, plans, and steering."""

import heapq
import math

import numpy as np
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from tf2_msgs.msg import TFMessage

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
STEPS = ((1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1))


class Localized(Node):
    """Knows where the robot is in the map, from /tf."""

    def __init__(self, name):
        super().__init__(name)
        self.frames, self.stamps = {}, {}
        self.create_subscription(TFMessage, "/tf", self.on_tf, 10)

    def on_tf(self, msg):
        for transform in msg.transforms:
            place, turn = transform.transform.translation, transform.transform.rotation
            self.frames[transform.child_frame_id] = place.x, place.y, 2 * math.atan2(turn.z, turn.w)
            self.stamps[transform.child_frame_id] = Time.from_msg(transform.header.stamp)

    @property
    def is_lost(self):
        """Whether the pose isn't known, or one of the transforms is older than half a second."""
        oldest = min(self.stamps.values(), default=None)
        return len(self.stamps) < 2 or self.get_clock().now() - oldest > Duration(seconds=0.5)

    @property
    def pose(self):
        if len(self.frames) < 2:
            return None
        (x0, y0, yaw0), (x, y, yaw) = self.frames["odom"], self.frames["base_link"]
        cos, sin = math.cos(yaw0), math.sin(yaw0)
        return x0 + cos * x - sin * y, y0 + sin * x + cos * y, math.remainder(yaw0 + yaw, math.tau)


def cells_of(msg):
    return np.array(msg.data, dtype=np.int8).reshape(msg.info.height, msg.info.width)


def to_cell(info, x, y):
    corner = info.origin.position
    return math.floor((x - corner.x) / info.resolution), math.floor((y - corner.y) / info.resolution)


def to_point(info, column, row):
    corner = info.origin.position
    return corner.x + (column + 0.5) * info.resolution, corner.y + (row + 0.5) * info.resolution


def inflate(cells, reach):
    inflated = cells.copy()
    rows, columns = np.nonzero(cells == 100)
    size = math.ceil(reach)
    up, right = np.mgrid[-size : size + 1, -size : size + 1].reshape(2, -1, 1)
    near = np.hypot(up, right)[:, 0] <= reach
    row = np.clip(rows + up[near], 0, len(cells) - 1)
    inflated[row, np.clip(columns + right[near], 0, len(cells[0]) - 1)] = 100
    return inflated


def neighbors(cells, cell, steps=STEPS):
    for right, up in steps:
        x, y = cell[0] + right, cell[1] + up
        if 0 <= x < len(cells[0]) and 0 <= y < len(cells) and 0 <= cells[y][x] < 100:
            yield (x, y), math.hypot(right, up) * (1 + cells[y][x] / 50)


def find_path(cells, start, goal, weight=1.0, steps=STEPS):
    """A*; Dijkstra with a weight of 0, greedy with a large one."""
    queue, came_from, cost = [(0.0, start)], {start: None}, {start: 0.0}
    while queue:
        _, here = heapq.heappop(queue)
        if here == goal:
            way = [goal]
            while came_from[way[-1]] is not None:
                way.append(came_from[way[-1]])
            return way[::-1]
        for there, step in neighbors(cells, here, steps):
            if cost[here] + step < cost.get(there, math.inf):
                cost[there], came_from[there] = cost[here] + step, here
                heapq.heappush(queue, (cost[there] + weight * math.dist(there, goal), there))
    return []


def pose_stamped(x, y, yaw=0.0):
    msg = PoseStamped()
    msg.header.frame_id = "map"
    msg.pose.position.x, msg.pose.position.y = float(x), float(y)
    msg.pose.orientation.z, msg.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return msg


def path_message(points, frame="map"):
    path = Path(poses=[pose_stamped(*point) for point in points])
    path.header.frame_id = frame
    return path


def rest_of(path, pose):
    distances = [math.dist(pose[:2], point) for point in path]
    return path[distances.index(min(distances)) :]


def carrot(path, pose, ahead=0.3):
    rest = rest_of(path, pose)
    return next((point for point in rest if math.dist(pose[:2], point) >= ahead), path[-1])


def steer(pose, point, speed=0.4):
    x, y, yaw = pose
    bearing = math.remainder(math.atan2(point[1] - y, point[0] - x) - yaw, math.tau)
    if abs(bearing) > 1.0:
        return 0.0, math.copysign(1.5, bearing)
    return speed, speed * 2 * math.sin(bearing) / math.dist((x, y), point)
