"""Packages for packages.greeter: right ones in three styles, then wrong ones, each named by its defect."""

from tests.students.workspaces import Workspace, changed, package

PARTS = ("NODE", "PLAIN", "RIGHT", "ELSEWHERE", "WHOLE")
NODE = """\
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Hello(Node):
    def __init__(self):
        super().__init__("hello")
        self.count = 0
        self.publisher = self.create_publisher(String, "greeting", 10)
        self.create_timer(0.5, self.say)

    def say(self):
        self.count += 1
        self.publisher.publish(String(data=f"hello {self.count}"))


def main():
    rclpy.init()
    rclpy.spin(Hello())
"""
PLAIN = """\
import time

import rclpy
import std_msgs.msg


def run():
    rclpy.init()
    node = rclpy.create_node("plain")
    publisher = node.create_publisher(std_msgs.msg.String, "/greeting", 10)
    number = 1
    while rclpy.ok():
        time.sleep(0.5)
        publisher.publish(std_msgs.msg.String(data=f"hello {number}"))
        number += 1
"""
RIGHT = package("greeter", "'hello = greeter.hello:main'", "rclpy std_msgs", {"greeter/hello.py": NODE})
WHOLE = "greeter/setup.py", "greeter/package.xml", "greeter/setup.cfg", "greeter/greeter/hello.py"

Greeter = Workspace(__name__, RIGHT)
WithALoop = Workspace(  # a design of its own
    __name__, package("greeter", "'hello=greeter.deep.plain:run'", "rclpy std_msgs",
                      {"greeter/deep/__init__.py": "", "greeter/deep/plain.py": PLAIN})
)  # fmt: skip
WithExecDepend = Workspace(
    __name__,
    changed(changed(RIGHT, WHOLE[1], "<depend>", "<exec_depend>"), WHOLE[1], "</depend>", "</exec_depend>"),
)
NoPackageXml = Workspace(__name__, changed(RIGHT, WHOLE[1]))
NoSetup = Workspace(__name__, changed(RIGHT, WHOLE[0]))
NoMarker = Workspace(
    __name__,
    changed(RIGHT, WHOLE[0], "('share/ament_index/resource_index/packages', ['resource/greeter']),", ""),
)
MarkerIsNotThere = Workspace(__name__, changed(RIGHT, "greeter/resource/greeter"))
BrokenXml = Workspace(__name__, changed(RIGHT, WHOLE[1], "</name>", "</nam>"))
OtherName = Workspace(__name__, changed(RIGHT, WHOLE[1], "<name>greeter", "<name>rclpy"))
WithEntities = Workspace(
    __name__, changed(RIGHT, WHOLE[1], "<package", "<!DOCTYPE x [<!ENTITY a 'aa'>]>\n<package")
)
IsCmake = Workspace(__name__, changed(RIGHT, WHOLE[1], "ament_python", "ament_cmake"))
NoBuildType = Workspace(__name__, changed(RIGHT, WHOLE[1], "<build_type>ament_python</build_type>", ""))
SetupDoesNotParse = Workspace(__name__, changed(RIGHT, WHOLE[0], "version='0.0.0',", "version='0.0.0'"))
SetupRaises = Workspace(__name__, changed(RIGHT, WHOLE[0], "setup(\n", "setup(\n    title=package_nam,\n"))
ModuleDoesNotParse = Workspace(__name__, changed(RIGHT, WHOLE[3], "def main():", "def main()"))
NoEntryPoint = Workspace(__name__, changed(RIGHT, WHOLE[0], "'hello = greeter.hello:main'", ""))
EntryPointWithoutName = Workspace(__name__, changed(RIGHT, WHOLE[0], "hello = greeter", "greeter"))
NoFunction = Workspace(__name__, changed(RIGHT, WHOLE[0], "greeter.hello:main", "greeter.hello"))
MisspeltMain = Workspace(__name__, changed(RIGHT, WHOLE[0], "greeter.hello:main", "greeter.hello:mian"))
MisspeltCommand = Workspace(__name__, changed(RIGHT, WHOLE[0], "hello = greeter", "helo = greeter"))
NoNeeds = Workspace(__name__, changed(RIGHT, WHOLE[1], "  <depend>std_msgs</depend>\n", ""))
NoDescription = Workspace(__name__, changed(RIGHT, WHOLE[0], "('share/greeter', ['package.xml']),", ""))
OtherTopic = Workspace(__name__, changed(RIGHT, WHOLE[3], '"greeting"', '"hello"'))
OnceASecond = Workspace(__name__, changed(RIGHT, WHOLE[3], "0.5, self", "1.0, self"))
CountsFromZero = Workspace(__name__, changed(RIGHT, WHOLE[3], "self.count = 0", "self.count = -1"))
PointsOutside = Workspace(__name__, changed(RIGHT, WHOLE[0], "greeter.hello:main", "platform:system"))
ModuleNamedRclpy = Workspace(
    __name__, changed(RIGHT, "greeter/rclpy/__init__.py", new="raise RuntimeError('not the real one')\n")
)
ThousandsOfFiles = Workspace(__name__, {**RIGHT, **{f"greeter/data/f{n}": "" for n in range(3000)}})
TenMegabytes = Workspace(__name__, {**RIGHT, "greeter/data/map": b"0" * 10_000_000})
NotStarted = Workspace(
    __name__, changed(RIGHT, WHOLE[0], "setup(\n", "raise NotImplementedError()\nsetup(\n")
)
ImportsByAFunction = Workspace(
    __name__,
    changed(
        changed(RIGHT, WHOLE[1], "  <depend>rclpy</depend>\n  <depend>std_msgs</depend>\n", ""),
        WHOLE[3],
        "",
        "from importlib import import_module\n\nrclpy = import_module('rc' 'lpy')\n"
        "Node = import_module('rclpy.node').Node\nString = import_module('std_' + 'msgs.msg').String\n"
        + NODE.partition("String\n")[2],
    ),
)
PrintsALot = Workspace(
    __name__,
    changed(
        changed(RIGHT, WHOLE[0], "('share/greeter', ['package.xml']),", ""),
        WHOLE[0],
        "from glob import glob",
        "import sys\nfrom glob import glob\n\nsys.stderr.write('no matter\\n' * 30000)",
    ),
)
EmptyMain = Workspace(
    __name__, changed(RIGHT, WHOLE[3], "    rclpy.init()\n    rclpy.spin(Hello())\n", "    pass\n")
)
