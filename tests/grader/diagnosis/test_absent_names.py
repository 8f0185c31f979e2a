"""Advice on modules, packages and commands that are not there, with the exact sentences."""

import importlib.util
import re
import subprocess
import sys
from pathlib import Path

import pytest

from grader.diagnosis import find_fault
from grader.diagnosis.error_advice import advice
from sim import absent_packages, executable, run
from sim.absent_packages import explain
from sim.evidence import CallbackError
from sim.ros.bundled_programs import PROGRAMS
from sim.ros.packages import PackageNotFound, packages
from tests.sim.ros.test_packages import VALID

SCIPY = (
    "`scipy` is a Python package that is not installed here: `%pip install scipy` in a cell installs it. "
    "It is available for marking only if the instructor installs it, too."
)
CV_BRIDGE = (
    "`cv_bridge` (converts between ROS images and OpenCV's arrays) is a ROS package that the course does not "
    "include. np.frombuffer(msg.data, np.uint8).reshape(msg.height, msg.width, -1) is the array of an rgb8, bgr8 "
    "or mono8 image."
)
XACRO = (
    "The course has no ROS package `xacro`, and `%pip install xacro` installs none. If that installs a program "
    "`xacro`, start it by its name: `$(command 'xacro FILE')` in XML or YAML, `Command([\"xacro \", FILE])` in "
    "Python."
)
NAV2 = "`nav2_bringup` (starts Nav2) is a ROS package that the course does not include."


def missing_module(name: str) -> CallbackError:
    return CallbackError(0.0, "/n", "main", "ModuleNotFoundError", f"No module named '{name}'", "")


@pytest.mark.parametrize(
    ("name", "sentence"),
    {
        "scipy": SCIPY,
        "scipy.spatial": SCIPY,
        "cv2": SCIPY.replace("`scipy`", "`cv2`").replace("install scipy", "install opencv-python-headless"),
        "py_trees": SCIPY.replace("`scipy`", "`py_trees`").replace("install scipy", "install py-trees"),
        "xacro": SCIPY.replace("scipy", "xacro"),
        "cv_bridge": CV_BRIDGE,
        "rospy": "`rospy` is a package of ROS 1. ROS 2 has rclpy.",
        "tf": "`tf` is a package of ROS 1. ROS 2 has tf2_ros, and tf_transformations for tf.transformations.",
        "launch_testing": "`launch_testing` (tests of launch files) is a ROS package that the course does not "
        "include. launch_pytest is here and does the same for pytest.",
        "moveit_commander": "`moveit_commander` is a package of ROS 1. ROS 2 has moveit, a package of MoveIt 2 that "
        "the course does not include.",
        "qwertz_lib": "Python can't find a module `qwertz_lib`. Is it a file of yours? It has to be in the folder of "
        "the program, or in a package that is built and sourced. Is it a ROS package? The course does not include "
        "it: its source has to be in a workspace's src. Is it on PyPI? `%pip install` in a cell installs it.",
        "std_msg": "Python can't find a module `std_msg`: check its spelling. Message packages end in `_msgs` and "
        "`.msg`, as in `from std_msgs.msg import String`.",
    }.items(),
)
def test_a_missing_module_is_explained(name, sentence):
    assert advice(missing_module(name)) == sentence


def test_a_cpp_package_is_explained():
    assert explain("rclcpp") == (
        "`rclcpp` (ROS's library for C++) is a ROS package that the course does not include. "
        "C++ nodes are not built here."
    )


def test_a_node_that_imports_one_gets_the_explanation():
    def main():
        import cv_bridge  # noqa: F401

    assert find_fault(run(main, seconds=1, quiet=True)).hint == CV_BRIDGE


@pytest.mark.parametrize(
    ("entity", "hint"),
    {
        'Node(package="nav2_bringup", executable="x")': NAV2,
        'Node(package="zzz", executable="x")': "No package `zzz` is installed, and no workspace that has it was "
        "sourced: check its spelling.",
        'LogInfo(msg=Command(["xacro ", "robot.urdf.xacro"]))': SCIPY.replace("scipy", "xacro"),
        'LogInfo(msg=get_package_share_directory("nav2_bringup"))': NAV2,
        'LogInfo(msg=get_package_share_directory("xacro"))': XACRO,
        'Node(package="xacro", executable="xacro")': XACRO,
    }.items(),
)
def test_packages_and_commands_in_launch_files_are_explained(entity, hint, tmp_path):
    path = tmp_path / "it.launch.py"
    path.write_text(
        "from ament_index_python.packages import get_package_share_directory\n"
        "from launch import LaunchDescription\n"
        "from launch.actions import LogInfo\n"
        "from launch.substitutions import Command\n"
        "from launch_ros.actions import Node\n\n\n"
        f"def generate_launch_description():\n    return LaunchDescription([{entity}])\n"
    )
    assert find_fault(run(path, seconds=1, quiet=True)).hint == hint


