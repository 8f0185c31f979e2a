"""Launch files in a run: programs start, exit and restart in simulated time."""

import sys

import pytest

from sim import Network, Process, play, run
from sim.ros.launching.files import NoLaunchFile, find_launch_file
from tests.sim.ros.installed import NAME, install, sourced

DRIVES = {
    "/left/driver": [("/left/cmd_vel", 0.5 + 0.5 * tick, 0.25) for tick in range(6)],
    "/right/driver": [("/right/wheels", 1.75 + 0.5 * tick, 0.5) for tick in range(3)],
}


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    """The package, installed and sourced; its prefix."""
    prefix = install(tmp_path_factory.mktemp("workspace"))
    with pytest.MonkeyPatch.context() as patch:
        variables = sourced(prefix)
        patch.setenv("AMENT_PREFIX_PATH", variables["AMENT_PREFIX_PATH"])
        patch.syspath_prepend(variables["PYTHONPATH"])
        yield prefix


def logged(recording):
    """The log lines of launch: level, stamp, name and text."""
    names = ("launch", "launch.user", "driver", "once", "last", "python3", "ros2", "talker")
    lines = (line for line in recording.logs if line.node.split("-")[0] in names)
    return [f"[{line.level}] [{line.stamp:.3f}] [{line.node}]: {line.text}" for line in lines]


def driven(recording):
    received = [each for each in recording.published if each.type == "geometry_msgs/msg/Twist"]
    return {
        name: [(each.topic, each.stamp, each.message.linear.x) for each in received if each.sender == name]
        for name in sorted({each.sender for each in received})
    }


@pytest.fixture(scope="module")
def two_robots(package):
    return run(f"{NAME} bringup.launch.py", seconds=3.2, quiet=True)


def test_two_robots_drive_each_in_its_namespace_from_its_time_on(two_robots):
    assert driven(two_robots) == DRIVES
    assert two_robots.errors == []
    assert two_robots.ended.reason == "time"


def test_launch_logs_what_it_starts(two_robots):
    assert logged(two_robots) == [
        "[INFO] [0.000] [driver-1]: process started with pid [1]",
        "[INFO] [1.250] [driver-2]: process started with pid [2]",
    ]


def test_the_same_file_gives_the_same_recording_and_leaves_nothing(package, two_robots):
    before = list(sys.path)
    again = run(f"{NAME} bringup.launch.py", seconds=3.2, quiet=True)
    assert again.digest == two_robots.digest
    assert sys.path == before


def test_yaml_launches_the_same(package):
    path = package / "share" / NAME / "launch" / "bringup.launch.yaml"
    assert driven(run(path, seconds=3.2, quiet=True)) == DRIVES


@pytest.mark.parametrize(
    "how",
    [
        lambda path: (f"{path} speed:=0.75",),
        lambda path: (Process(str(path), arguments=["speed:=0.75"]),),
        lambda path: (Process(f"{NAME} {path.name}", arguments=["speed:=1.0", "speed:=0.75"]),),
    ],
)
def test_arguments_are_given_as_in_a_terminal(package, how):
    recording = run(*how(package / "share" / NAME / "launch" / "bringup.launch.py"), seconds=0.6, quiet=True)
    assert driven(recording) == {"/left/driver": [("/left/cmd_vel", 0.5, 0.75)]}


def test_launched_programs_run_on_the_host_of_their_launch_file(package):
    there = Process(f"{NAME} bringup.launch.py", host="robot")
    recording = run(there, seconds=0.5, quiet=True, network=Network(delay=0.1))
    assert recording.hosts["/left/driver"] == "robot"


def test_a_launch_file_plays(package):
    assert (
        driven(play(f"{NAME} bringup.launch.py", seconds=3.2, quiet=True, speed=float("inf")).result())
        == DRIVES
    )


