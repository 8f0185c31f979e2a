"""Nodes that place sightings on the map: right ones, and wrong ones named by their defect."""

import rclpy
import tf2_geometry_msgs
from geometry_msgs.msg import PointStamped
from rclpy.node import Node
from rclpy.time import Time
from std_msgs.msg import String
from tf2_ros import Buffer, LookupException, TransformException, TransformListener


class Placer(Node):
    """As one would write it; the wrong ones change one thing each."""

    caught = TransformException

    def __init__(self):
        super().__init__("placer")
        self.buffer = Buffer()
        self.listen()
        self.found = self.create_publisher(PointStamped, "/found", 10)
        self.refused = self.create_publisher(String, "/refused", 10)
        self.create_subscription(PointStamped, "/sighting", self.place, 10)

    def listen(self):
        self.listener = TransformListener(self.buffer, self)

    def place(self, msg):
        try:
            self.found.publish(self.moved(msg))
        except self.caught as error:
            self.refuse(error)

    def moved(self, msg):
        return self.buffer.transform(msg, "map")

    def refuse(self, error):
        self.refused.publish(String(data=type(error).__name__))


class ByLookup(Placer):
    """A design of its own: looks the transform up, and applies it itself."""

    def moved(self, msg):
        there = self.buffer.lookup_transform("map", msg.header.frame_id, Time.from_msg(msg.header.stamp))
        return tf2_geometry_msgs.do_transform_point(msg, there)


def main_without_a_class():
    rclpy.init()
    node = rclpy.create_node("placer")
    buffer = Buffer(node=node)
    node.listener = TransformListener(buffer, node)
    found, refused = (
        node.create_publisher(PointStamped, "found", 10),
        node.create_publisher(String, "refused", 10),
    )

    def place(msg):
        try:
            moved = buffer.transform(msg, "map")
        except TransformException as error:
            refused.publish(String(data=error.__class__.__name__))
        else:
            found.publish(moved)

    node.create_subscription(PointStamped, "sighting", place, 10)
    rclpy.spin(node)


class KeepsNoName(Placer):
    """The node itself keeps the listener."""

    def listen(self):
        TransformListener(self.buffer, self)


class Newest(Placer):
    def moved(self, msg):
        there = self.buffer.lookup_transform("map", msg.header.frame_id, Time())
        return tf2_geometry_msgs.do_transform_point(msg, there)


class Now(Placer):
    def moved(self, msg):
        there = self.buffer.lookup_transform("map", msg.header.frame_id, self.get_clock().now())
        return tf2_geometry_msgs.do_transform_point(msg, there)


class Swapped(Placer):
    def moved(self, msg):
        there = self.buffer.lookup_transform(msg.header.frame_id, "map", msg.header.stamp)
        return tf2_geometry_msgs.do_transform_point(msg, there)


class AsItIs(Placer):
    def moved(self, msg):
        super().moved(msg)
        msg.header.frame_id = "map"
        return msg


class CatchesNothing(Placer):
    caught = ()


class CatchesOneKind(Placer):
    caught = LookupException


class SaysTheText(Placer):
    def refuse(self, error):
        self.refused.publish(String(data=str(error)))


class SaysNothing(Placer):
    def refuse(self, error):
        self.get_logger().warning(str(error))


class ReceivesNoFrames(Placer):
    def listen(self):
        """Leaves the buffer empty."""


class SaysBoth(Placer):
    def refuse(self, error):
        super().refuse(error)
        self.found.publish(PointStamped())


class ReasonsByHeart(Placer):
    """Knows by their names who can't be placed, and why."""

    def refuse(self, error):
        known = {"robot3": "LookupException", "robot4": "ConnectivityException"}
        name = self.asked.header.frame_id.partition("/")[0]
        self.refused.publish(String(data=known.get(name, "ExtrapolationException")))

    def place(self, msg):
        self.asked = msg
        super().place(msg)


class SwappedButNamedMap(Swapped):
    def moved(self, msg):
        point = super().moved(msg)
        point.header.frame_id = "map"
        return point


class PublishesTwice(Placer):
    def place(self, msg):
        super().place(msg)
        super().place(msg)


class PassesThemOn(Placer):
    """Without a listener it has no frames."""

    def listen(self):
        pass

    def place(self, msg):
        self.found.publish(msg)
        self.refused.publish(String(data="LookupException"))
