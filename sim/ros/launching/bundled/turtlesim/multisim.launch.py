"""Two ponds, each in a namespace: ros2 launch turtlesim multisim.launch.py"""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    """Return what is launched."""
    ponds = ("turtlesim1", "turtlesim2")
    return LaunchDescription(
        [Node(package="turtlesim", executable="turtlesim_node", namespace=pond) for pond in ponds]
    )
