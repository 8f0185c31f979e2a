"""What a process that imports sim finds in its environment."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.patience import PATIENCE

REPOSITORY = Path(__file__).resolve().parents[2]
FIND = """
import os, sys, sim
from ament_index_python import get_package_share_directory
print(os.environ["AMENT_PREFIX_PATH"])
print(get_package_share_directory(sys.argv[1]))
"""


def found(package: str, **variables: str) -> list[str]:
    """AMENT_PREFIX_PATH of a fresh process that imports sim, and where that process finds a ROS package."""
    inherited = {name: value for name, value in os.environ.items() if name != "AMENT_PREFIX_PATH"}
    command = [sys.executable, "-c", FIND, package]
    environment = inherited | variables
    return subprocess.check_output(
        command, cwd=REPOSITORY, env=environment, text=True, timeout=PATIENCE
    ).splitlines()


@pytest.mark.parametrize("package", ["sensor_msgs", "nav2_msgs"])
def test_ros_packages_from_wheels_and_from_interfaces_are_found(package):
    assert found(package) == [sys.prefix, f"{sys.prefix}/share/{package}"]


def test_the_prefixes_of_a_ros_installation_are_left_alone(tmp_path):
    marker = tmp_path / "share" / "ament_index" / "resource_index" / "packages" / "turtlesim"
    marker.parent.mkdir(parents=True)
    marker.touch()
    prefixes = f"{tmp_path}:/opt/ros/jazzy"
    assert found("turtlesim", AMENT_PREFIX_PATH=prefixes) == [prefixes, f"{tmp_path}/share/turtlesim"]


def test_the_commands_of_the_environment_are_found_once():
    look = "import os, sim; sim.ros_environment.prepare(); print(os.environ['PATH'])"
    command = [sys.executable, "-c", look]
    output = subprocess.check_output(
        command, cwd=REPOSITORY, env={**os.environ, "PATH": "/usr/bin:/bin"}, text=True, timeout=PATIENCE
    )
    assert output == f"{sys.prefix}/bin:/usr/bin:/bin\n"
