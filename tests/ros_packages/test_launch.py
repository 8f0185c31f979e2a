"""Launch files without processes: substitutions, conditions, scopes, events; and their YAML."""

import asyncio
import os
import subprocess
import sys
import tempfile
import textwrap

import pytest
import yaml
from ament_index_python.packages import get_package_share_directory
from launch import LaunchContext, LaunchDescription, LaunchService
from launch.actions import (
    DeclareLaunchArgument,
    EmitEvent,
    GroupAction,
    IncludeLaunchDescription,
    LogInfo,
    OpaqueFunction,
    RegisterEventHandler,
    SetEnvironmentVariable,
    SetLaunchConfiguration,
    Shutdown,
    TimerAction,
)
from launch.conditions import IfCondition, UnlessCondition
from launch.event_handlers import OnExecutionComplete, OnShutdown
from launch.events import Shutdown as ShutdownEvent
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.logging import redirect_log
from launch.substitutions import (
    Command,
    EnvironmentVariable,
    EqualsSubstitution,
    FindExecutable,
    LaunchConfiguration,
    LocalSubstitution,
    NotEqualsSubstitution,
    PathJoinSubstitution,
    PythonExpression,
    TextSubstitution,
    ThisLaunchFileDir,
)
from launch.utilities import text_of
from launch.yaml_frontend.substitutions import parse_substitution
from launch_ros.actions import Node, PushRosNamespace, SetParameter
from launch_ros.parameter_descriptions import ParameterFile, ParameterValue
from launch_ros.parameters import evaluate_parameter_dict, write_parameter_file
from launch_ros.substitutions import ExecutableInPackage, FindPackageShare

LEVELS = {10: "DEBUG", 20: "INFO", 30: "WARNING", 40: "ERROR"}


def log_of(*entities, status=0):
    """The lines that launch logs when it executes these entities."""
    lines = []
    with redirect_log(lambda level, name, text: lines.append(f"[{LEVELS[level]}] [{name}]: {text}")):
        service = LaunchService()
        service.include_launch_description(LaunchDescription(entities))
        assert asyncio.run(service.run_async()) == status
    return lines


def logged(text):
    return f"[INFO] [launch.user]: {text}"


def of_yaml(tmp_path, text, status=0, **arguments):
    file = tmp_path / "some.launch.yaml"
    file.write_text(textwrap.dedent(text))
    return log_of(IncludeLaunchDescription(str(file), launch_arguments=arguments.items()), status=status)


def fails_with(text):
    return [f"[ERROR] [launch]: Caught exception in launch (see debug for traceback): {text}"]


@pytest.mark.parametrize(
    ("substitution", "text"),
    [
        (TextSubstitution(text="a"), "a"),
        (LaunchConfiguration("name"), "anna"),
        (LaunchConfiguration("none", default="x"), "x"),
        (LaunchConfiguration("none", default=5), "5"),
        (EnvironmentVariable("HOME_OF_TEST"), "here"),
        (EnvironmentVariable("NONE_OF_TEST", default_value="there"), "there"),
        (PathJoinSubstitution(["a", LaunchConfiguration("name"), "b.yaml"]), "a/anna/b.yaml"),
        (PythonExpression(["1 + ", "2 * pi"]), str(1 + 2 * 3.141592653589793)),
        (PythonExpression("len(os.sep)", ["os"]), "1"),
        (Command("echo hello"), "hello\n"),
        (Command("sh -c 'echo bad >&2'", on_stderr="capture"), "bad\n"),
        (EqualsSubstitution(LaunchConfiguration("name"), "anna"), "true"),
        (EqualsSubstitution("1.0", 1), "true"),
        (EqualsSubstitution("True", True), "true"),
        (EqualsSubstitution("a", None), "false"),
        (NotEqualsSubstitution("a", "b"), "true"),
        (NotEqualsSubstitution("2", "2.0"), "false"),
    ],
)
def test_a_substitution_has_a_text(substitution, text):
    context = LaunchContext()
    context.launch_configurations["name"] = "anna"
    context.environment["HOME_OF_TEST"] = "here"
    assert context.perform_substitution(substitution) == text


