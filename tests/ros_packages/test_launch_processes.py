"""What launch logs about real processes that start, write, die, respawn and shut down."""

import asyncio
import re
import sys
from pathlib import Path

import pytest
from launch import LaunchContext, LaunchDescription, LaunchService
from launch.actions import (
    EmitEvent,
    ExecuteProcess,
    GroupAction,
    LogInfo,
    RegisterEventHandler,
    SetEnvironmentVariable,
    Shutdown,
    TimerAction,
)
from launch.event_handlers import OnExecutionComplete, OnProcessExit, OnProcessIO, OnProcessStart
from launch.events import matches_action
from launch.events.process import ShutdownProcess, SignalProcess
from launch.logging import launch_config
from launch.processes import SystemProcessStarter
from launch.utilities import text_of
from launch_ros.actions import Node, SetParameter
from launch_ros.substitutions import ExecutableInPackage

from tests.patience import PATIENCE

SAYS = "import sys; print('out'); print('err', file=sys.stderr); sys.exit(int(sys.argv[1]))"
STAYS = """
import signal, time
for each in ({}): signal.signal(each, signal.SIG_IGN)
print('ready', flush=True)
time.sleep({})
"""


@pytest.fixture
def launched(monkeypatch, tmp_path, capsys):
    """Carries out entities; its status and its lines, with every pid as P."""
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path))
    monkeypatch.setattr(launch_config, "_log_dir", None)

    def carry_out(*entities):
        service = LaunchService(noninteractive=True)
        service.include_launch_description(LaunchDescription(entities))
        status = service.run()
        output = capsys.readouterr().out.replace(str(tmp_path), "LOGS").replace(sys.executable, "python3")
        return status, re.sub(r"pid \[?\d+", lambda it: re.sub(r"\d+", "P", it[0]), output).splitlines()[2:]

    return carry_out


def python(text, *words, **more):
    return ExecuteProcess(cmd=[sys.executable, "-c", text, *words], name="it", **more)


def test_a_program_speaks_under_its_name_and_ends_cleanly(launched, capsys, tmp_path):
    status, lines = launched(python(SAYS, "0", output="screen"))
    assert status == 0
    assert lines[0] == "[INFO] [it-1]: process started with pid [P]"
    assert sorted(lines[1:3]) == ["[it-1] err", "[it-1] out"]
    assert lines[3:] == ["[INFO] [it-1]: process has finished cleanly [pid P]"]
    log = next(Path(launch_config.log_dir).glob("launch.log")).read_text()
    assert re.search(r"^\d+\.\d{7} \[INFO\] \[it-1\]: process started with pid \[\d+\]$", log, re.M)


def test_with_output_log_only_stderr_is_shown_and_the_rest_is_in_the_file(launched):
    _, lines = launched(python(SAYS, "0"))
    assert lines[1:-1] == ["[it-1] err"]
    log = Path(launch_config.log_dir, "launch.log").read_text().splitlines()
    assert sorted(log[3:5]) == ["[it-1] err", "[it-1] out"]


@pytest.mark.parametrize(
    ("output", "shown"),
    [
        ("both", ["[it-1] err", "[it-1] out"]),
        ("full", ["[it-1] err", "[it-1] out"]),
        ("own_log", []),
        ({"stdout": "screen", "stderr": "log"}, ["[it-1] out"]),
        ({"both": {"screen"}}, ["[it-1] err", "[it-1] out"]),
    ],
)
def test_output_goes_where_the_action_says(launched, output, shown):
    assert sorted(launched(python(SAYS, "0", output=output))[1][1:-1]) == shown


def test_an_output_that_there_is_not_is_refused(launched):
    status, lines = launched(python(SAYS, "0", output="paper"))
    assert status == 1
    assert lines == [
        "[ERROR] [launch]: Caught exception in launch (see debug for traceback): paper is not a valid "
        'standard output config i.e. "screen", "log" or "both"'
    ]


def test_a_program_that_dies_is_reported_and_started_again(launched):
    program = python(SAYS, "3", respawn=True, respawn_delay=0.01, respawn_max_retries=1, output="own_log")
    ends = OnProcessExit(
        target_action=program, on_exit=lambda event, _: LogInfo(msg=f"exit {event.returncode}")
    )
    starts = OnProcessStart(on_start=[LogInfo(msg="started")], handle_once=True)
    status, lines = launched(RegisterEventHandler(ends), RegisterEventHandler(starts), program)
    died = f"[ERROR] [it-1]: process has died [pid P, exit code 3, cmd 'python3 -c {SAYS} 3']."
    assert status == 0
    assert lines == [
        "[INFO] [it-1]: process started with pid [P]",
        "[INFO] [launch.user]: started",
        died,
        "[INFO] [launch.user]: exit 3",
        "[INFO] [it-1]: process started with pid [P]",
        died,
        "[INFO] [launch.user]: exit 3",
    ]


