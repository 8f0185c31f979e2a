from launch import LaunchDescription
from launch.actions import Shutdown, TimerAction
from launch.substitutions import PathJoinSubstitution, ThisLaunchFileDir
from launch_ros.actions import Node


def generate_launch_description():
    program = PathJoinSubstitution([ThisLaunchFileDir(), "launched.py"])
    one = Node(executable="python3", arguments=[program], namespace="one", exec_name="one")
    two = Node(
        executable="python3", arguments=[program, "dies"], namespace="two", exec_name="two",
        respawn=True, respawn_delay=0.5,
    )  # fmt: skip
    return LaunchDescription(
        [one, TimerAction(period=1.0, actions=[two]), TimerAction(period=4.0, actions=[Shutdown()])]
    )
