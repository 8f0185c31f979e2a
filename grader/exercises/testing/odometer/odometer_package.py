"""A package as a tutorial leaves it: its program is in scripts/, and its build prints warnings."""

import shutil
from collections.abc import Callable
from functools import partial
from pathlib import Path

from grader.companions.given_package import Fix, Folder, Move, fix_text, move_file, package_xml, write_package

XML = package_xml("odometer", "Meters from the ticks of a wheel", "rclpy", "std_msgs")
SETUP = """\
from setuptools import find_packages, setup

setup(
    name='odometer',
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/odometer']),
        ('share/odometer', ['package.xml']),
    ],
    install_requires=['setuptools'],
    tests_require=['pytest'],
    zip_safe=True,
    entry_points={
        'console_scripts': [
        ],
    },
)
"""
CFG = """\
[develop]
script-dir=$base/lib/odometer
[install]
install_scripts=$base/lib/odometer
"""
PROGRAM = """\
#!/usr/bin/env python3
import sys

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float64, Int32

sys.path.insert(0, "../helpers")
from encoder import meters


class Odometer(Node):
    def __init__(self):
        super().__init__("odometer")
        self.publisher = self.create_publisher(Float64, "distance", 10)
        self.create_subscription(Int32, "ticks", self.on_ticks, 10)

    def on_ticks(self, msg):
        self.publisher.publish(Float64(data=meters(msg.data)))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(Odometer())
"""
PER_TURN, AROUND = 360, 0.21  # ticks, m
HELPER = f"""\
PER_TURN = {PER_TURN}  # ticks
AROUND = {AROUND}  # m: the wheel's circumference


def meters(ticks):
    return AROUND * ticks / PER_TURN
"""
FILES = {
    "odometer/package.xml": XML,
    "odometer/setup.py": SETUP,
    "odometer/setup.cfg": CFG,
    "odometer/resource/odometer": "",
    "odometer/odometer/__init__.py": "",
    "odometer/scripts/odometer.py": PROGRAM,
    "odometer/helpers/encoder.py": HELPER,
}


def rearranged(workspace: Folder, rearrange: Callable[[Move, Fix], None]) -> Folder | None:
    """Write the package, let `rearrange` change it, and return the workspace; None if it isn't started.

    The package's folder is deleted first.
    rearrange: a function of `move`, which takes the path of a file and its new path, and of `fix`, which
    takes a file, a text that is in it once, and the text to replace it with. Paths are below the package.
    """
    folder = Path(workspace) / "src/odometer"
    shutil.rmtree(folder, ignore_errors=True)
    write_package(workspace, FILES)
    try:
        rearrange(partial(move_file, folder), partial(fix_text, folder))
    except NotImplementedError:
        return None
    return workspace
