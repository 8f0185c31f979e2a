"""Costmaps: right ones, and wrong ones named by their defect."""

import math

import numpy as np
import rclpy
from geometry_msgs.msg import PointStamped
from nav_msgs.msg import OccupancyGrid
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Costmap(Node):
    """As the notebook has it; the wrong ones change a part."""

    profile, radius = LATCHED, 0.2

    def __init__(self):
        super().__init__("costmap")
        self.info = None
        self.costmap_publisher = self.create_publisher(OccupancyGrid, "/global_costmap/costmap", LATCHED)
        self.point_publisher = self.create_publisher(PointStamped, "/cell_center", 10)
        self.create_subscription(OccupancyGrid, "/map", self.on_map, self.profile)
        self.create_subscription(PointStamped, "/clicked_point", self.on_click, 10)

    def on_map(self, msg):
        self.info = msg.info
        cells = np.array(msg.data, dtype=np.int8).reshape(msg.info.height, msg.info.width)
        msg.data = self.inflate(cells, self.radius / msg.info.resolution).flatten().tolist()
        self.costmap_publisher.publish(msg)

    def on_click(self, msg):
        if self.info is not None:
            cell = self.to_cell(msg.point.x, msg.point.y)
            msg.point.x, msg.point.y = self.to_point(*cell)
            self.point_publisher.publish(msg)

    def to_cell(self, x, y):
        corner, width = self.info.origin.position, self.info.resolution
        return math.floor((x - corner.x) / width), math.floor((y - corner.y) / width)

    def to_point(self, column, row):
        corner, width = self.info.origin.position, self.info.resolution
        return corner.x + (column + 0.5) * width, corner.y + (row + 0.5) * width

    def inflate(self, cells, reach):
        inflated = cells.copy()
        height, width = cells.shape
        around = range(-math.ceil(reach), math.ceil(reach) + 1)
        for row, column in np.argwhere(cells == 100):
            for up in around:
                for right in around:
                    inside = 0 <= row + up < height and 0 <= column + right < width
                    if inside and math.hypot(up, right) <= reach + 1e-9:
                        inflated[row + up, column + right] = 100
        return inflated


class WithSlices(Costmap):
    """A design of its own: moves the whole map about, over a border that is cut off afterwards."""

    def inflate(self, cells, reach):
        size = int(reach + 1e-6)
        height, width = cells.shape
        wide = np.zeros((height + 2 * size, width + 2 * size), dtype=bool)
        for up in range(2 * size + 1):
            for right in range(2 * size + 1):
                if math.hypot(up - size, right - size) <= reach + 1e-6:
                    wide[up : up + height, right : right + width] |= cells == 100
        return np.where(wide[size : size + height, size : size + width], 100, cells)


class KnownStaysUnknown(Costmap):
    """Inflates into known cells only; int() does as well, for no point of the map is left of its origin."""

    def inflate(self, cells, reach):
        return np.where(cells == -1, -1, super().inflate(cells, reach))

    def to_cell(self, x, y):
        corner, width = self.info.origin.position, self.info.resolution
        return int((x - corner.x) / width), int((y - corner.y) / width)


class OnALittleLess(Costmap):
    """Counts 0.2 m as 3.9 cells: within the width of a cell that is right, too."""

    radius = 0.2 - 0.005


def costmap_main():
    """With plain lists and functions; publishes only what it needs."""
    rclpy.init()
    node = Node("inflation")
    profile = QoSProfile(
        depth=1, reliability=ReliabilityPolicy.RELIABLE, durability=DurabilityPolicy.TRANSIENT_LOCAL
    )
    publisher = node.create_publisher(OccupancyGrid, "global_costmap/costmap", profile)
    centers = node.create_publisher(PointStamped, "cell_center", 5)
    info = []

    def on_map(msg):
        info.append(msg.info)
        wide, size = msg.info.width, msg.info.resolution
        walls = [divmod(index, wide) for index, value in enumerate(msg.data) if value == 100]
        answer = OccupancyGrid(header=msg.header, info=msg.info, data=list(msg.data))
        for row, column in walls:
            for up in range(-4, 5):
                for right in range(-4, 5):
                    if (up * up + right * right) * size * size > 0.2 * 0.2 + 1e-6:
                        continue
                    if 0 <= row + up < msg.info.height and 0 <= column + right < wide:
                        answer.data[(row + up) * wide + column + right] = 100
        publisher.publish(answer)

    def on_click(msg):
        if not info:
            return
        corner, size = info[0].origin.position, info[0].resolution
        msg.point.x -= (msg.point.x - corner.x) % size - size / 2
        msg.point.y -= (msg.point.y - corner.y) % size - size / 2
        centers.publish(msg)

    node.create_subscription(OccupancyGrid, "map", on_map, profile)
    node.create_subscription(PointStamped, "clicked_point", on_click, 5)
    rclpy.spin(node)


