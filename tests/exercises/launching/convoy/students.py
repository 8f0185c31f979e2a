"""Packages for launching.convoy: right ones in three styles, then wrong ones, each named by its defect."""

from tests.students.workspaces import Workspace, changed, package

PARTS = ("STOPPER", "LAUNCH", "RIGHT", "FILE", "SETUP", "BY_LOOP", "WITH_YAML", "NEEDS", "YAML")
STOPPER = """\
import math
import signal
import time

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.signals import SignalHandlerOptions
from sensor_msgs.msg import LaserScan


class Stopper(Node):
    def __init__(self):
        super().__init__("stopper")
        self.declare_parameter("gap", 0.3)  # m
        self.commands = self.create_publisher(Twist, "drive", 10)
        self.create_subscription(LaserScan, "scan", self.on_message, qos_profile_sensor_data)

    def on_message(self, scan):
        ahead = [r for r in scan.ranges[:10] + scan.ranges[-10:] if math.isfinite(r)]
        distance = min(ahead, default=9.0) - self.get_parameter("gap").value
        command = Twist()
        command.linear.x = max(0.0, min(0.5, 1.5 * distance))
        self.commands.publish(command)


def main():
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    node = Stopper()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.commands.publish(Twist())  # zeros: stand still
        time.sleep(0.2)  # so that they get there
        node.destroy_node()
        rclpy.try_shutdown()
"""
LAUNCH = """\
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def stopper(side, gap):
    return Node(
        package="convoy",
        executable="stopper",
        namespace=side,
        parameters=[{"gap": gap}],
        remappings=[("drive", "cmd_vel")],
    )


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("gap", default_value="0.5"),
        stopper("left", LaunchConfiguration("gap")),
        stopper("right", 1.0),
    ])
"""
GROUPS = """\
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node, PushRosNamespace


def generate_launch_description():
    actions = [DeclareLaunchArgument("gap", default_value="0.5")]
    for side, gap in (("left", LaunchConfiguration("gap")), ("right", 1.0)):
        settings = {"parameters": [{"gap": gap}], "remappings": [("drive", "cmd_vel")]}
        node = Node(package="convoy", executable="stopper", **settings)
        actions.append(GroupAction([PushRosNamespace(side), node]))
    return LaunchDescription(actions)
"""
NEEDS = "rclpy geometry_msgs sensor_msgs launch launch_ros"
FILE, SETUP = "convoy/launch/two.launch.py", "convoy/setup.py"
RIGHT = package(
    "convoy",
    "'stopper = convoy.stopper:main'",
    NEEDS,
    {"convoy/stopper.py": STOPPER, "launch/two.launch.py": LAUNCH},
)
PARTS = (*PARTS, "GROUPS")

Convoy = Workspace(__name__, RIGHT)
InGroups = Workspace(__name__, changed(RIGHT, FILE, new=GROUPS))  # a design of its own
SpelledOut = Workspace(
    __name__,
    changed(
        RIGHT,
        FILE,
        '[("drive", "cmd_vel")]',
        '[("/left/drive", "/left/cmd_vel"), ("/right/drive", "/right/cmd_vel")]',
    ),
)
NoLaunchFile = Workspace(__name__, changed(RIGHT, FILE))
NoNamespaces = Workspace(__name__, changed(RIGHT, FILE, "        namespace=side,\n", ""))
NoRemapping = Workspace(__name__, changed(RIGHT, FILE, '        remappings=[("drive", "cmd_vel")],\n', ""))
NoArgument = Workspace(__name__, changed(RIGHT, FILE, 'LaunchConfiguration("gap"))', "0.5)"))
ArgumentForBoth = Workspace(
    __name__, changed(RIGHT, FILE, 'stopper("right", 1.0)', 'stopper("right", LaunchConfiguration("gap"))')
)
OtherDefault = Workspace(__name__, changed(RIGHT, FILE, 'default_value="0.5"', 'default_value="0.7"'))
WholeNumber = Workspace(__name__, changed(RIGHT, FILE, 'stopper("right", 1.0)', 'stopper("right", 1)'))
NumberAsText = Workspace(__name__, changed(RIGHT, FILE, 'stopper("right", 1.0)', 'stopper("right", "1.0")'))
WithASlash = Workspace(__name__, changed(RIGHT, FILE, '("drive", "cmd_vel")', '("drive", "/cmd_vel")'))
OneTooMany = Workspace(
    __name__,
    changed(RIGHT, FILE, 'stopper("right", 1.0),', 'stopper("right", 1.0), stopper("", 0.5),'),
)
OnlyTheLeft = Workspace(__name__, changed(RIGHT, FILE, '        stopper("right", 1.0),\n', ""))
NoReturn = Workspace(__name__, changed(RIGHT, FILE, "return LaunchDescription(", "LaunchDescription("))
OtherProgram = Workspace(__name__, changed(RIGHT, FILE, 'executable="stopper"', 'executable="stoper"'))
NoNeeds = Workspace(__name__, changed(RIGHT, "convoy/package.xml", "  <depend>launch_ros</depend>\n", ""))
AbsoluteTopic = Workspace(
    __name__, changed(RIGHT, "convoy/convoy/stopper.py", 'Twist, "drive"', 'Twist, "/cmd_vel"')
)
