"""The ROS distribution whose packages are installed: Jazzy, which the course is written for, or Kilted."""

from importlib.metadata import PackageNotFoundError, version

_SUPPORTED = ("jazzy", "kilted")


def _installed() -> str:
    for name in _SUPPORTED:
        try:
            version(f"ros-{name}-rclpy")
        except PackageNotFoundError:
            continue
        return name
    return _SUPPORTED[0]  # from a ROS installation, as in the container for ARM


DISTRO = _installed()
RCLPY_DISTRIBUTION = f"ros-{DISTRO}-rclpy"
"""The name of rclpy's distribution on PyPI."""
