"""Scans drawn where odometry says that they were."""

import math

import numpy as np
import pytest
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from sim import run
from sim.view import plot_scans


class Robot(Node):
    """Drives along x at 1 m/s; its lidar, turned to the left, sees one point 2 m ahead of itself."""

    def __init__(self):
        super().__init__("robot")
        self.odom = self.create_publisher(Odometry, "/odom", 10)
        self.scan = self.create_publisher(LaserScan, "/scan", 10)
        mount = TransformStamped(child_frame_id="laser")
        mount.transform.translation.x = 0.5
        mount.transform.rotation.z = mount.transform.rotation.w = math.sqrt(0.5)
        self.create_publisher(TFMessage, "/tf_static", 10).publish(TFMessage(transforms=[mount]))
        self.count = 0
        self.create_timer(0.1, self.sense)

    def sense(self):
        stamp = self.get_clock().now().to_msg()
        odom = Odometry()
        odom.header.stamp, odom.pose.pose.position.x = stamp, 0.1 * self.count
        odom.pose.pose.orientation.w = 1.0
        self.odom.publish(odom)
        scan = LaserScan(range_min=0.1, range_max=5.0, angle_increment=1.0, ranges=[2.0, math.inf, math.nan])
        scan.header.stamp, scan.header.frame_id = stamp, "laser"
        self.scan.publish(scan)
        self.count += 1


@pytest.fixture(scope="module")
def driven():
    return run(Robot, seconds=1.05, quiet=True)


def points(figure, label):
    (line,) = [line for line in figure.axes[0].get_lines() if line.get_label() == label]
    return np.column_stack(line.get_data())


def test_points_are_where_odometry_and_the_mounting_put_them(driven):
    figure = plot_scans(driven)
    seen = points(figure, "scans")
    assert np.allclose(sorted(seen[:, 0]), 0.5 + 0.1 * np.arange(10)) and np.allclose(seen[:, 1], 2.0)
    assert np.allclose(points(figure, "last scan"), [[1.4, 2.0]])
    assert figure.axes[0].get_title() == "10 scans, where odometry says they were"


def test_a_turned_lidar_and_an_earlier_end(driven):
    seen = points(plot_scans(driven, yaw=-math.pi / 2, until=0.55), "scans")
    assert np.allclose(seen, np.column_stack([2.5 + 0.1 * np.arange(5), np.zeros(5)]))


def test_a_run_without_scans_has_none_to_draw(driven):
    with pytest.raises(ValueError, match=r"^/lidar has no message that could be drawn; this run has /odom"):
        plot_scans(driven, scan="/lidar")
