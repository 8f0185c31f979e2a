"""A small package as colcon installs it, `two_robots`: a driver, a program that fails, and launch files."""

from __future__ import annotations

import os
import sys
import sysconfig
from pathlib import Path

NAME = "two_robots"
DRIVER = '''
import rclpy
from geometry_msgs.msg import Twist
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

made = []  # each program has its own


class Driver(Node):
    """Drives ahead at a speed."""

    def __init__(self):
        super().__init__("driver")
        made.append(self)
        self.speed = self.declare_parameter("speed", 0.1).value
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_timer(0.5, self.tick)
        # Ctrl-C before the spin is an error, as on a robot: it is ready when it spins.
        rclpy.get_global_executor().create_task(print, "ready", flush=True)

    def tick(self):
        message = Twist()
        message.linear.x = self.speed * len(made)
        self.publisher.publish(message)


def main(args=None):
    rclpy.init(args=args)
    try:
        rclpy.spin(Driver())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # and no try_shutdown(): Ctrl-C shuts down at the same time, and rclpy fails if it is in between
'''
SCRIPT = """#!{python}
import sys
from two_robots.driver import main
sys.exit(main())
"""
ONCE = """#!{python}
import sys, time
time.sleep(1.0)
sys.exit(int(sys.argv[1]))
"""
BRINGUP = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction, IncludeLaunchDescription, TimerAction
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node, PushRosNamespace
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    share = FindPackageShare("two_robots")
    one = PythonLaunchDescriptionSource(PathJoinSubstitution([share, "launch", "one.launch.py"]))
    left = GroupAction([
        PushRosNamespace("left"),
        IncludeLaunchDescription(one, launch_arguments={"speed": LaunchConfiguration("speed")}.items()),
    ])
    right = Node(
        package="two_robots", executable="driver", namespace="right", output="screen",
        parameters=[PathJoinSubstitution([share, "config", "speeds.yaml"])],
        remappings=[("cmd_vel", "wheels")],
    )
    return LaunchDescription([
        DeclareLaunchArgument("speed", default_value="0.25", description="of the left robot, in m/s"),
        left,
        TimerAction(period=1.25, actions=[right]),
    ])
"""
ONE = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    speed = {"speed": LaunchConfiguration("speed")}
    return LaunchDescription([
        DeclareLaunchArgument("speed"),
        Node(package="two_robots", executable="driver", name="driver", output="screen", parameters=[speed]),
    ])
"""
BRINGUP_YAML = """
launch:
- arg: {name: speed, default: "0.25", description: "of the left robot, in m/s"}
- group:
  - push_ros_namespace: {namespace: left}
  - include:
      file: $(find-pkg-share two_robots)/launch/one.launch.py
      arg: [{name: speed, value: $(var speed)}]
- timer:
    period: 1.25
    children:
    - node:
        pkg: two_robots
        exec: driver
        namespace: right
        output: screen
        param: [{from: $(find-pkg-share two_robots)/config/speeds.yaml}]
        remap: [{from: cmd_vel, to: wheels}]
"""
RESPAWN = """
from launch import LaunchDescription
from launch.actions import LogInfo, RegisterEventHandler, Shutdown, TimerAction
from launch.event_handlers import OnProcessExit, OnProcessStart
from launch_ros.actions import Node


def generate_launch_description():
    fails = Node(
        package="two_robots", executable="once", arguments=["3"], respawn=True, respawn_delay=0.5,
        respawn_max_retries=1,
    )
    ends = Node(package="two_robots", executable="once", arguments=["0"], exec_name="last")
    handlers = [
        OnProcessExit(target_action=fails, on_exit=lambda event, _: LogInfo(msg=f"exit {event.returncode}")),
        OnProcessStart(target_action=ends, on_start=[LogInfo(msg="the last one")]),
        OnProcessExit(target_action=ends, on_exit=[Shutdown(reason="all is done")]),
    ]
    driver = Node(package="two_robots", executable="driver")
    later = TimerAction(period=3.0, actions=[ends])
    return LaunchDescription([*map(RegisterEventHandler, handlers), fails, driver, later])
"""
DESCRIPTION = f"<package format='3'><name>{NAME}</name><version>0.1.0</version></package>"
SPEEDS = """
/**:
  ros__parameters: {speed: 0.5}
/left/driver:
  ros__parameters: {speed: 9.0}
"""


def install(folder: Path) -> Path:
    """Write the package below a folder's install/; its prefix."""
    prefix = folder / "install" / NAME
    python = f"lib/python{sysconfig.get_python_version()}/site-packages/{NAME}"
    files = {
        f"share/ament_index/resource_index/packages/{NAME}": "",
        f"share/colcon-core/packages/{NAME}": "",
        f"share/{NAME}/package.xml": DESCRIPTION,
        f"share/{NAME}/launch/bringup.launch.py": BRINGUP,
        f"share/{NAME}/launch/bringup.launch.yaml": BRINGUP_YAML,
        f"share/{NAME}/launch/one.launch.py": ONE,
        f"share/{NAME}/launch/respawn.launch.py": RESPAWN,
        f"share/{NAME}/config/speeds.yaml": SPEEDS,
        f"{python}/__init__.py": "",
        f"{python}/driver.py": DRIVER,
        f"lib/{NAME}/driver": SCRIPT.format(python=sys.executable),
        f"lib/{NAME}/once": ONCE.format(python=sys.executable),
        f"lib/{NAME}/binary": "\x7fELF",
    }
    for name, text in files.items():
        file = prefix / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        file.chmod(0o755 if name.startswith(f"lib/{NAME}/") else 0o644)
    (folder / "install" / ".colcon_install_layout").write_text("isolated\n")
    return prefix


def sourced(prefix: Path) -> dict[str, str]:
    """What sourcing a workspace sets."""
    places = str(prefix), sys.prefix
    modules = prefix / f"lib/python{sysconfig.get_python_version()}/site-packages"
    return {"AMENT_PREFIX_PATH": os.pathsep.join(places), "PYTHONPATH": str(modules)}
