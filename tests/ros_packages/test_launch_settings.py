"""What launch files set: environment variables and configurations, and remappings for a whole group."""

import pytest
from launch.actions import GroupAction, LogInfo, SetEnvironmentVariable
from launch.launch_context import LaunchContext
from launch.substitution import SubstitutionFailure
from launch.substitutions import EnvironmentVariable, ThisLaunchFileDir
from launch_ros.actions import Node, SetRemap

from tests.ros_packages.test_launch import log_of, logged
from tests.ros_packages.test_launch_xml import of_xml

NAME = "PATHS_OF_TEST"


def value():
    return LogInfo(msg=EnvironmentVariable(NAME, default_value="not set"))


def test_what_is_set_in_a_group_is_gone_after_it(monkeypatch):
    group = [SetEnvironmentVariable(NAME, "in it"), value()]
    assert log_of(GroupAction(group), value()) == [logged("in it"), logged("not set")]
    monkeypatch.setenv(NAME, "from the shell")
    without = GroupAction([value()], forwarding=False)
    assert log_of(*group, without) == [logged("in it"), logged("from the shell")]


def test_no_launch_file_has_no_folder():
    text = r"^ThisLaunchFileDir used outside of a launch file \(in a script\)$"
    with pytest.raises(SubstitutionFailure, match=text):
        ThisLaunchFileDir().perform(LaunchContext())


def remappings_of(log):
    """The remappings in the commands of nodes that died at once."""
    return [line.split("--ros-args")[1].strip(" ]'.") for line in log if "process has died" in line]


def dies(**more):
    return Node(executable="false", **more)


def test_a_remapping_is_for_all_later_nodes_of_its_group():
    group = GroupAction([SetRemap("scan", ["/", "front_scan"]), dies(remappings=[("odom", "pose")])])
    log = log_of(dies(), group, dies())
    assert sorted(remappings_of(log)) == ["", "", "-r scan:=/front_scan -r odom:=pose"]


def test_xml_remaps_all_nodes(tmp_path):
    text = '<launch><set_remap from="scan" to="front"/><node exec="false"/><log message="it"/></launch>'
    log = of_xml(tmp_path, text)
    assert remappings_of(log) == ["-r scan:=front"]
    assert log[0] == log_of(LogInfo(msg="it"))[0]