@pytest.mark.parametrize(
    ("substitution", "words"),
    [
        (LaunchConfiguration("speed"), "launch configuration 'speed' does not exist"),
        (EnvironmentVariable("NONE_OF_TEST"), "environment variable 'NONE_OF_TEST' does not exist"),
        (ThisLaunchFileDir(), "ThisLaunchFileDir used outside of a launch file (in a script)"),
        (FindExecutable(name="no_such"), "executable 'no_such' not found on the PATH"),
        (Command("no_such"), "file not found: [Errno 2] No such file or directory: 'no_such'"),
        (Command("false"), "executed command failed. Command: false"),
        (
            Command("sh -c 'echo bad >&2'"),
            "executed command showed stderr output. Command: sh -c 'echo bad >&2'\n"
            "Captured stderr output:\nbad\n",
        ),
        (
            Command("ls", on_stderr="cry"),
            "expected 'on_stderr' to be one of: 'fail', 'ignore', 'warn' or 'capture'",
        ),
    ],
)
def test_a_substitution_without_a_text_says_so(substitution, words):
    assert log_of(LogInfo(msg=substitution), status=1) == fails_with(words)


def test_a_package_that_is_not_there_is_named():
    (line,) = log_of(LogInfo(msg=FindPackageShare("no_such")), status=1)
    assert "\"package 'no_such' not found, searching: [" in line


def test_a_package_without_programs_says_so():
    (line,) = log_of(LogInfo(msg=ExecutableInPackage("talker", "std_msgs")), status=1)
    assert "package 'std_msgs' found at '" in line
    assert line.endswith("/lib/std_msgs' does not exist")


def test_arguments_have_values_given_or_by_default_and_a_condition_asks_for_them():
    lines = log_of(
        DeclareLaunchArgument("speed", default_value="0.2"),
        LogInfo(msg=["at ", LaunchConfiguration("speed")]),
        SetLaunchConfiguration("quiet", "False"),
        LogInfo(msg="not quiet", condition=UnlessCondition(LaunchConfiguration("quiet"))),
        LogInfo(msg="quiet", condition=IfCondition(LaunchConfiguration("quiet"))),
    )
    assert lines == [logged("at 0.2"), logged("not quiet")]


def test_a_condition_that_is_neither_true_nor_false_is_refused():
    (line,) = log_of(LogInfo(msg="x", condition=IfCondition("maybe")), status=1)
    assert "invalid condition expression, expected one of [true, 1, false, 0] but got 'maybe'" in line


def test_a_missing_required_argument_is_reported():
    lines = log_of(DeclareLaunchArgument("speed", description="how fast"), status=1)
    assert lines == [
        '[ERROR] [launch.actions.declare_launch_argument]: Required launch argument "speed" '
        '(description: "how fast") was not provided',
        *fails_with('Required launch argument "speed" was not provided.'),
    ]


def test_a_choice_that_there_is_not_is_refused():
    lines = log_of(
        SetLaunchConfiguration("side", "up"),
        DeclareLaunchArgument("side", choices=["left", "right"]),
        status=1,
    )
    text = "Argument \"side\" provided value \"up\" is not valid. Valid options are: ['left', 'right']"
    assert lines == [f"[ERROR] [launch.actions.declare_launch_argument]: {text}", *fails_with(text)]
    with pytest.raises(
        RuntimeError, match=r'^Provided default_value "up" is not in provided choices "\[\'left\'\]"'
    ):
        DeclareLaunchArgument("side", default_value="up", choices=["left"])
    with pytest.raises(
        RuntimeError, match=r"^Provided choices arg is empty. Use None to ignore the choice list.$"
    ):
        DeclareLaunchArgument("side", choices=[])


