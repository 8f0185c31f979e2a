"""`plot_scans`: what a lidar saw, drawn where odometry says that the robot was."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np

from sim.evidence import Recording, Seconds
from sim.view.plot import GRID, PATH, SOLID, WARNING, Plot, note_failure, plot

MOST = 120  # scans that are drawn
Pose = tuple[float, float, float]  # x, y (m), yaw (rad)


def plot_scans(
    recording: Recording,
    *,
    until: Seconds = math.inf,
    yaw: float = 0.0,
    scan: str = "/scan",
    odom: str = "/odom",
) -> Plot:
    """Draw the points of all scans in the frame odom: walls, if odometry and the lidar's mounting are right.

    until: up to when (s); the last scan is red. yaw: by which angle (rad) the lidar is turned further than
    /tf_static says. Needs Odometry and LaserScan messages; without /tf_static the lidar is at base_link.
    Raises ValueError if either topic has no message by then.
    """
    poses = _poses(recording, odom, until)
    scans = [row for row in recording.messages(scan) if row.stamp <= until]
    for topic, rows in ((odom, poses), (scan, scans)):
        if not len(rows):
            known = ", ".join(recording.topics) or "no topics"
            raise ValueError(f"{topic} has no message that could be drawn; this run has {known}")
    mount = _mount(recording, scans[0].message.header.frame_id, yaw)
    every = math.ceil(len(scans) / MOST)
    clouds = [scan_points(row.message, poses, mount) for row in (*scans[:-1:every], scans[-1])]
    figure, axes = plot(6.4, 5.2)
    seen = np.concatenate(clouds)
    axes.plot(seen[:, 0], seen[:, 1], ".", color=SOLID, markersize=1.5, label="scans")
    axes.plot(clouds[-1][:, 0], clouds[-1][:, 1], ".", color=WARNING, markersize=3, label="last scan")
    axes.plot(poses[:, 1], poses[:, 2], color=PATH, linewidth=1.5, label="odometry")
    axes.plot(poses[-1, 1], poses[-1, 2], "o", color=PATH, markersize=7)
    axes.set(xlabel="x in odom (m)", ylabel="y in odom (m)", aspect="equal")
    axes.set_title(f"{len(scans)} scans, where odometry says they were")
    axes.grid(color=GRID)
    return note_failure(figure, recording)


def scan_points(scan: Any, poses: np.ndarray, mount: Pose) -> np.ndarray:
    """The points of a LaserScan in odom, shape (n, 2), m.

    poses: rows of stamp (s), x, y, yaw, unwrapped. mount: the lidar's pose in base_link.
    """
    ranges = np.asarray(scan.ranges, dtype=float)
    angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
    valid = np.isfinite(ranges) & (ranges >= scan.range_min) & (ranges <= scan.range_max)
    points = _moved(ranges[valid], angles[valid], mount)
    stamp = scan.header.stamp.sec + scan.header.stamp.nanosec / 1e9
    x, y, yaw = (np.interp(stamp, poses[:, 0], poses[:, column]) for column in (1, 2, 3))
    cos, sin = math.cos(yaw), math.sin(yaw)
    moved: np.ndarray = points @ np.array([[cos, sin], [-sin, cos]]) + (x, y)
    return moved


def _moved(ranges: np.ndarray, angles: np.ndarray, mount: Pose) -> np.ndarray:
    x, y, yaw = mount
    return np.column_stack([x + ranges * np.cos(angles + yaw), y + ranges * np.sin(angles + yaw)])


def _poses(recording: Recording, topic: str, until: Seconds) -> np.ndarray:
    """Odometry as rows of stamp (s), x, y and yaw, in the order of the stamps."""
    rows = []
    for row in recording.messages(topic):
        if row.stamp <= until:
            message = row.message
            stamp, pose = message.header.stamp, message.pose.pose
            yaw = 2 * math.atan2(pose.orientation.z, pose.orientation.w)
            rows.append((stamp.sec + stamp.nanosec / 1e9, pose.position.x, pose.position.y, yaw))
    found = np.array(sorted(rows)).reshape(-1, 4)
    found[:, 3] = np.unwrap(found[:, 3])
    return found


def _mount(recording: Recording, frame: str, yaw: float) -> Pose:
    """Return the pose of the lidar in base_link by /tf_static, turned by an angle."""
    sent = itertools.chain.from_iterable(row.message.transforms for row in recording.messages("/tf_static"))
    for each in sent:
        if each.child_frame_id == frame:
            move, turn = each.transform.translation, each.transform.rotation
            return move.x, move.y, 2 * math.atan2(turn.z, turn.w) + yaw
    return 0.0, 0.0, yaw
