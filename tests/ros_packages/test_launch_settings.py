"""What launch files set, add to and remove: configurations and environment variables."""

import re

import pytest
from launch.actions import (
    AppendEnvironmentVariable,
    GroupAction,
    IncludeLaunchDescription,
    LogInfo,
    OpaqueFunction,
    ResetEnvironment,
    ResetLaunchConfigurations,
    SetEnvironmentVariable,
    SetLaunchConfiguration,
    UnsetEnvironmentVariable,
    UnsetLaunchConfiguration,
)
from launch.conditions import LaunchConfigurationEquals, LaunchConfigurationNotEquals
from launch.launch_context import LaunchContext
from launch.substitution import SubstitutionFailure
from launch.substitutions import (
    EnvironmentVariable,
    FileContent,
    IfElseSubstitution,
    LaunchConfiguration,
    ThisLaunchFile,
)

from tests.ros_packages.test_launch import log_of, logged
from tests.ros_packages.test_launch_xml import of_xml

NAME = "PATHS_OF_TEST"


def value(name=NAME):
    return LogInfo(msg=EnvironmentVariable(name, default_value="not set"))


@pytest.mark.parametrize(
    ("given", "found"),
    [
        ({}, "old:new"),
        ({"prepend": True}, "new:old"),
        ({"prepend": "true", "separator": ", "}, "new, old"),
        ({"prepend": LaunchConfiguration("first", default="false")}, "old:new"),
    ],
)
def test_a_value_is_added_to_an_environment_variable(given, found):
    add = AppendEnvironmentVariable(NAME, "new", **given)
    assert log_of(SetEnvironmentVariable(NAME, "old"), add, value()) == [logged(found)]
    assert log_of(add, value()) == [logged("new")]


def test_what_is_added_in_a_group_is_gone_after_it():
    group = GroupAction([AppendEnvironmentVariable(NAME, "in it"), value()])
    assert log_of(group, value()) == [logged("in it"), logged("not set")]


def test_environment_variables_are_removed_and_come_back(monkeypatch):
    monkeypatch.setenv(NAME, "from the shell")
    new = SetEnvironmentVariable("NEW_OF_TEST", "1")
    lines = log_of(
        *(new, UnsetEnvironmentVariable(NAME), UnsetEnvironmentVariable("NONE_OF_TEST"), value()),
        *(ResetEnvironment(), value(), value("NEW_OF_TEST")),
    )
    assert lines == [logged("not set"), logged("from the shell"), logged("not set")]


def test_launch_configurations_are_removed():
    def names(context):
        return [LogInfo(msg=" ".join(f"{key}={text}" for key, text in context.launch_configurations.items()))]

    settings = [SetLaunchConfiguration("a", "1"), SetLaunchConfiguration("b", "2")]
    here = OpaqueFunction(function=names)
    kept = ResetLaunchConfigurations({"c": [LaunchConfiguration("a"), "0"]})
    removed = [UnsetLaunchConfiguration("a"), UnsetLaunchConfiguration("x")]
    assert log_of(*settings, *removed, here) == [logged("b=2")]
    assert log_of(*settings, ResetLaunchConfigurations(), here) == [logged("")]
    assert log_of(*settings, kept, here) == [logged("c=10")]


@pytest.mark.parametrize(
    ("condition", "expected", "holds"),
    [
        (LaunchConfigurationEquals, "anna", True),
        (LaunchConfigurationEquals, ["an", "na"], True),
        (LaunchConfigurationEquals, "berta", False),
        (LaunchConfigurationEquals, None, False),
        (LaunchConfigurationNotEquals, "berta", True),
        (LaunchConfigurationNotEquals, "anna", False),
        (LaunchConfigurationNotEquals, None, True),
    ],
)
def test_old_conditions_hold_and_are_deprecated(condition, expected, holds):
    text = rf"^{condition.__name__} is deprecated\. Use IfCondition with an EqualsSubstitution or a NotEquals"
    with pytest.warns(UserWarning, match=text):
        action = LogInfo(msg="done", condition=condition("robot", expected))
    assert log_of(SetLaunchConfiguration("robot", "anna"), action) == [logged("done")] * holds


def test_a_configuration_that_is_not_set_equals_none():
    with pytest.warns(UserWarning):
        actions = [
            LogInfo(msg=kind.__name__, condition=kind("robot", None))
            for kind in (LaunchConfigurationEquals, LaunchConfigurationNotEquals)
        ]
    assert log_of(*actions) == [logged("LaunchConfigurationEquals")]


def test_a_text_depends_on_a_condition():
    context = LaunchContext()
    assert IfElseSubstitution("true", "yes", "no").perform(context) == "yes"
    assert IfElseSubstitution("False", "yes", "no").perform(context) == "no"
    assert IfElseSubstitution("false", "yes").perform(context) == ""
    with pytest.raises(SubstitutionFailure, match=r"^Failed to convert 'perhaps' to '<class 'bool'>'$"):
        IfElseSubstitution("perhaps", "yes").perform(context)
    with pytest.raises(RuntimeError, match=r"^One of if_value and else_value must be specified$"):
        IfElseSubstitution("true")


def test_a_file_is_read(tmp_path):
    file = tmp_path / "robot.urdf"
    file.write_text("<robot/>")
    assert FileContent([str(tmp_path), "/robot.urdf"]).perform(LaunchContext()) == "<robot/>"
    none = str(tmp_path / "none")
    with pytest.raises(SubstitutionFailure, match=f"^File not found: {re.escape(none)}$"):
        FileContent(none).perform(LaunchContext())


def test_no_launch_file_has_no_path():
    text = r"^ThisLaunchFile used outside of a launch file \(in a script\)$"
    with pytest.raises(SubstitutionFailure, match=text):
        ThisLaunchFile().perform(LaunchContext())


def test_xml_has_these_too(tmp_path):
    (tmp_path / "text").write_text("read")
    lines = of_xml(
        tmp_path,
        """
        <launch>
          <set_env name="PATHS_OF_TEST" value="a"/>
          <append_env name="PATHS_OF_TEST" value="b" prepend="true" separator="-"/>
          <append_env name="PATHS_OF_TEST" value="c" unless="true"/>
          <log message="$(env PATHS_OF_TEST) $(file-content $(dirname)/text) $(filename)"/>
          <unset_env name="PATHS_OF_TEST"/>
          <log message="$(env PATHS_OF_TEST no) $(if true this that) $(if false this)"/>
          <set_env name="PATHS_OF_TEST" value="a"/>
          <reset_env/>
          <let name="robot" value="anna"/>
          <reset><keep name="kept" value="$(var robot)"/></reset>
          <log message="$(env PATHS_OF_TEST no) $(var robot none) $(var kept)"/>
        </launch>
        """,
    )
    assert lines == [
        logged(f"b-a read {tmp_path}/some.launch.xml"),
        logged("no this "),
        logged("no none anna"),
    ]


def test_a_file_of_parameters_is_given_in_xml(tmp_path):
    def names(context):
        return [LogInfo(msg=str(context.launch_configurations["global_params"]))]

    text = '<launch><set_parameters_from_file filename="$(dirname)/all.yaml"/></launch>'
    (tmp_path / "some.launch.xml").write_text(text)
    file = IncludeLaunchDescription(str(tmp_path / "some.launch.xml"))
    assert log_of(file, OpaqueFunction(function=names)) == [logged(f"['{tmp_path}/all.yaml']")]