def test_what_a_group_sets_ends_with_it_unless_it_has_no_scope():
    def report(context):
        return [
            LogInfo(
                msg=context.launch_configurations.get("x", "-") + context.environment.get("X_OF_TEST", "-")
            )
        ]

    here = OpaqueFunction(function=report)
    setting = [SetLaunchConfiguration("x", "1"), SetEnvironmentVariable("X_OF_TEST", "2"), here]
    assert log_of(GroupAction(setting), here) == [logged("12"), logged("--")]
    assert log_of(GroupAction(setting, scoped=False), here) == [logged("12"), logged("12")]
    lines = log_of(
        SetLaunchConfiguration("x", "0"),
        GroupAction([here], launch_configurations={"x": "9"}),
        GroupAction([here], forwarding=False),
        here,
    )
    assert lines == [logged("9-"), logged("--"), logged("0-")]


def test_a_file_is_included_with_its_folder_and_arguments(tmp_path):
    (tmp_path / "inner.launch.py").write_text(
        textwrap.dedent(
            """
            from launch import LaunchDescription
            from launch.actions import DeclareLaunchArgument, LogInfo
            from launch.substitutions import LaunchConfiguration, ThisLaunchFileDir

            def generate_launch_description():
                words = [ThisLaunchFileDir(), " ", LaunchConfiguration("name")]
                return LaunchDescription([DeclareLaunchArgument("name"), LogInfo(msg=words)])
            """
        )
    )
    source = PythonLaunchDescriptionSource([str(tmp_path), "/inner.launch.py"])
    given = {"name": "anna"}.items()
    assert log_of(IncludeLaunchDescription(source, launch_arguments=given)) == [logged(f"{tmp_path} anna")]
    assert log_of(IncludeLaunchDescription(source), status=1) == fails_with(
        "Included launch description missing required argument 'name' "
        "(description: 'no description given'), given: []"
    )


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        (
            "no.launch.py",
            "x = 1",
            "launch file at '{}' does not contain the required function 'generate_launch_description()'",
        ),
        (
            "no.launch.toml",
            "",
            "'{}' is not a launch file that can be read here: they are in Python (.py), XML (.xml, .launch) "
            "or YAML (.yaml).",
        ),
        ("no.launch", None, "[Errno 2] No such file or directory: '{}'"),
        (
            "no.launch.yaml",
            "nodes: []",
            "{} is not a launch file: it has to begin with `launch:`, with a list below it.",
        ),
    ],
)
def test_a_file_that_is_no_launch_file_says_why(tmp_path, name, text, words):
    file = tmp_path / name
    if text is not None:
        file.write_text(text)
    assert log_of(IncludeLaunchDescription(str(file)), status=1) == fails_with(words.format(file))


def test_timers_fire_in_order_and_a_shutdown_takes_the_rest_away():
    lines = log_of(
        TimerAction(period=0.02, actions=[LogInfo(msg="second"), Shutdown(reason="enough")]),
        TimerAction(period=0.0, actions=[LogInfo(msg="first")]),
        TimerAction(period=60.0, actions=[LogInfo(msg="never")]),
        RegisterEventHandler(
            OnShutdown(on_shutdown=lambda event, context: [LogInfo(msg=["because ", event.reason])])
        ),
    )
    assert lines == [logged("first"), logged("second"), logged("because enough")]


def test_when_an_action_is_done_its_handlers_come_and_those_of_all_actions():
    first, second = LogInfo(msg="first"), LogInfo(msg="second")
    end = OnShutdown(on_shutdown=LogInfo(msg=["for ", LocalSubstitution("event.reason")]))
    lines = log_of(
        RegisterEventHandler(end),
        RegisterEventHandler(OnExecutionComplete(target_action=first, on_completion=[LogInfo(msg="then")])),
        first,
        second,
        RegisterEventHandler(
            OnExecutionComplete(on_completion=lambda *_: Shutdown(reason="one done"), handle_once=True)
        ),
    )
    assert lines == [logged("first"), logged("second"), logged("then"), logged("for one done")]


