"""Nodes that come late and speak to latecomers: right ones, and wrong ones named by their defect."""

import rclpy
from nav_msgs.msg import OccupancyGrid
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import Float64, Int32

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Surveyor(Node):
    """As one would write it; the wrong ones change one thing each."""

    receiving, telling = LATCHED, LATCHED

    def __init__(self):
        super().__init__("surveyor")
        self.publisher = self.create_publisher(Int32, "/free", self.telling)
        self.create_subscription(OccupancyGrid, "/map", self.on_map, self.receiving)

    def on_map(self, msg):
        self.publisher.publish(Int32(data=self.count(list(msg.data))))

    def count(self, cells):
        return cells.count(0)


class WrittenOut(Surveyor):
    receiving = QoSProfile(
        depth=5, durability=DurabilityPolicy.TRANSIENT_LOCAL, reliability=ReliabilityPolicy.RELIABLE
    )

    def count(self, cells):
        return sum(1 for cell in cells if cell == 0)


class MakesItsPublisherLater(Surveyor):
    """A design of its own: the latched publisher is made when the map has come."""

    def __init__(self):
        Node.__init__(self, "surveyor")
        self.publisher = None
        self.create_subscription(OccupancyGrid, "/map", self.on_map, LATCHED)

    def on_map(self, msg):
        self.publisher = self.publisher or self.create_publisher(Int32, "/free", LATCHED)
        super().on_map(msg)


def main_without_a_class():
    rclpy.init()
    node = rclpy.create_node("surveyor")
    publisher = node.create_publisher(Int32, "free", LATCHED)

    def on_message(grid):
        publisher.publish(Int32(data=list(grid.data).count(0)))

    node.create_subscription(OccupancyGrid, "map", on_message, LATCHED)
    rclpy.spin(node)


class VolatileEars(Surveyor):
    receiving = 10


class VolatileMouth(Surveyor):
    telling = 10


class BestEffortMouth(Surveyor):
    telling = QoSProfile(
        depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL, reliability=ReliabilityPolicy.BEST_EFFORT
    )


class DeepMouth(Surveyor):
    telling = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class SaysItAgainAndAgain(Surveyor):
    """The poor way: with a timer, everybody receives it some time."""

    last, telling = None, 10

    def __init__(self):
        super().__init__()
        self.create_timer(0.5, self.repeat)

    def count(self, cells):
        self.last = super().count(cells)
        return self.last

    def repeat(self):
        if self.last is not None:
            self.publisher.publish(Int32(data=self.last))


class LatchedAndRepeated(SaysItAgainAndAgain):
    telling = LATCHED


class FirstMapOnly(Surveyor):
    done = False

    def on_map(self, msg):
        if not self.done:
            super().on_map(msg)
        self.done = True


class CountsKnown(Surveyor):
    def count(self, cells):
        return sum(cell >= 0 for cell in cells)


class CountsOccupied(Surveyor):
    def count(self, cells):
        return sum(cell > 0 for cell in cells)


class CountsAll(Surveyor):
    def count(self, cells):
        return len(cells)


class CountsNotOccupied(Surveyor):
    def count(self, cells):
        return sum(cell < 50 for cell in cells)


class Silent(Surveyor):
    def on_map(self, msg):
        self.count(msg.data)


class OtherType(Surveyor):
    """Declares a whole number, and sends another kind of it."""

    def __init__(self):
        Node.__init__(self, "surveyor")
        self.publisher = self.create_publisher(Float64, "/free", LATCHED)
        self.create_subscription(OccupancyGrid, "/map", self.on_map, LATCHED)

    def on_map(self, msg):
        self.publisher.publish(Float64(data=float(list(msg.data).count(0))))


class OtherTopic(Surveyor):
    def __init__(self):
        Node.__init__(self, "surveyor")
        self.publisher = self.create_publisher(Int32, "/free", LATCHED)
        self.create_subscription(OccupancyGrid, "/global_map", self.on_map, LATCHED)
