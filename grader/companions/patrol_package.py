"""A broken package: as it should be, the faults that it may have, and one with six of them."""

import functools
import os
import random
from collections.abc import Callable, Mapping
from pathlib import Path

FAULTY = 6
Folder = str | os.PathLike[str]
Fix = Callable[[str, str, str], None]

XML = """\
<?xml version="1.0"?>
<package format="3">
  <name>patrol</name>
  <version>0.0.0</version>
  <description>Drives ahead, at a speed that can be set</description>
  <maintainer email="you@example.org">you</maintainer>
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
        ('share/' + package_name, ['package.xml']),
        ('share/' + package_name + '/launch', glob('launch/*')),
        ('share/' + package_name + '/config', glob('config/*')),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    entry_points={
        'console_scripts': [
            'patrol = patrol.driver:main',
        ],
    },
)
"""
CFG = """\
[develop]
script_dir=$base/lib/patrol
[install]
install_scripts=$base/lib/patrol
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
  ros__parameters:
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

# The file, the right text, and the wrong one. Each fault shows when those before it are fixed.
FAULTS = (
    ("patrol/package.xml", "</maintainer>", ""),
    ("patrol/package.xml", "  <depend>geometry_msgs</depend>\n", ""),
    ("patrol/setup.py", "find_packages(exclude=['test'])", "[]"),
    ("patrol/setup.py", "['package.xml']),", "['package.xml'])"),
    ("patrol/setup.py", "'patrol = patrol.driver:main'", "'patrol = patrol.driver:mian'"),
    ("patrol/setup.py", "['resource/' + package_name]", "['resource/partol']"),
    ("patrol/setup.py", "        ('share/' + package_name + '/launch', glob('launch/*')),\n", ""),
    ("patrol/setup.cfg", "install_scripts=$base/lib/patrol", "install_scripts=$base/bin"),
    ("patrol/patrol/driver.py", "from patrol.speeds import", "from speeds import"),
    ("patrol/launch/patrol.launch.py", 'executable="patrol"', 'executable="driver"'),
    ("patrol/config/patrol.yaml", "ros__parameters", "ros_parameters"),
    ("patrol/config/patrol.yaml", "speed: 0.15", "speed: 1"),
)


def broken(workspace: Folder, number: int) -> None:
    """Write the package patrol into a workspace, with six faults that this number selects.

    Existing files are overwritten.
    """
    for path, text in faulty(number).items():
        file = Path(workspace) / "src" / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")


def repaired(workspace: Folder, number: int, repair: Callable[[Fix], None]) -> Folder | None:
    """Write the broken package, let `repair` fix it, and return the workspace; None if it isn't started.

    repair: a function of `fix`, which takes a file of the package, such as "setup.py", a text that is in it
    once, and the text to replace it with.
    """
    broken(workspace, number)
    try:
        repair(functools.partial(_fix, workspace))
    except NotImplementedError:
        return None
    return workspace


def faulty(number: int) -> dict[str, str]:
    """Return the files of the package with six faults: path below src/ to text."""
    files = dict(FILES)
    for path, right, wrong in random.Random(f"faults {number}").sample(FAULTS, FAULTY):
        files[path] = files[path].replace(right, wrong)
    return files


def with_one_fault_less(sources: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return the file with the last fault that is left, corrected; nothing for other numbers of faults."""
    left = [fault for fault in FAULTS if _is_left(sources, *fault)]
    if len(left) != 1:
        return {}
    path, right, wrong = left[0]
    text = sources[path].decode("utf-8", "replace")
    if wrong:
        return {path: text.replace(wrong, right).encode()}
    before = FILES[path].partition(right)[0].rpartition("\n  ")[2]
    return {path: text.replace(before, before + right, 1).encode()}


def _is_left(sources: Mapping[str, bytes], path: str, right: str, wrong: str) -> bool:
    text = sources.get(path, b"").decode("utf-8", "replace")
    return bool(text) and right not in text and (not wrong or wrong in text)


def _fix(workspace: Folder, file: str, old: str, new: str) -> None:
    """Raises ValueError where the file has no `old`, or more than one, and FileNotFoundError for no file."""
    path = Path(workspace) / "src" / "patrol" / file
    text = path.read_text(encoding="utf-8")
    if text.count(old) != 1:
        raise ValueError(f"{file} has {text.count(old)} times {old!r}: give a text that it has once.")
    path.write_text(text.replace(old, new), encoding="utf-8")