def test_an_event_may_be_reported_and_a_wrong_thing_is_no_event():
    handler = OnShutdown(on_shutdown=[LogInfo(msg="it ends")])
    lines = log_of(RegisterEventHandler(handler), EmitEvent(event=ShutdownEvent(reason="so")))
    assert lines == [logged("it ends")]
    with pytest.raises(RuntimeError, match=r"^EmitEvent\(\) expected an event instance, got 'Shutdown'\.$"):
        EmitEvent(event="Shutdown")


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (
            lambda: TextSubstitution(text=1),
            "TextSubstitution expected Text object got '<class 'int'>' instead.",
        ),
        (
            lambda: LogInfo(msg=[1]),
            "Failed to normalize given item of type '<class 'int'>', when only 'str' or "
            "'launch.Substitution' were expected.",
        ),
        (
            lambda: OpaqueFunction(function="f"),
            "OpaqueFunction expected a callable for 'function', got '<class 'str'>'",
        ),
        (
            lambda: TimerAction(period=1, actions=[]),
            "'TimerAction' expected 'period' to be one of [<class 'str'>, "
            "<class 'launch.substitution.Substitution'>, <class 'collections.abc.Iterable'>, "
            "<class 'float'>], but got '1' of type '<class 'int'>'",
        ),
        (
            lambda: Node(executable="x", parameters={"a": 1}),
            "'Node' expected 'parameters' to be one of [<class 'list'>], "
            "but got '{'a': 1}' of type '<class 'dict'>'",
        ),
    ],
)
def test_an_action_refuses_invalid_arguments_when_it_is_created(make, words):
    with pytest.raises(TypeError) as refused:
        make()
    assert str(refused.value) == words


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (
            {"target_action": "talker", "on_completion": []},
            "OnExecutionComplete requires an 'Action' as the target",
        ),
        (
            {"on_completion": ["done"]},
            "expected all items in 'on_completion' iterable to be of type 'LaunchDescriptionEntity' "
            "but got '<class 'str'>'",
        ),
    ],
)
def test_what_comes_when_an_action_is_done_is_checked_as_given(arguments, words):
    with pytest.raises(ValueError) as refused:
        OnExecutionComplete(**arguments)
    assert str(refused.value) == words


def test_parameters_are_what_yaml_takes_their_texts_for():
    context = LaunchContext()
    context.launch_configurations |= {"speed": "0.5", "name": "12", "gains": "[1.0, 2.0]"}
    values = evaluate_parameter_dict(
        context,
        {
            "speed": LaunchConfiguration("speed"),
            "name": ParameterValue(LaunchConfiguration("name"), value_type=str),
            "count": ParameterValue(LaunchConfiguration("name"), value_type=int),
            "gains": LaunchConfiguration("gains"),
            "topic": [LaunchConfiguration("name"), "/scan"],
            "mixed": [1, 2.5],
            "arm": {"left": {"on": True}},
            "text": "0.5",
        },
    )
    assert values == {
        "speed": 0.5,
        "name": "12",
        "count": 12,
        "gains": [1.0, 2.0],
        "topic": "12/scan",
        "mixed": [1.0, 2.5],
        "arm.left.on": True,
        "text": "0.5",
    }


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (None, "Unexpected type for parameter value None"),
        ([], "Expected a non-empty sequence, with items of uniform type."),
        ([1, "a"], "Expected a non-empty sequence, with items of uniform type."),
        (
            TextSubstitution(text="{a: 1}"),
            "Allowed value types are bytes, bool, int, float, str, Sequence[bool]",
        ),
        (TextSubstitution(text="a: : b"), "Unable to parse the value of parameter x as yaml."),
    ],
)
def test_a_value_that_no_parameter_can_have_is_refused(value, words):
    with pytest.raises(TypeError) as refused:
        evaluate_parameter_dict(LaunchContext(), {"x": value})
    assert str(refused.value).startswith(words)