def test_handlers_get_the_output_of_a_process_and_its_completion(launched):
    program = python(SAYS, "0", output="own_log")

    def on_output(event):
        return LogInfo(msg=f"{event.process_name} wrote {event.text}")

    on_io = OnProcessIO(target_action=program, on_stdout=on_output, on_stderr=on_output)
    done = OnExecutionComplete(target_action=program, on_completion=lambda event, _: LogInfo(msg="done"))
    status, lines = launched(RegisterEventHandler(on_io), RegisterEventHandler(done), program)
    begin, *written, clean, end = lines
    assert (status, begin) == (0, "[INFO] [it-1]: process started with pid [P]")
    assert sorted(written) == [
        "[INFO] [launch.user]: it-1 wrote b'err\\n'",
        "[INFO] [launch.user]: it-1 wrote b'out\\n'",
    ]
    assert clean == "[INFO] [it-1]: process has finished cleanly [pid P]"
    assert end == "[INFO] [launch.user]: done"


def test_a_program_that_is_not_there_is_reported(launched):
    status, lines = launched(ExecuteProcess(cmd=["no_such_program"]))
    assert status == 0
    assert lines[0] == (
        "[ERROR] [no_such_program-1]: exception occurred while executing process: "
        "[Errno 2] No such file or directory: 'no_such_program'"
    )
    assert not any("Traceback" in line for line in lines)


def test_a_program_of_a_package_may_be_bundled(tmp_path):
    lines = []
    commands = {("mine", "says"): [sys.executable, "-c", SAYS, "0"]}
    context = LaunchContext()
    context.process_starter = SystemProcessStarter(lambda *names: commands.get(names))

    async def started():
        found = text_of(context, ExecutableInPackage("says", "mine"))
        assert found == f"{sys.prefix}/lib/mine/says"
        command, add = ["env", found], lambda *each: lines.append(each)
        process = await context.process_starter.start(command, None, {}, False, add)
        return await process.wait()

    assert asyncio.run(started()) == 0
    assert sorted(lines) == [("stderr", "err"), ("stdout", "out")]
    assert context.process_starter.find_bundled("mine", "other") is None


def test_environment_folder_shell_prefix_and_words_are_the_programs(launched, tmp_path):
    text = "import os; print(os.getcwd(), os.environ['A'], os.environ['B'])"
    _, lines = launched(
        SetEnvironmentVariable("A", "1"),
        python(text, cwd=str(tmp_path), additional_env={"B": "2"}, output="screen", log_cmd=True),
    )
    assert (
        lines[0] == f"[INFO] [it-1]: process details: cmd='python3 -c {text}', cwd='LOGS', custom_env?=True"
    )
    assert lines[2] == "[it-1] LOGS 1 2"
    _, lines = launched(ExecuteProcess(cmd=["echo $A", "b"], shell=True, env={"A": "a"}, output="screen"))
    assert "[echo $A-1] a b" in lines
    _, lines = launched(ExecuteProcess(cmd=["b"], prefix="echo a", output="screen"))
    assert "[echo-1] a b" in lines


def test_when_all_is_to_end_a_program_gets_sigint_then_sigterm_then_sigkill(launched):
    text = STAYS.format("signal.SIGINT, signal.SIGTERM", PATIENCE)
    stays = python(text, output="both", sigterm_timeout="0.1", sigkill_timeout="0.2")
    once = RegisterEventHandler(OnProcessStart(target_action=stays, on_start=[WhenReady(stays)]))
    status, lines = launched(once, stays)
    assert status == 0
    assert lines[2:6] == [
        "[INFO] [it-1]: sending signal 'SIGINT' to process[it-1]",
        "[ERROR] [it-1]: process[it-1] failed to terminate '0.1' seconds after receiving 'SIGINT', "
        "escalating to 'SIGTERM'",
        "[INFO] [it-1]: sending signal 'SIGTERM' to process[it-1]",
        "[ERROR] [it-1]: process[it-1] failed to terminate '0.30000000000000004' seconds after receiving "
        "'SIGTERM', escalating to 'SIGKILL'",
    ]
    assert lines[6] == "[INFO] [it-1]: sending signal 'SIGKILL' to process[it-1]"
    assert lines[7] == "[ERROR] [it-1]: process has died [pid P, exit code -9, cmd 'python3 -c "


class WhenReady(TimerAction):
    """Shuts everything down as soon as a process has printed that it is ready."""

    def __init__(self, program):
        super().__init__(period=0.01, actions=[])
        self.program = program

    def execute(self, context):
        log = Path(launch_config.log_dir, "launch.log")
        if "ready" in log.read_text():
            return [Shutdown(reason="ready")]
        return [TimerAction(period=0.01, actions=[WhenReady(self.program)])]


