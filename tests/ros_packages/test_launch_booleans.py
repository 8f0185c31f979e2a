"""Substitutions that combine truth values, and remappings for all nodes of a group."""

import pytest
from launch import LaunchContext
from launch.actions import GroupAction, LogInfo
from launch.substitution import SubstitutionFailure
from launch.substitutions import (
    AllSubstitution,
    AndSubstitution,
    AnySubstitution,
    LaunchConfiguration,
    NotSubstitution,
    OrSubstitution,
)
from launch.yaml_frontend.substitutions import parse_substitution
from launch_ros.actions import Node, SetRemap

from tests.ros_packages.test_launch import log_of
from tests.ros_packages.test_launch_xml import of_xml

YES = LaunchConfiguration("yes")


@pytest.mark.parametrize(
    ("substitution", "text"),
    [
        (NotSubstitution("false"), "true"),
        (NotSubstitution([YES]), "false"),
        (AndSubstitution(YES, "true"), "true"),
        (AndSubstitution("true", "off"), "false"),
        (OrSubstitution("false", YES), "true"),
        (OrSubstitution("no", "False"), "false"),
        (AnySubstitution("false", "false", YES), "true"),
        (AnySubstitution(), "false"),
        (AllSubstitution("true", YES, "on"), "true"),
        (AllSubstitution("true", "false"), "false"),
    ],
)
def test_truth_values_are_combined(substitution, text):
    context = LaunchContext()
    context.launch_configurations["yes"] = "true"
    assert context.perform_substitution(substitution) == text


@pytest.mark.parametrize("kind", [AndSubstitution, OrSubstitution, AnySubstitution, AllSubstitution])
def test_what_is_no_truth_value_is_refused(kind):
    with pytest.raises(SubstitutionFailure) as refused:
        LaunchContext().perform_substitution(kind("true", "maybe"))
    assert str(refused.value) == "Failed to convert 'maybe' to '<class 'bool'>'"


def test_files_have_the_same():
    words = "$(not false) $(and true false) $(or true false) $(any false false) $(all true true true)"
    context = LaunchContext()
    assert "".join(map(context.perform_substitution, parse_substitution(words))) == (
        "true false true false true"
    )
    with pytest.raises(TypeError, match=r"^not substitution expects 1 argument\(s\), not 2$"):
        parse_substitution("$(not true false)")


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
