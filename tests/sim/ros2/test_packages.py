"""ros2 pkg, run and launch in a terminal, on a package as colcon installs it."""

import os
import re
import shlex
import signal

import pytest
from launch.logging import launch_config

from sim import Process, run
from sim.ros2 import parser
from sim.ros2.cli_program import ros2
from tests.patience import PATIENCE
from tests.sim.ros.installed import NAME, install, sourced
from tests.sim.ros2.test_terminal import ROS2, start
from tests.sim.standalone.programs import REPOSITORY, free_domain


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    return install(tmp_path_factory.mktemp("workspace"))


@pytest.fixture(scope="module")
def environment(package):
    """The environment of a terminal where the workspace is sourced."""
    variables = sourced(package)
    folders = (str(REPOSITORY), str(REPOSITORY / "ros_packages/python"))
    return variables | {"PYTHONPATH": os.pathsep.join([variables["PYTHONPATH"], *folders])}


@pytest.fixture
def execute(package, monkeypatch):
    """Executes a ros2 command; returns its status and its lines of output."""
    monkeypatch.setenv("AMENT_PREFIX_PATH", sourced(package)["AMENT_PREFIX_PATH"])

    def execute(line):
        lines = []
        status = parser.execute(parser.make_parser(), shlex.split(line), None, lines.append, lines.append)
        return status, lines

    return execute


def test_packages_are_listed(execute):
    status, lines = execute("pkg list")
    assert status == 0
    assert lines == sorted(lines)
    assert {NAME, "rclpy", "std_msgs"} <= set(lines)


def test_programs_prefix_and_manifest_of_a_package_are_printed(execute, package):
    assert execute(f"pkg executables {NAME}") == (0, [f"{NAME} binary", f"{NAME} driver", f"{NAME} once"])
    names = [str(package / "lib" / NAME / name) for name in ("binary", "driver", "once")]
    assert execute(f"pkg executables {NAME} --full-path") == (0, names)
    assert f"{NAME} driver" in execute("pkg executables")[1]
    assert execute(f"pkg prefix {NAME}") == (0, [str(package)])
    assert execute(f"pkg prefix --share {NAME}") == (0, [str(package / "share" / NAME)])
    assert execute(f"pkg xml {NAME} -t version") == (0, ["0.1.0"])
    assert execute(f"pkg xml {NAME}")[1][0].startswith('<package format="3"><name>two_robots</name>')


@pytest.mark.parametrize(
    ("line", "text"),
    [
        ("pkg executables two_robot", "Package 'two_robot' not found: did you mean two_robots?"),
        ("pkg prefix two_robot", "Package not found"),
        ("pkg prefix --share two_robot", "Package not found"),
        ("pkg xml two_robot", "Package not found"),
        ("pkg xml two_robots -t license", "XML tag not found"),
        ("run two_robot driver", "Package 'two_robot' not found: did you mean two_robots?"),
        (
            "run two_robots drivr",
            "No executable found: two_robots has binary, driver, once, but no drivr. Did you mean driver? "
            "Changes in 'console_scripts' of setup.py take effect after the next colcon build.",
        ),
        (
            "launch two_robots no.launch.py",
            "file 'no.launch.py' was not found in the share directory of package",
        ),
        (
            "launch two_robots",
            "Package 'two_robots' has launch files: name one, as in two_robots bringup.lau",
        ),
        ("launch no.launch.py", "There is no launch file 'no.launch.py' in "),
        ("launch two_robots one.launch.py speed:=", "malformed launch argument 'speed:=', expected format"),
    ],
)
def test_what_is_missing_is_reported_as_by_the_official_tools_with_the_reason(execute, line, text):
    status, (output,) = execute(line)
    assert status == 1
    assert output.startswith(text)


def test_a_package_without_a_manifest_is_reported(execute, tmp_path, monkeypatch):
    prefix = install(tmp_path)
    (prefix / "share" / NAME / "package.xml").unlink()
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(prefix))
    assert execute(f"pkg xml {NAME}") == (1, ["Package XML manifest not found"])


def test_the_arguments_of_a_launch_file_are_printed(execute, package, tmp_path):
    status, (output,) = execute(f"launch -s {NAME} bringup.launch.yaml")
    assert status == 0
    assert output.splitlines() == [
        "Arguments (pass arguments as '<name>:=<value>'):",
        "",
        "    'speed':",
        "        of the left robot, in m/s",
        "        (default: '0.25')",
    ]
    file = tmp_path / "x.launch.yaml"
    file.write_text("launch:\n- group: {if: $(var x), children: [{arg: {name: y}}]}\n")
    assert execute(f"launch {file} --show-args")[1][0].splitlines()[1:] == [
        "",
        "    'y':*",
        "        no description given",
        "",
        "* argument(s) which are only used if specific conditions occur",
    ]
    file.write_text("launch: []\n")
    assert execute(f"launch {file} -s")[1][0].splitlines()[1:] == ["", "  No arguments."]