def test_one_program_can_be_ended_or_be_given_a_signal(launched):
    waits = f"import time\ntry: time.sleep({PATIENCE})\nexcept KeyboardInterrupt: pass"
    first, second = python("print('ready')\n" + waits, output="both"), python(waits)
    ends = EmitEvent(event=ShutdownProcess(process_matcher=matches_action(first)))
    signaled = EmitEvent(
        event=SignalProcess(signal_number="SIGTERM", process_matcher=matches_action(second))
    )
    status, lines = launched(
        first,
        second,
        RegisterEventHandler(OnProcessStart(target_action=second, on_start=[signaled])),
        RegisterEventHandler(OnProcessExit(target_action=second, on_exit=[ends])),
    )
    assert status == 0
    assert "[INFO] [it-2]: sending signal 'SIGTERM' to process[it-2]" in lines
    assert "[INFO] [it-1]: sending signal 'SIGINT' to process[it-1]" in lines
    assert any(
        line.startswith("[ERROR] [it-2]: process has died [pid P, exit code -15, cmd") for line in lines
    )


def test_a_node_is_a_program_with_ros_own_words(launched):
    node = Node(
        executable="echo",
        name="n",
        namespace="s",
        parameters=[{"a": 1}],
        remappings=[("x", ["y", "z"])],
        arguments=["w"],
        ros_arguments=["--log-level", "warn"],
        output="screen",
    )
    with pytest.raises(RuntimeError, match=r"^cannot access 'node_name' before executing action$"):
        _ = node.node_name
    _, lines = launched(SetParameter("b", [1, 2]), SetParameter("c", "d"), node)
    begin = "[echo-1] w --ros-args --log-level warn --ros-args -r __node:=n -r __ns:=/s -p b:=[1, 2] -p c:=d"
    assert node.node_name == "/s/n"
    before, file, rest = re.fullmatch(r"(.*) --params-file (\S+) (.*)", lines[1]).groups()
    assert (before, rest) == (begin, "-r x:=yz")
    assert Path(file).read_text() == "/s/n:\n  ros__parameters:\n    a: 1\n"


def test_a_parameter_is_for_all_later_nodes_of_the_group(launched):
    group = GroupAction([SetParameter("b", 2), Node(executable="echo", name="n", output="screen")])
    _, lines = launched(group, Node(executable="echo", name="m", output="screen"))
    # Two processes: either may be first.
    assert sorted(line for line in lines if line.startswith("[echo")) == [
        "[echo-1] --ros-args -r __node:=n -p b:=2",
        "[echo-2] --ros-args -r __node:=m",
    ]


def test_what_is_odd_about_a_node_is_said(launched):
    first = Node(executable="true", name="a", namespace="b", parameters=["/no/such.yaml"])
    status, lines = launched(first, Node(executable="true", name="a", namespace="/b/"))
    assert status == 0
    assert lines[:2] == [
        "[WARNING] [launch_ros.actions.node]: Parameter file path is not a file: /no/such.yaml",
        "[WARNING] [true-2]: there are now at least 2 nodes with the name /b/a created within this "
        "launch context",
    ]
    status, lines = launched(Node(executable="true", name="a b"))
    assert status == 1
    assert lines[0] == (
        "[ERROR] [launch_ros.actions.node]: Error while expanding or validating node name or namespace for "
        "'package=None, executable=true, name=a b, namespace=None':"
    )
    assert "Invalid node name: node name must not contain characters other than alphanumerics" in lines[1]


def test_an_action_is_executed_once(launched):
    program = python("")
    status, lines = launched(program, program)
    assert status == 1
    assert lines[0].startswith(
        "[ERROR] [launch]: Caught exception in launch (see debug for traceback): ExecuteLocal action 'it-1': "
        "executed more than once: <launch.actions.execute_process.ExecuteProcess object at "
    )


def test_the_output_and_the_status_of_a_process_are_available(launched):
    program = python(SAYS, "3", cached_output=True)
    assert program.return_code is None
    launched(program)
    assert (program.get_stdout(), program.get_stderr(), program.return_code) == ("out\n", "err\n", 3)


@pytest.mark.parametrize("name", ["get_stdout", "get_stderr"])
def test_output_that_is_not_cached_is_refused(name):
    with pytest.raises(RuntimeError) as error:
        getattr(python(""), name)()
    assert re.fullmatch(
        r"the output of <launch.actions.execute_process.ExecuteProcess object at 0x\w+> is not stored: "
        r"create the action with cached_output=True\.",
        str(error.value),
    )
