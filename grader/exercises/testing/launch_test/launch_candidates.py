"""Launch files of the package `speed_guard`: three right ones, and nine that are wrong in one point each."""

from functools import partial
from typing import Any

from grader.companions.candidates import Candidates, in_order

GIVEN = """\
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(
            package="speed_guard",
            executable="limiter",
            namespace="front",
            parameters=[{"limit": 0.3, "backward_limit": 0.3}],
            remappings=[("request", "wanted"), ("speed", "driven")],
        ),
    ])
"""
IN_A_GROUP = """\
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node, PushRosNamespace, SetParameter, SetRemap


def generate_launch_description():
    side, most = LaunchConfiguration("side"), LaunchConfiguration("most")
    limiter = Node(package="speed_guard", executable="limiter", name="guard")
    limits = [SetParameter("limit", most), SetParameter("backward_limit", most)]
    renamed = [SetRemap("request", "wanted"), SetRemap("speed", "driven")]
    return LaunchDescription([
        DeclareLaunchArgument("side", default_value="front"),
        DeclareLaunchArgument("most", default_value=str(3 / 10)),
        GroupAction([PushRosNamespace(side), *limits, *renamed, limiter]),
    ])
"""
AS_A_COMMAND = """\
from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch_ros.substitutions import ExecutableInPackage


def generate_launch_description():
    names = "-r __ns:=/front -r request:=/front/wanted -r speed:=/front/driven"
    limits = "-p limit:=0.30 -p backward_limit:=0.3"
    limiter = ExecutableInPackage("limiter", "speed_guard")
    command = [limiter, "--ros-args", *names.split(), *limits.split()]
    return LaunchDescription([ExecuteProcess(cmd=command, output="screen")])
"""
# What differs from the given file in one line may be right, too.
IN_ANOTHER_ORDER = GIVEN.replace(
    '[("request", "wanted"), ("speed", "driven")]', '[("speed", "driven"), ("request", "wanted")]'
)
RIGHT = (IN_ANOTHER_ORDER, IN_A_GROUP, AS_A_COMMAND)
NODE = GIVEN[GIVEN.index("        Node(") : GIVEN.index("    ])")]
LIMITS = 'parameters=[{"limit": 0.3, "backward_limit": 0.3}]'
OTHER_NODE = 'ros_arguments=["-p", "guard:limit:=0.3", "-p", "guard:backward_limit:=0.3"]'
WRONG = (
    GIVEN.replace('executable="limiter"', 'executable="relay"'),
    GIVEN.replace('("request", "wanted"), ', ""),
    GIVEN.replace(', ("speed", "driven")', ""),
    GIVEN.replace(LIMITS, 'parameters=[{"limit": 0.3}]'),
    GIVEN.replace(LIMITS, 'parameters=[{"backward_limit": 0.3}]'),
    GIVEN.replace(LIMITS, OTHER_NODE),
    GIVEN.replace('            namespace="front",\n', ""),
    GIVEN.replace('("speed", "driven")', '("speed", "/driven")'),
    GIVEN.replace(NODE, NODE + NODE.replace('"front",', '"front",\n            name="second",')),
)


def candidates(seed: int) -> list[tuple[bool, str]]:
    """Return whether it is right, and the text of each candidate, in the order of a seed."""
    return in_order("launch_test", seed, RIGHT, WRONG)


def companions(seed: int) -> list[Any]:
    """Return the programs of a seed."""
    return [partial(Candidates, candidates(seed))]
