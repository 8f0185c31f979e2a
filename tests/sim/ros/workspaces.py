"""A workspace of packages that `ros2 pkg create` made and colcon built."""

import os
import shlex
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from sim.ros2 import parser

COLCON = Path(sys.executable).with_name("colcon")
TALKER = """\
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

from my_pkg.words import HELLO


class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.create_timer(0.5, lambda: self.publisher.publish(String(data=HELLO)))


def main():
    rclpy.init()
    rclpy.spin(Talker())
"""
BEEP = "#!/usr/bin/env python3\nfrom tone import HERTZ\nprint(f'beep at {HERTZ} Hz')\n"


GENERATE = """\
find_package(rosidl_default_generators REQUIRED)
rosidl_generate_interfaces(${PROJECT_NAME}
  "msg/Level.msg" "srv/Ask.srv" "action/Act.action"
  DEPENDENCIES geometry_msgs)
ament_export_dependencies(rosidl_default_runtime)
"""
MEMBER = """\
  <buildtool_depend>rosidl_default_generators</buildtool_depend>
  <exec_depend>rosidl_default_runtime</exec_depend>
  <member_of_group>rosidl_interface_packages</member_of_group>
"""
DEFINITIONS = {
    "msg/Level.msg": "float64 level\nstring name\ngeometry_msgs/Point place\n",
    "srv/Ask.srv": "int64 a\n---\nint64 b\n",
    "action/Act.action": "int64 order\n---\nint64 result\n---\nint64 step\n",
}


@contextmanager
def as_it_was() -> Iterator[None]:
    """Undo what `source` changes, at the end."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "path", list(sys.path))
        for name in ("AMENT_PREFIX_PATH", "PATH"):
            patch.setenv(name, os.environ[name])
        for name in ("PYTHONPATH", "LD_LIBRARY_PATH", "COLCON_PREFIX_PATH", "CMAKE_PREFIX_PATH"):
            patch.setenv(name, os.environ.get(name, ""))
        yield


def create(folder: Path, line: str) -> None:
    """Say `ros2 pkg create ...` in a folder."""
    asked = ["pkg", "create", *shlex.split(line)]
    at = ["--destination-directory", str(folder)]
    assert parser.execute(parser.make_parser(), [*asked, *at], None, lambda _: None, print) == 0


def build(workspace: Path, *options: str) -> str:
    """Say `colcon build ...` in a workspace; what it says."""
    outside = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    output = subprocess.PIPE, subprocess.STDOUT
    done = subprocess.run(
        [COLCON, "build", *options], cwd=workspace, env=outside, text=True, stdout=output[0], stderr=output[1]
    )
    assert done.returncode == 0, done.stdout
    return done.stdout


def with_programs(workspace: Path) -> None:
    """Write a package with an entry point, an own module and scripts, and one whose program gets lost."""
    sources = workspace / "src"
    sources.mkdir(parents=True)
    create(sources, "my_pkg --build-type ament_python --node-name talker --dependencies rclpy std_msgs")
    package = sources / "my_pkg"
    (package / "my_pkg" / "talker.py").write_text(TALKER)
    (package / "my_pkg" / "words.py").write_text("HELLO = 'hello'\n")
    (package / "scripts").mkdir()
    for name, text in {"beep": BEEP, "tone.py": "HERTZ = 440\n", "shell": "#!/bin/sh\n"}.items():
        (package / "scripts" / name).write_text(text)
        (package / "scripts" / name).chmod(0o644 if name == "tone.py" else 0o755)
    setup = package / "setup.py"
    files = "        ('lib/' + package_name, ['scripts/beep', 'scripts/tone.py', 'scripts/shell']),\n"
    setup.write_text(setup.read_text().replace("    ],\n    install", f"{files}    ],\n    install"))
    create(sources, "lost --build-type ament_python --node-name stray")
    (sources / "lost" / "setup.cfg").unlink()


def with_interfaces(workspace: Path) -> Path:
    """Write a package of a message, a service and an action; its folder."""
    sources = workspace / "src"
    sources.mkdir(parents=True)
    create(sources, "my_interfaces --dependencies geometry_msgs")
    package = sources / "my_interfaces"
    for name, text in DEFINITIONS.items():
        (package / name).parent.mkdir()
        (package / name).write_text(text)
    after = {"CMakeLists.txt": ("\nif(BUILD", GENERATE), "package.xml": ("\n  <export>", MEMBER)}
    for name, (line, more) in after.items():
        text = (package / name).read_text()
        (package / name).write_text(text.replace(line, f"\n{more}{line}"))
    return package