def test_a_program_that_dies_is_respawned_and_handlers_are_called(package):
    recording = run(f"{NAME} respawn.launch.py", seconds=20, quiet=True)
    path = package / "lib" / NAME / "once"
    died = f"[pid {{}}, exit code 3, cmd '{path} 3 --ros-args']."
    assert logged(recording) == [
        "[INFO] [0.000] [once-1]: process started with pid [1]",
        "[INFO] [0.000] [driver-2]: process started with pid [2]",
        "[ERROR] [1.000] [once-1]: process has died " + died.format(1),
        "[INFO] [1.000] [launch.user]: exit 3",
        "[INFO] [1.500] [once-1]: process started with pid [3]",
        "[ERROR] [2.500] [once-1]: process has died " + died.format(3),
        "[INFO] [2.500] [launch.user]: exit 3",
        "[INFO] [3.000] [last-3]: process started with pid [4]",
        "[INFO] [3.000] [launch.user]: the last one",
        "[INFO] [4.000] [last-3]: process has finished cleanly [pid 4]",
        "[INFO] [4.000] [launch]: process[last-3] was required: shutting down launched system",
        "[INFO] [4.000] [driver-2]: sending signal 'SIGINT' to process[driver-2]",
        "[INFO] [4.000] [driver-2]: process has finished cleanly [pid 2]",
    ]
    assert [(error.stamp, error.type, error.text) for error in recording.errors] == [
        (1.0, "SystemExit", "3"),
        (2.5, "SystemExit", "3"),
    ]
    assert recording.ended.stamp == 5.0  # a second after the last has ended


TALKER = """
import sys
import helper
import rclpy
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions


def main():
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    node = Node("talker")
    node.get_logger().info(f"{helper.WORD} {sys.argv[1:2]}")
    while rclpy.ok():
        try:
            rclpy.spin(node)
        except KeyboardInterrupt:
            node.get_logger().info("I stay")


if __name__ == "__main__":
    main()
"""


def description(tmp_path, *lines):
    """A launch file with these entities, beside a talker that ignores SIGINT."""
    (tmp_path / "talker.py").write_text(TALKER)
    (tmp_path / "helper.py").write_text("WORD = 'hello'\n")
    begin = "".join(f"from {it} import *\n" for it in ("launch", "launch.actions", "launch_ros.actions"))
    begin += "def generate_launch_description():\n    return LaunchDescription(["
    file = tmp_path / "some.launch.py"
    file.write_text(begin + ", ".join(lines) + "])\n")
    return file


def test_a_file_is_a_program_and_one_that_ignores_sigint_is_killed(tmp_path):
    talker = (
        f"ExecuteProcess(cmd=['python3', '-u', '{tmp_path}/talker.py', 'x'], additional_env={{'WORD': '1'}})"
    )
    recording = run(
        description(tmp_path, talker, "TimerAction(period=1.0, actions=[Shutdown()])"), seconds=30, quiet=True
    )
    path = tmp_path / "talker.py"
    assert logged(recording) == [
        "[WARN] [0.000] [launch]: All programs of a run share one environment: WORD is not set.",
        "[INFO] [0.000] [python3-1]: process started with pid [1]",
        "[INFO] [0.000] [talker]: hello ['x']",
        "[INFO] [1.000] [python3-1]: sending signal 'SIGINT' to process[python3-1]",
        "[INFO] [1.000] [talker]: I stay",
        "[ERROR] [6.000] [python3-1]: process[python3-1] failed to terminate '5' seconds after receiving "
        "'SIGINT', escalating to 'SIGTERM'",
        "[INFO] [6.000] [python3-1]: sending signal 'SIGTERM' to process[python3-1]",
        f"[ERROR] [6.000] [python3-1]: process has died [pid 1, exit code -15, cmd 'python3 -u {path} x'].",
    ]