class WithoutOrigin(Costmap):
    def to_cell(self, x, y):
        return math.floor(x / self.info.resolution), math.floor(y / self.info.resolution)

    def to_point(self, column, row):
        return (column + 0.5) * self.info.resolution, (row + 0.5) * self.info.resolution


class OriginOnlyThere(Costmap):
    def to_point(self, column, row):
        return (column + 0.5) * self.info.resolution, (row + 0.5) * self.info.resolution


class Rounds(Costmap):
    def to_cell(self, x, y):
        corner, width = self.info.origin.position, self.info.resolution
        return round((x - corner.x) / width), round((y - corner.y) / width)


class CornerNotMiddle(Costmap):
    def to_point(self, column, row):
        corner, width = self.info.origin.position, self.info.resolution
        return corner.x + column * width, corner.y + row * width


class RowForColumn(Costmap):
    def to_cell(self, x, y):
        return super().to_cell(x, y)[::-1]


class HalfOfTheClicks(Costmap):
    """Answers every other click."""

    count = 0

    def on_click(self, msg):
        self.count += 1
        if self.count % 2:
            super().on_click(msg)


class NoAnswers(Costmap):
    def on_click(self, msg):
        pass


class Squares(Costmap):
    """Forgets that corners are farther away."""

    def inflate(self, cells, reach):
        inflated = cells.copy()
        size = math.ceil(reach)
        for row, column in np.argwhere(cells == 100):
            low, left = max(row - size, 0), max(column - size, 0)
            inflated[low : row + size + 1, left : column + size + 1] = 100
        return inflated


class TooFar(Costmap):
    def inflate(self, cells, reach):
        return super().inflate(cells, 2 * reach)


class IntoTheOldMap(Costmap):
    """Writes into the cells that it looks at: everything fills up."""

    def inflate(self, cells, reach):
        for row in range(1, cells.shape[0]):
            for column in range(1, cells.shape[1]):
                if 100 in (cells[row - 1, column], cells[row, column - 1]):
                    cells[row, column] = 100
        return cells


class ReachInMeters(Costmap):
    def inflate(self, cells, reach):
        return super().inflate(cells, 0.2)


class OnlyCrosses(Costmap):
    """Right, left, up and down, but not between."""

    def inflate(self, cells, reach):
        inflated = cells.copy()
        for row, column in np.argwhere(cells == 100):
            inflated[max(row - 4, 0) : row + 5, column] = 100
            inflated[row, max(column - 4, 0) : column + 5] = 100
        return inflated


class NotLatched(Costmap):
    profile = 10


class WithoutInfo(Costmap):
    def on_map(self, msg):
        self.info = msg.info
        self.costmap_publisher.publish(OccupancyGrid(data=msg.data))


class ColumnsFirst(Costmap):
    """cells[x, y] leaves the map where it is not square."""

    def inflate(self, cells, reach):
        inflated = cells.copy()
        for row, column in np.argwhere(cells == 100):
            inflated[column, row] = 100
        return inflated


class NoWholeNumbers(Costmap):
    def to_cell(self, x, y):
        corner, width = self.info.origin.position, self.info.resolution
        return (x - corner.x) / width, (y - corner.y) / width


class BeginsWithNothing(Costmap):
    """An empty array in place of a copy."""

    def inflate(self, cells, reach):
        return np.zeros_like(cells)


class NeverLooksAtTheEdge(Costmap):
    """Where the map ends there is no next cell; on the other side Python begins again at the end."""

    def inflate(self, cells, reach):
        inflated, around = cells.copy(), range(-4, 5)
        for row, column in np.argwhere(cells == 100):
            for up, right in [(up, right) for up in around for right in around]:
                if math.hypot(up, right) <= reach + 1e-9:
                    inflated[row + up, column + right] = 100
        return inflated


class ForgetsBrackets(Costmap):
    """Divides the origin alone."""

    def to_cell(self, x, y):
        corner, width = self.info.origin.position, self.info.resolution
        return math.floor(x - corner.x / width), math.floor(y - corner.y / width)


class Inscribed(Costmap):
    """Writes 99, which Nav2 has for cells that are as near as this, and not 100."""

    def inflate(self, cells, reach):
        return np.where((super().inflate(cells, reach) == 100) & (cells != 100), 99, cells)


class ColumnForRow(Costmap):
    """Writes into inflated[column, row], where there is such a cell."""

    def inflate(self, cells, reach):
        inflated = cells.copy()
        for row, column in np.argwhere((super().inflate(cells, reach) == 100) & (cells != 100)):
            if column < len(cells) and row < len(cells[0]):
                inflated[column, row] = 100
        return inflated


class WithoutTheMap(Node):
    """Listens to clicks only."""

    def __init__(self):
        super().__init__("costmap")
        self.create_subscription(PointStamped, "/clicked_point", lambda msg: None, 10)


class WithoutACostmap(Costmap):
    """Inflates the map, and publishes nothing."""

    def on_map(self, msg):
        self.info = msg.info