def test_a_launch_file_is_printed_as_a_tree(execute, package):
    status, (output,) = execute(f"launch --print {NAME} respawn.launch.py")
    once, driver = (f"ExecInPkg(pkg='{NAME}', exec='{name}')" for name in ("once", "driver"))
    assert status == 0
    assert re.sub(r"<(\w+\.)*(\w+) object at 0x\w+>", r"<\2>", output).splitlines() == [
        "<LaunchDescription>",
        "├── RegisterEventHandler('<OnProcessExit>'):",
        "│   └── OnProcessExit",
        "├── RegisterEventHandler('<OnProcessStart>'):",
        "│   └── OnProcessStart",
        "│       └── LogInfo('the last one')",
        "├── RegisterEventHandler('<OnProcessExit>'):",
        "│   └── OnProcessExit",
        "│       └── EmitEvent(event='launch.events.Shutdown')",
        f"├── ExecuteProcess(cmd=[{once}, '3', '--ros-args'], cwd=None, env=None, shell=False)",
        f"├── ExecuteProcess(cmd=[{driver}, '--ros-args'], cwd=None, env=None, shell=False)",
        "└── Action('<TimerAction>')",
    ]


def test_commands_that_start_processes_are_refused_in_a_launch_file_of_a_run(package, monkeypatch):
    monkeypatch.setenv("AMENT_PREFIX_PATH", sourced(package)["AMENT_PREFIX_PATH"])
    for line, instead in (
        (f"launch {NAME} bringup.launch.py", f'run("{NAME} bringup.launch.py")'),
        (f"run {NAME} driver", f'run(executable("{NAME}", "driver"))'),
    ):
        recording = run(Process(ros2, arguments=line.split()), seconds=1, quiet=True)
        word = line.split()[0]
        assert "".join(text for _, text in recording.prints) == (
            f"`ros2 {word}` starts processes of their own, in a terminal. Here, write {instead}.\n"
        )


@pytest.mark.parametrize(
    ("prefix", "status", "lines"),
    [
        ("env", 3, ["[ros2run]: Process exited with failure 3"]),
        ("true", 0, []),
        ("sh -c 'kill -9 $$'", -9, ["[ros2run]: Killed"]),
    ],
)
def test_run_reports_how_the_program_failed(execute, prefix, status, lines):
    assert execute(f'run --prefix "{prefix}" {NAME} once 3') == (status, lines)


def test_two_robots_are_launched_as_processes_and_ctrl_c_ends_them(environment, tmp_path):
    process = start(
        [*ROS2, "launch", NAME, "bringup.launch.py", f"sigterm_timeout:={PATIENCE}"],
        free_domain(),
        ROS_LOG_DIR=str(tmp_path),
        **environment,
    )
    lines = []
    while len([line for line in lines if line.endswith("ready\n")]) < 2:
        lines.append(process.stdout.readline())
        assert lines[-1], process.communicate()
    process.send_signal(signal.SIGINT)
    rest, err = process.communicate(timeout=PATIENCE)
    lines = re.sub(r"pid (\[?)\d+", r"pid \1P", "".join(lines) + rest).splitlines()
    assert lines[0].startswith(f"[INFO] [launch]: All log files can be found below {tmp_path}/")
    assert lines[1] == "[INFO] [launch]: Default logging verbosity is set to INFO"
    for driver in ("driver-1", "driver-2"):
        of_driver = [line for line in lines[2:6] if driver in line]
        assert of_driver == [f"[INFO] [{driver}]: process started with pid [P]", f"[{driver}] ready"]
    assert sorted(lines[6:]) == [
        "[INFO] [driver-1]: process has finished cleanly [pid P]",
        "[INFO] [driver-1]: sending signal 'SIGINT' to process[driver-1]",
        "[INFO] [driver-2]: process has finished cleanly [pid P]",
        "[INFO] [driver-2]: sending signal 'SIGINT' to process[driver-2]",
        "[WARNING] [launch]: user interrupted with ctrl-c (SIGINT)",
    ]
    assert (process.returncode, err) == (0, "")


def test_a_launch_file_that_fails_ends_with_status_1(execute, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path))
    monkeypatch.setattr(launch_config, "_log_dir", None)
    file = tmp_path / "x.launch.yaml"
    file.write_text("launch:\n- node: {pkg: no_such, exec: x}\n")
    assert execute(f"launch {file}") == (1, [])
    (line,) = capsys.readouterr().out.splitlines()[2:]
    begin = "[ERROR] [launch]: Caught exception in launch (see debug for traceback): \"package 'no_such' not"
    assert line.startswith(begin)
