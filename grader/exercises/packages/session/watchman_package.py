"""A package that works: its program is operated from terminals, and what it offers is found by looking."""

from grader.companions.given_package import Folder, package_xml, stopping_main, write_package

NAME, NUMBER = "watchman", "7306"
XML = package_xml(
    NAME, "Patrols a room", "rclpy", "geometry_msgs", "sensor_msgs", "std_msgs", "std_srvs"
)
SETUP = """\
from setuptools import find_packages, setup

setup(
    name='watchman',
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/watchman']),
        ('share/watchman', ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    entry_points={'console_scripts': ['watch = watchman.watch:main']},
)
"""
WATCH = '''\
"""Drives ahead, and turns where something is near; it waits until it is called."""
import math
import signal
import time

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.signals import SignalHandlerOptions
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String
from std_srvs.srv import SetBool

NEAR = 0.6  # m


class Watchman(Node):
    def __init__(self):
        super().__init__("watchman")
        self.declare_parameter("pace", 0.1)  # m/s
        self.patrols = False
        self.commands = self.create_publisher(Twist, "drive", 10)
        self.badges = self.create_publisher(String, "~/badge", 10)
        self.create_subscription(LaserScan, "scan", self.on_scan, qos_profile_sensor_data)
        self.create_subscription(String, "logbook", self.on_entry, 10)
        self.create_service(SetBool, "~/patrol", self.on_patrol)
        self.create_timer(1.0, self.show_badge)

    def on_scan(self, scan):
        command = Twist()
        if self.patrols:
            angles = (scan.angle_min + i * scan.angle_increment for i in range(len(scan.ranges)))
            ahead = (r for angle, r in zip(angles, scan.ranges) if abs(math.remainder(angle, math.tau)) < 0.6)
            if min((r for r in ahead if not math.isnan(r)), default=math.inf) < NEAR:
                command.angular.z = 0.8
            else:
                command.linear.x = self.get_parameter("pace").value
        self.commands.publish(command)

    def on_patrol(self, request, response):
        self.patrols = request.data
        response.success, response.message = True, "on patrol" if request.data else "halted"
        return response

    def on_entry(self, msg):
        self.get_logger().info(f"logbook: {msg.data}")

    def show_badge(self):
        self.badges.publish(String(data="badge 7306"))


''' + stopping_main("Watchman")
CFG = "[develop]\nscript_dir=$base/lib/watchman\n[install]\ninstall_scripts=$base/lib/watchman\n"
FILES = {
    "watchman/package.xml": XML,
    "watchman/setup.py": SETUP,
    "watchman/setup.cfg": CFG,
    "watchman/resource/watchman": "",
    "watchman/watchman/__init__.py": "",
    "watchman/watchman/watch.py": WATCH,
}


def write_watchman(workspace: Folder) -> None:
    """Write the package into a workspace. Existing files are overwritten."""
    write_package(workspace, FILES)
