"""A package with six faults. How it should be is nowhere in what students get."""

import functools
import os
from collections.abc import Callable
from pathlib import Path

Folder = str | os.PathLike[str]
Fix = Callable[[str, str, str], None]

XML = """\
<?xml version="1.0"?>
<package format="3">
  <name>patrol</name>
  <version>0.0.0</version>
  <description>Drives ahead, at a speed that can be set</description>
  <maintainer email="you@example.org">you
  <license>Apache-2.0</license>

  <depend>rclpy</depend>
  <depend>geometry_msgs</depend>
  <exec_depend>launch</exec_depend>
  <exec_depend>launch_ros</exec_depend>

  <export>
    <build_type>ament_python</build_type>
  </export>
</package>
"""
SETUP = """\
from glob import glob

from setuptools import find_packages, setup

package_name = 'patrol'

setup(
    name=package_name,
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml'])
        ('share/' + package_name + '/config', glob('config/*')),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    entry_points={
        'console_scripts': [
            'patrol = patrol.driver:mian',
        ],
    },
)
"""
CFG = """\
[develop]
script_dir=$base/lib/patrol
[install]
install_scripts=$base/bin
"""
DRIVER = """\
import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node

from patrol.speeds import USUAL


class Driver(Node):
    def __init__(self):
        super().__init__("driver")
        self.declare_parameter("speed", USUAL)  # m/s
        self.commands = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_timer(0.1, self.drive)

    def drive(self):
        command = Twist()
        command.linear.x = self.get_parameter("speed").value
        self.commands.publish(command)


def main():
    rclpy.init()
    rclpy.spin(Driver())
"""
LAUNCH = """\
from launch import LaunchDescription
from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    settings = PathJoinSubstitution([FindPackageShare("patrol"), "config", "patrol.yaml"])
    return LaunchDescription([
        Node(package="patrol", executable="patrol", namespace="scout", parameters=[settings]),
    ])
"""
YAML = """\
/**:
  ros_parameters:
    speed: 0.15
"""
FILES = {
    "patrol/package.xml": XML,
    "patrol/setup.py": SETUP,
    "patrol/setup.cfg": CFG,
    "patrol/resource/patrol": "",
    "patrol/patrol/__init__.py": "",
    "patrol/patrol/driver.py": DRIVER,
    "patrol/patrol/speeds.py": "USUAL = 0.2  # m/s\n",
    "patrol/launch/patrol.launch.py": LAUNCH,
    "patrol/config/patrol.yaml": YAML,
}


def repaired(workspace: Folder, repair: Callable[[Fix], None]) -> Folder | None:
    """Write the broken package, let `repair` fix it, and return the workspace; None if it isn't started.

    Existing files are overwritten.
    repair: a function of `fix`, which takes a file of the package, such as "setup.py", a text that is in it
    once, and the text to replace it with.
    """
    for path, text in FILES.items():
        file = Path(workspace) / "src" / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
    try:
        repair(functools.partial(_fix, workspace))
    except NotImplementedError:
        return None
    return workspace


def _fix(workspace: Folder, file: str, old: str, new: str) -> None:
    """Raises ValueError where the file has no `old`, or more than one, and FileNotFoundError for no file."""
    path = Path(workspace) / "src" / "patrol" / file
    text = path.read_text(encoding="utf-8")
    if text.count(old) != 1:
        raise ValueError(f"{file} has {text.count(old)} times {old!r}: give a text that it has once.")
    path.write_text(text.replace(old, new), encoding="utf-8")
