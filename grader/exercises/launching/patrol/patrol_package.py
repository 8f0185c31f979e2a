"""A package with six faults. How it should be is nowhere in what students get."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

from grader.companions.given_package import Fix, Folder, fix_text, stopping_main, write_package

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
import signal
import time

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

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


""" + stopping_main("Driver")
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
    write_package(workspace, FILES)
    try:
        repair(partial(fix_text, Path(workspace) / "src/patrol"))
    except NotImplementedError:
        return None
    return workspace