@pytest.mark.parametrize("order", ["3", "4", "8"])
def test_a_program_that_is_stopped_before_it_has_started_ends(tmp_path, order):
    node = tmp_path / "node.py"
    node.write_text("import rclpy\nfrom rclpy.node import Node\nrclpy.init()\nrclpy.spin(Node('a'))\n")
    program = f"ExecuteProcess(cmd=['python3', '{node}'])"
    file = description(tmp_path, program, "TimerAction(period=0.1, actions=[Shutdown()])")
    recording = run(file, seconds=30, quiet=True, order=order)
    assert recording.ended.reason == "finished"
    assert "/a" not in recording.graph.nodes
    last = recording.logs[-1].text
    assert last == f"process has died [pid 1, exit code -2, cmd 'python3 {node}']."


def test_a_ros2_command_is_a_program(tmp_path):
    file = description(tmp_path, "ExecuteProcess(cmd=['ros2', 'pkg', 'prefix', 'std_msgs'])")
    recording = run(file, seconds=2, quiet=True)
    assert "".join(text for _, text in recording.prints) == f"{sys.prefix}\n"


@pytest.mark.parametrize(
    ("lines", "kind", "words"),
    [
        (
            ["Node(package='no_such', executable='x')"],
            "PackageNotFoundError",
            "\"package 'no_such' not found, searching:",
        ),
        (
            ["Node(package='two_robots', executable='drivr')"],
            "SubstitutionFailure",
            "executable 'drivr' not found on the libexec directory '",
        ),
        (["DeclareLaunchArgument('speed')"], "RuntimeError", "Included launch description missing required"),
        (
            ["ExecuteProcess(cmd=['no.py'])"],
            "UnsupportedProgram",
            "[Errno 2] No such file or directory: 'no.py'",
        ),
        (["1 / 0"], "ZeroDivisionError", "division by zero"),
    ],
)
def test_a_failing_launch_is_an_error_of_the_run(package, tmp_path, lines, kind, words):
    recording = run(description(tmp_path, *lines), seconds=2, quiet=True)
    (error,) = recording.errors
    assert (error.node, error.callback, error.type) == ("/launch", "launch", kind)
    assert error.text.startswith(words)


@pytest.mark.parametrize(
    ("entity", "program"),
    [
        ("ExecuteProcess(cmd=['bash', '-c', 'sleep 1'])", "`bash`"),
        ("ExecuteProcess(cmd=['  '], shell=True)", "an empty command"),
        ("ExecuteProcess(cmd=['ls | wc'], shell=True)", "`ls`"),
        ("ExecuteProcess(cmd=['python3', '-c', '1'])", "`python3 -c 1`"),
        ("Node(package='two_robots', executable='binary')", "`{package}/lib/two_robots/binary`"),
    ],
)
def test_a_command_that_is_not_python_is_refused_with_advice(package, tmp_path, entity, program):
    recording = run(description(tmp_path, entity), seconds=2, quiet=True)
    (error,) = recording.errors
    assert error.text == (
        f"In a run, launch starts only Python programs and ros2 commands, and "
        f"{program.format(package=package)} is neither: `ros2 launch` in a terminal starts anything."
    )
    (line,) = recording.logs
    assert line.text == f"exception occurred while executing process: {error.text}"


def test_programs_with_a_window_are_left_out_with_a_warning_and_the_others_run(tmp_path):
    windows = (("rviz2", "rviz2"), ("rqt_graph", "rqt_graph"), ("plotjuggler", "plotjuggler"))
    nodes = [f"Node(package={package!r}, executable={name!r})" for package, name in windows]
    talker = f"ExecuteProcess(cmd=['python3', '{tmp_path}/talker.py'])"
    recording = run(description(tmp_path, *nodes, talker), seconds=1, quiet=True)
    assert [line.text for line in recording.logs if line.level == "WARN"] == [
        "rviz2 is left out. `rviz2` (shows what robots see) is a ROS package that the course does not "
        "include. play(...) shows a run, and recording.replay() shows it again.",
        "rqt_graph is left out. `rqt_graph` (draws the ROS graph) is a ROS package that the course does not "
        "include. plot_graph(recording) of sim.view draws it, and so does play(...).",
        "plotjuggler is left out. `plotjuggler` only shows something in a window, and the course has none.",
    ]
    assert [line.text for line in recording.logs if line.node == "talker"] == ["hello []"]
    assert (recording.errors, recording.graph.nodes, recording.ended.reason) == ([], ["/talker"], "time")


