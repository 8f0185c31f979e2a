"""The mouse as a sensor: clicks and drags in the live picture are published as points."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import PointStamped
from rclpy.node import Node

from sim.ros.fibers.scheduler import engine

RATE = 20.0  # Hz, while the pointer is dragged


class Pointer(Node):
    """Publishes clicks in the picture of `play` on /clicked_point (geometry_msgs/PointStamped), as RViz does.

    Parameters: `frame`, in which the picture's coordinates are, by default map; `box`, the name of a movable
    box of the world that is put where the user clicks, such as box_1; by default none.
    """

    def __init__(self, **keywords: Any) -> None:
        super().__init__("pointer", **keywords)
        self._frame = self.declare_parameter("frame", "map").value
        self.box: str = self.declare_parameter("box", "").value
        self._publisher = self.create_publisher(PointStamped, "clicked_point", 10)
        self._last: tuple[float, float] | None = None
        self.create_timer(1 / RATE, self._tick)

    def _tick(self) -> None:
        run = engine()
        pointed = None if run is None else run.pointed
        if pointed is None or pointed is self._last:
            return
        self._last = pointed
        msg = PointStamped()
        msg.header.frame_id, msg.header.stamp = self._frame, self.get_clock().now().to_msg()
        msg.point.x, msg.point.y = pointed
        self._publisher.publish(msg)
