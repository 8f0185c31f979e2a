"""The ROS distribution that the course uses."""

DISTRO = "jazzy"
RCLPY_DISTRIBUTION = f"ros-{DISTRO}-rclpy"
"""The name of rclpy's distribution on PyPI."""
