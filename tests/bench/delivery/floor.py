"""What perception and control both need: angles, a profile, and cells beside cells."""

import math

from rclpy.qos import DurabilityPolicy, QoSProfile

KEPT = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def yaw_of(q):
    """The turn about z of a quaternion, rad."""
    return 2 * math.atan2(q.z, q.w)


def wrapped(angle):
    """The same angle in [-pi, pi]."""
    return math.remainder(angle, math.tau)


def near(mask, cells):
    """The cells of a grid that are at most so many cells, along each axis, from one of the mask."""
    found = mask.copy()
    for _ in range(cells):
        wider = found.copy()
        wider[1:] |= found[:-1]
        wider[:-1] |= found[1:]
        found = wider.copy()
        found[:, 1:] |= wider[:, :-1]
        found[:, :-1] |= wider[:, 1:]
    return found