def test_ros2_run_explains_a_package():
    with pytest.raises(PackageNotFound, match=f"^Package 'xacro' not found: {re.escape(XACRO)}$"):
        executable("xacro", "xacro")
    with pytest.raises(PackageNotFound, match=f"^Package 'nav2_bringup' not found: {re.escape(NAV2)}$"):
        executable("nav2_bringup", "x")


def test_interfaces_that_were_not_built_or_not_sourced_are_named(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "ws/src/my_interfaces").mkdir(parents=True)
    (tmp_path / "ws/src/my_interfaces/package.xml").write_text(VALID.format("my_interfaces"))
    error = missing_module("my_interfaces")
    assert advice(error) == "Package `my_interfaces`: it is in ws/src but not built: run colcon build in ws."
    (tmp_path / "ws/install").mkdir()
    (tmp_path / "ws/install/.colcon_install_layout").write_text("isolated\n")
    index = tmp_path / "ws/install/my_interfaces/share/ament_index/resource_index/packages"
    index.mkdir(parents=True)
    (index / "my_interfaces").write_text("")
    assert advice(error) == (
        "Package `my_interfaces`: it is built but not sourced: `source ws/install/setup.bash` in a terminal, "
        "`source('ws/install/setup.bash')` in a notebook."
    )


def test_every_row_has_a_source_and_no_name_is_in_two_tables():
    table = absent_packages.table()
    assert set(table) == {"ros", "pypi", "ros1"}
    assert all(row["source"].startswith("https://") for row in table["ros"].values())
    names = [name for rows in table.values() for name in rows]
    assert sorted(set(names)) == sorted(names)
    assert {key for row in table["ros"].values() for key in row} <= {"about", "instead", "cpp", "source"}


def test_no_row_names_a_package_that_the_course_has():
    table = absent_packages.table()
    assert not {*packages(), *PROGRAMS} & {*table["ros"], *table["ros1"]}
    assert [name for name in (*table["ros"], *table["ros1"]) if importlib.util.find_spec(name)] == []


def test_ros2_launch_explains_a_package(tmp_path):
    path = tmp_path / "it.launch.py"
    node = 'Node(package="nav2_bringup", executable="x")'
    path.write_text(
        "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
        f"def generate_launch_description():\n    return LaunchDescription([{node}])\n"
    )
    ros2 = Path(sys.executable).with_name("ros2")
    done = subprocess.run([ros2, "launch", path], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr.splitlines()[-1]) == (1, NAV2)


@pytest.mark.parametrize(
    ("inside", "hint"),
    {
        '<node pkg="demo_nodes_py" exec="talkr"/>': "Write `talker` in the place of `talkr`.",
        '<node pkg="tf2_tools" exec="view_frames"/>': "The course has no such program. Its error says what to use in "
        "its place.",
        '<let name="x"/>': "`let` needs `value`, on the line of the launch file that the error names.",
        "<log message=\"$(command 'xacro a')\"/>": SCIPY.replace("scipy", "xacro"),
        "<log message=\"$(command '$(exec-in-pkg xacro xacro) a')\"/>": XACRO,
        '<include file="$(dirname)/ohter.launch.xml"/>': "There is no file `FOLDER/ohter.launch.xml`. Did you mean "
        "'other.launch.xml'?",
        '<include file="/share/a/launch/b.launch.py"/>': "There is no file `/share/a/launch/b.launch.py`. A launch "
        "file of a package has to be installed: its setup.py or CMakeLists.txt names it.",
    }.items(),
)
def test_a_mistake_in_a_launch_file_is_explained(inside, hint, tmp_path):
    for name, content in {"it": inside, "other": ""}.items():
        (tmp_path / f"{name}.launch.xml").write_text(f"<launch>{content}</launch>")
    found = find_fault(run(tmp_path / "it.launch.xml", seconds=1, quiet=True))
    assert found.hint == hint.replace("FOLDER", str(tmp_path))
