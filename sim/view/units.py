"""The units of fields of ROS messages, from the comments in the message definitions."""

from __future__ import annotations

from typing import Any

_LENGTHS = ("ranges", "range_min", "range_max", "range")
_ANGLES = ("angle_min", "angle_max", "angle_increment")
# By message type and field.
_UNITS = {
    ("Twist", "linear"): "m/s",
    ("Twist", "angular"): "rad/s",
    ("Accel", "linear"): "m/s²",
    ("Accel", "angular"): "rad/s²",
    ("Wrench", "force"): "N",
    ("Wrench", "torque"): "N m",
    ("Pose", "position"): "m",
    ("Transform", "translation"): "m",
    **{("Point", axis): "m" for axis in "xyz"},
    ("Pose2D", "x"): "m",
    ("Pose2D", "y"): "m",
    ("Pose2D", "theta"): "rad",
    ("Imu", "angular_velocity"): "rad/s",
    ("Imu", "linear_acceleration"): "m/s²",
    **{(kind, field): "m" for kind in ("LaserScan", "Range") for field in _LENGTHS},
    **{("LaserScan", field): "rad" for field in _ANGLES},
    ("LaserScan", "scan_time"): "s",
    ("LaserScan", "time_increment"): "s",
    ("Temperature", "temperature"): "°C",
    ("FluidPressure", "fluid_pressure"): "Pa",
    ("MagneticField", "magnetic_field"): "T",
    ("Illuminance", "illuminance"): "lx",
    ("BatteryState", "voltage"): "V",
    ("BatteryState", "current"): "A",
    ("BatteryState", "temperature"): "°C",
}


def unit_of(message: Any, field: str) -> str:
    """The unit of a field such as "twist.twist.linear.x"; "" if ROS doesn't define one, as for joints."""
    for part in field.split("."):
        unit = _UNITS.get((type(message).__name__, part))
        if unit:
            return unit
        message = getattr(message, part, None)
    return ""
