"""How far something is, and how fast to drive: plain functions."""
import math

GAP = 0.5  # m: where to stop


def ahead(scan, half=0.35):
    """Return the distance (m) to the nearest thing within `half` rad to each side; inf if there is nothing."""
    angles = (scan.angle_min + i * scan.angle_increment for i in range(len(scan.ranges)))
    rays = zip(angles, scan.ranges)
    near = [r for angle, r in rays if abs(math.remainder(angle, math.tau)) <= half and not math.isnan(r)]
    return max(0.0, min(near, default=math.inf))  # -inf: too near to measure


def speed_for(distance, fastest, gap):
    """Return the speed (m/s) at this distance: slower on the last stretch, and 0 at the gap."""
    return max(0.0, min(fastest, 0.8 * (distance - gap)))