def test_a_file_of_parameters_may_have_substitutions(tmp_path):
    file = tmp_path / "params.yaml"
    file.write_text("/**: {ros__parameters: {speed: $(var speed)}}\n")
    context = LaunchContext()
    context.launch_configurations["speed"] = "0.5"
    assert ParameterFile(file).evaluate(context) == file
    made = ParameterFile(file, allow_substs=True).evaluate(context)
    assert made.read_text() == "/**: {ros__parameters: {speed: 0.5}}\n"
    file.write_text("{: $(var speed)")
    lines = log_of(
        SetLaunchConfiguration("speed", "1"),
        OpaqueFunction(function=lambda context: ParameterFile(file, allow_substs=True).evaluate(context)),
        status=1,
    )
    assert lines == fails_with("The substituted parameter file is not a valid yaml file")


def test_a_parameter_file_finds_packages_without_any_launch_file_in_yaml(tmp_path):
    file = tmp_path / "parameters.yaml"
    file.write_text("/**: {ros__parameters: {folder: $(find-pkg-share rclpy)}}\n")
    program = (
        "from launch import LaunchContext; from launch_ros.parameter_descriptions import ParameterFile; "
        f"print(ParameterFile({str(file)!r}, allow_substs=True).evaluate(LaunchContext()).read_text())"
    )
    environment = {**os.environ, "TMPDIR": str(tmp_path)}
    written = subprocess.check_output([sys.executable, "-c", program], env=environment, text=True)
    share = get_package_share_directory("rclpy")
    assert yaml.safe_load(written) == {"/**": {"ros__parameters": {"folder": share}}}


