"""ROS's shared libraries are loaded in a process that was started before its wheels were installed."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from sim import ros_libraries
from sim.ros_libraries import STARTED_AGAIN, VARIABLE, load_libraries, site_packages
from tests.patience import PATIENCE

ROOT = Path(__file__).parents[2]
RUN = """
import subprocess, sys
from sim import run
from rclpy.node import Node
from std_msgs.msg import String
from nav2_msgs.action import NavigateToPose

class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        publisher = self.create_publisher(String, "/chatter", 10)
        self.create_timer(1.0, lambda: publisher.publish(String(data="hello")))

print(len(run(Talker, seconds=3.5).messages("/chatter")), NavigateToPose.Goal.__name__)
child = [sys.executable, "-c", "import rclpy; rclpy.init(); print(rclpy.ok())"]
print(subprocess.check_output(child, text=True))
"""
SUPPORT = """
import importlib, sim
from sim.ros_libraries import site_packages

for file in sorted(site_packages().glob("*/*_s__rosidl_typesupport_c.*so")):
    for kind in "msg", "srv", "action":
        if (file.parent / kind).is_dir():
            module = importlib.import_module(f"{file.parent.name}.{kind}")
            first = next(vars(module)[name] for name in dir(module) if name[0].isupper())
            first.__import_type_support__()
            print(file.parent.name)
"""
FROM_WHEELS = pytest.mark.skipif(
    site_packages() is None or not (site_packages() / "ros_wheels_bootstrapper").is_dir(),
    reason="ROS is not from wheels here",
)


def started_before(program: str) -> subprocess.CompletedProcess:
    """Run a program as in a process that the linker's variable was not set for."""
    environment = {name: value for name, value in os.environ.items() if name != VARIABLE}
    command = [sys.executable, "-c", program]
    return subprocess.run(
        command,
        cwd=ROOT,
        env=environment | {STARTED_AGAIN: "1"},
        capture_output=True,
        text=True,
        timeout=PATIENCE,
    )


@FROM_WHEELS
def test_without_them_rclpy_cannot_be_imported():
    assert "cannot open shared object file" in started_before("import rclpy; rclpy.init()").stderr


@FROM_WHEELS
def test_nodes_run_and_child_processes_find_the_libraries_too():
    done = started_before(RUN)
    assert (done.stdout.split(), done.stderr) == (["3", "NavigateToPose_Goal", "True"], "")


@FROM_WHEELS
def test_the_messages_of_every_package_can_be_sent():
    done = started_before(SUPPORT)
    assert done.stderr == "" and {"rcl_interfaces", "sensor_msgs", "nav2_msgs"} <= set(done.stdout.split())


@FROM_WHEELS
def test_a_library_is_loaded_once_though_wheels_have_copies_of_it():
    """Two libraries of trace points with the same names end the process."""
    done = started_before("import sim, rclpy; print(open('/proc/self/maps').read())")
    assert set(re.findall(r"/(libtracetools\b.*)", done.stdout)) == {"libtracetools.so"}


@FROM_WHEELS
def test_nothing_is_loaded_where_the_linker_finds_them(monkeypatch):
    monkeypatch.setattr(ros_libraries, "_load", lambda library, known: pytest.fail("loaded again"))
    before = dict(os.environ)
    load_libraries()
    assert dict(os.environ) == before


def test_nothing_is_loaded_where_ros_is_not_from_wheels(monkeypatch, tmp_path):
    (tmp_path / "dist-packages" / "rclpy").mkdir(parents=True)
    monkeypatch.setattr(sys, "path", [str(tmp_path / "dist-packages")])
    monkeypatch.delenv(VARIABLE, raising=False)
    load_libraries()
    assert VARIABLE not in os.environ
    monkeypatch.setattr(sys, "path", [])
    load_libraries()
    assert VARIABLE not in os.environ


def test_what_cannot_be_loaded_is_left_to_rclpy_to_report(tmp_path):
    broken = tmp_path / "libbroken.so"
    broken.write_text("not a library")
    ros_libraries._load(broken, {"libbroken.so": broken})