@pytest.mark.parametrize(
    ("words", "text"),
    [
        ("no.launch.py", "There is no launch file 'no.launch.py' in "),
        (
            "two_robots no.launch.py",
            "file 'no.launch.py' was not found in the share directory of package 'two_r",
        ),
        ("no_such x.launch.py", "Package 'no_such' not found: "),
        (
            "two_robots bringup.launch.py speed=1",
            "malformed launch argument 'speed=1', expected format '<name>",
        ),
    ],
)
def test_a_missing_launch_file_is_named(package, words, text):
    (error,) = run(words, seconds=1, quiet=True).errors
    assert error.type == "NoLaunchFile"
    assert error.text.startswith(text)


def test_a_misspelt_launch_file_or_package_gets_a_suggestion(package, monkeypatch):
    monkeypatch.chdir(package / "share" / NAME)
    share = f"the share directory of package '{NAME}' which is at '{package / 'share' / NAME}'"
    here = (
        f"There is no launch file {{!r}} in {package / 'share' / NAME}. Did you mean 'bringup.launch.{{}}'?"
    )
    sentences = {
        f"{NAME} bringp.launch.py": f"file 'bringp.launch.py' was not found in {share}. "
        "Did you mean 'bringup.launch.py'?",
        f"{NAME} zzz.launch.py": f"file 'zzz.launch.py' was not found in {share}",
        "two_robot bringup.launch.py": "Package 'two_robot' not found: did you mean two_robots?",
        "nav2_bringup bringup.launch.py": "Package 'nav2_bringup' not found: `nav2_bringup` (starts Nav2) is "
        "a ROS package that the course does not include.",
        "bringp.launch.py": here.format("bringp.launch.py", "py"),
        "launch/brinup.launch.yaml": here.format("launch/brinup.launch.yaml", "yaml"),
        "zzz.launch.py": f"There is no launch file 'zzz.launch.py' in {package / 'share' / NAME}.",
    }
    for arguments, sentence in sentences.items():
        with pytest.raises(NoLaunchFile) as refused:
            find_launch_file(arguments.split())
        assert str(refused.value) == sentence


def test_two_files_with_one_name_are_both_named(package, tmp_path, monkeypatch):
    prefix = install(tmp_path)
    monkeypatch.setenv("AMENT_PREFIX_PATH", sourced(prefix)["AMENT_PREFIX_PATH"])
    other = prefix / "share" / NAME / "one.launch.py"
    other.write_text("")
    (error,) = run(f"{NAME} one.launch.py", seconds=1, quiet=True).errors
    assert error.text == (
        f"file 'one.launch.py' was found more than once in the share directory of package '{NAME}': "
        f"['{prefix}/share/{NAME}/launch/one.launch.py', '{other}']"
    )


def test_a_launch_description_can_be_run(tmp_path):
    from launch import LaunchDescription
    from launch.actions import LogInfo

    assert logged(run(LaunchDescription([LogInfo(msg="hello")]), seconds=2, quiet=True)) == [
        "[INFO] [0.000] [launch.user]: hello"
    ]


def test_launch_of_a_ros_installation_is_refused(monkeypatch):
    other = type(sys)("launch")
    other.__file__ = "/opt/ros/jazzy/launch/__init__.py"
    monkeypatch.setitem(sys.modules, "launch", other)
    monkeypatch.delitem(sys.modules, "launch.processes", raising=False)
    (error,) = run("x.launch.py", seconds=1, quiet=True).errors
    assert error.text == (
        "`launch` is that of a ROS installation (/opt/ros/jazzy/launch/__init__.py), which starts real "
        "processes: use `ros2 launch`, or run this where no installation is sourced."
    )
