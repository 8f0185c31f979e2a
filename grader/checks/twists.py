"""Velocity commands (geometry_msgs Twist): their speeds, and their text."""

from __future__ import annotations

from sim.evidence import Message

OUT, TWIST = "/cmd_vel", "geometry_msgs/msg/Twist"
SAME = 1e-3  # m/s, rad/s

Speeds = tuple[float, float]
"""linear.x in m/s, angular.z in rad/s."""


def speeds(row: Message) -> Speeds:
    """Return the two speeds of a velocity command."""
    return row.message.linear.x, row.message.angular.z


def speeds_text(command: Speeds) -> str:
    """Return two speeds as text: "linear.x 0.3, angular.z 0"."""
    return f"linear.x {command[0]:.3g}, angular.z {command[1]:.3g}"