@pytest.fixture
def temporary(tmp_path, monkeypatch):
    """An empty folder for temporary files, and the folder in it for parameter files."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    return tmp_path / f"launch_params_{os.getuid()}"


def test_parameter_files_are_in_a_folder_that_no_other_user_can_read_or_change(temporary):
    path = write_parameter_file("speed: 1")
    assert (write_parameter_file("speed: 1"), path.parent, path.read_text()) == (path, temporary, "speed: 1")
    assert temporary.stat().st_mode & 0o777 == 0o700
    assert [file.name for file in temporary.iterdir()] == [path.name]


@pytest.mark.parametrize("how", ["open to others", "a link", "another user's", "a file"])
def test_parameter_files_are_never_in_a_folder_that_others_can_change(temporary, tmp_path, monkeypatch, how):
    if how == "a file":
        temporary.write_text("")
    elif how == "a link":
        (tmp_path / "elsewhere").mkdir(mode=0o700)
        temporary.symlink_to(tmp_path / "elsewhere")
    elif how == "another user's":
        (folder := tmp_path / f"launch_params_{os.getuid() + 1}").mkdir(mode=0o700)
        uid = os.getuid() + 1
        monkeypatch.setattr(os, "getuid", lambda: uid)
        temporary = folder
    else:
        temporary.mkdir()
        temporary.chmod(0o770)
    with pytest.raises(PermissionError) as refused:
        write_parameter_file("speed: 1")
    assert str(refused.value) == (
        f"{temporary} must be a folder that belongs to you and is closed to others: remove it, or set "
        "TMPDIR to another folder."
    )
    assert not any(file.is_file() and file != temporary for file in tmp_path.rglob("*"))


def test_namespaces_are_pushed_one_into_the_other():
    def report(context):
        return [LogInfo(msg=context.launch_configurations["ros_namespace"])]

    here = OpaqueFunction(function=report)
    lines = log_of(
        PushRosNamespace("one"), here, PushRosNamespace("two"), here, PushRosNamespace("/x"), here
    )
    assert lines == [logged("/one"), logged("/one/two"), logged("/x")]
    assert log_of(PushRosNamespace("a b"), status=1) == fails_with(
        "The resulting namespace is invalid: [previous_namespace='None', pushed_namespace='a b']"
    )


def test_a_parameter_is_set_for_all_nodes_of_a_group():
    def report(context):
        return [LogInfo(msg=str(context.launch_configurations.get("global_params")))]

    here = OpaqueFunction(function=report)
    lines = log_of(
        SetParameter("a", 1), GroupAction([SetParameter("b", TextSubstitution(text="2.5")), here]), here
    )
    assert lines == [logged("[('a', 1), ('b', 2.5)]"), logged("[('a', 1)]")]


def test_yaml_says_the_same(tmp_path):
    lines = of_yaml(
        tmp_path,
        r"""
        launch:
        - arg: {name: robot, default: anna, description: its name}
        - let: {name: topic, value: "/$(var robot)/scan"}
        - log: {message: "$(var topic) $(var none '-') $(eval '1 + $(eval 2)') $(equals a a) \\$(x)"}
        - log: {message: "$(not-equals a b) $(env NONE_OF_TEST no)", if: "$(equals $(var robot) berta)"}
        - log: {message: not berta, unless: "$(equals $(var robot) berta)"}
        - group:
          - push_ros_namespace: {namespace: one}
          - log: {message: "$(var ros_namespace)"}
        - group:
            scoped: false
            keep: [{name: kept, value: "yes"}]
            children:
            - set_env: {name: X_OF_TEST, value: x}
        - log: {message: "$(var ros_namespace none) $(var kept) $(env X_OF_TEST) $(command 'echo hi')"}
        - timer: {period: 0.01, children: [{shutdown: {reason: so}}]}
        """,
    )
    assert lines == [
        logged("/anna/scan - 3 true $(x)"),
        logged("not berta"),
        logged("/one"),
        logged("none yes x hi\n"),
    ]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("- nod: {}", "Unrecognized entity of the type: nod. There are arg, executable, "),
        ("- node: {pkg: a}", "Can not find attribute 'exec' in Entity 'node'"),
        ("- log: {message: a, mesage: b}", "Unexpected key(s) found in `log`: {'mesage'}"),
        ("- log: {message: a}\n  arg: {name: b}", "Subentities must be a dictionary with only one key"),
        ("- log: {message: $(var)}", "var substitution expects 1 or 2 argument(s), not 0"),
        ("- log: {message: $(dirname x)}", "dirname substitution expects 0 argument(s), not 1"),
        ("- log: {message: $(find-pkg x)}", "Unknown substitution: find-pkg. There are command, dirname, "),
        ("- log: {message: $(var x}", "'$(var x' can't be read: there is no ) at the end of $(var ..."),
        ("- log: {message: $(3)}", "'$(3)' can't be read from '$(3)' on."),
        (
            "- log: {message: a, if: '1', unless: '1'}",
            "if and unless conditions can't be used simultaneously",
        ),
        (
            "- node: {exec: a, on_exit: restart}",
            "Attribute on_exit of Entity node expected to be shutdown but got `restart`",
        ),
        (
            "- node: {exec: a, respawn_delay: -1.0}",
            "Attribute respawn_delay of Entity node expected to be a non-negative value but got `-1.0`",
        ),
        ("- node: {exec: a, param: [{from: a, name: b}]}", "name and from attributes are mutually exclusive"),
        ("- node: {exec: a, param: [{value: 1}]}", "param Entity should have name or from attribute"),
        ("- node: {exec: a, param: [{name: b}]}", "either a value attribute or nested params are needed"),
        (
            "- node: {exec: a, param: [{name: b, value: 1, type: real}]}",
            "'real' is not a parameter type here:",
        ),
        ("- node: {exec: a, remap: [a]}", "Attribute 'remap' of Entity 'node' expected to be a list of dict"),
        ("- node: {exec: [a], param: 3}", "Attribute 'param' of Entity 'node' expected to be of type"),
    ],
)
def test_a_mistake_in_yaml_is_named(tmp_path, text, words):
    (line,) = of_yaml(tmp_path, "launch:\n" + text, status=1)
    assert line.startswith(fails_with(words)[0])


def test_a_text_of_yaml_is_read_to_its_end():
    assert text_of(LaunchContext(), parse_substitution("")) == ""
    assert text_of(LaunchContext(), parse_substitution(r"a \"b\" $c )")) == 'a "b" $c )'
