"""What was typed in terminals, typed again in a run."""

import itertools
from dataclasses import replace

import pytest

from sim import run
from sim.ros2.cli_program import terminal
from sim.ros2.typed_lines import InvalidLine, Line, lines_of, words_of
from sim.ros2.typed_session import terminals

DRIVER = """\
#!/usr/bin/env python3
import rclpy
from geometry_msgs.msg import Twist
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node


class Driver(Node):
    def __init__(self):
        super().__init__("driver")
        self.declare_parameter("speed", 0.1)
        self.commands = self.create_publisher(Twist, "drive", 10)
        self.create_timer(0.1, self.drive)

    def drive(self):
        command = Twist()
        command.linear.x = self.get_parameter("speed").value
        self.commands.publish(command)


rclpy.init()
try:
    rclpy.spin(Driver())
except (KeyboardInterrupt, ExternalShutdownException):
    print("The driver ends")
"""
LAUNCH = """\
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([Node(package="demo", executable="driver", remappings=[("drive", "cmd_vel")])])
"""
SET_UP = "cd ws\ncolcon build\nsource install/setup.bash\nexport ROS_DOMAIN_ID=42\n"
DRIVE = "ros2 run demo driver --ros-args -r drive:=cmd_vel"


@pytest.fixture
def prefix(tmp_path, monkeypatch):
    for path, text in {
        "share/ament_index/resource_index/packages/demo": "",
        "share/demo/demo.launch.py": LAUNCH,
        "lib/demo/driver": DRIVER,
    }.items():
        file = tmp_path / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        file.chmod(0o755)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    return tmp_path


@pytest.fixture
def typed(prefix):
    return lambda text, seconds=25: run(
        terminals(text, prefix), world="yard", seconds=seconds, quiet=True, expect_error=True
    )


def shown(recording):
    return "".join(text for _, text in recording.prints).splitlines()


def commands(recording):
    """Speeds on /cmd_vel, each with the stamps of its first and last command."""
    rows = [(row.message.linear.x, row.stamp) for row in recording.messages("/cmd_vel")]
    found = itertools.groupby(rows, key=lambda row: row[0])
    groups = [(speed, [stamp for _, stamp in group]) for speed, group in found]
    return [(speed, stamps[0], stamps[-1]) for speed, stamps in groups]


def test_a_program_is_built_started_changed_and_ended(typed):
    recording = typed(
        f"# terminal 1\n{SET_UP}{DRIVE}\n"
        "# terminal 2\nexport ROS_DOMAIN_ID=42\nsleep 2\nros2 param set /driver speed 0.3\n"
        "# terminal 1\nCtrl-C after 3 s\n"
    )
    assert shown(recording) == [
        "terminal 1, line 2 $ cd ws",
        "terminal 1, line 3 $ colcon build",
        "Summary: 1 package finished",
        "terminal 1, line 4 $ source install/setup.bash",
        "terminal 1, line 5 $ export ROS_DOMAIN_ID=42",
        f"terminal 1, line 6 $ {DRIVE}",
        "terminal 2, line 8 $ export ROS_DOMAIN_ID=42",
        "terminal 2, line 9 $ sleep 2",
        "terminal 2, line 10 $ ros2 param set /driver speed 0.3",
        "Set parameter successful",
        "terminal 1, line 12 $ Ctrl-C after 3 s",
        "The driver ends",
    ]
    slow, fast = commands(recording)
    assert slow == (0.1, pytest.approx(5.1), pytest.approx(10.0, abs=0.11))
    assert fast == (0.3, pytest.approx(10.1, abs=0.11), pytest.approx(14.0, abs=0.11))
    assert recording.all_exited_at == pytest.approx(14.0, abs=0.3)
    assert (recording.errors, recording.end_errors) == ([], [])


def test_a_launch_file_is_started_and_ended(typed):
    recording = typed(f"{SET_UP}ros2 launch demo demo.launch.py\nctrl+c after 2 s\n")
    assert 7.5 < commands(recording)[0][2] < 10.0  # launch ends its programs one after the other
    assert recording.all_exited_at is not None
    assert recording.errors == []


def test_the_program_that_one_command_starts_takes_its_place(prefix):
    for command in (DRIVE, "ros2 launch demo demo.launch.py"):
        recording = run(terminal(command), world="yard", seconds=3, quiet=True)
        assert {row.sender for row in recording.messages("/cmd_vel")} == {"/driver"}


def test_programs_run_until_the_run_ends(typed):
    recording = typed(f"{SET_UP}{DRIVE}\n", 8)
    assert recording.all_exited_at is None
    assert commands(recording)[0][2] == pytest.approx(8.0, abs=0.11)


def test_a_variable_may_be_given_to_one_command(typed):
    lines = shown(
        typed("ROS_DOMAIN_ID=42 ros2 node list\nros2 node list\nROS_DOMAIN_ID=42\nros2 node list\n")
    )
    assert lines.count("/robot") == 2


def test_what_other_set_ups_are_typed_and_what_only_looks_is_accepted(typed):
    text = "source /opt/ros/jazzy/setup.bash\nsource ../.venv/bin/activate\nls\npwd\nclear\n"
    lines = shown(typed(f"{text}cd\ncd /home/ann/ws\ncolcon build\n. install/local_setup.sh\n"))
    assert [line for line in lines if "failed" in line] == []


def test_the_robot_is_there_already(typed):
    lines = shown(typed("python -m sim --world room\nls\nCtrl-C\nls\n"))
    assert lines == [
        "terminal 1, line 1 $ python -m sim --world room",
        "terminal 1, line 2 $ ls",
        "python -m sim is running in terminal 1: open another one",
        "[line 2 failed]",
        "terminal 1, line 3 $ Ctrl-C",
        "terminal 1, line 4 $ ls",
    ]


def test_a_terminal_is_busy_until_its_program_has_ended(typed):
    recording = typed(f"{SET_UP}{DRIVE}\nls\nls\n")
    assert shown(recording)[-3:] == [
        "terminal 1, line 6 $ ls",
        "line 5 is still running in terminal 1",
        "[line 6 failed]",
    ]


def test_what_waits_for_a_name_that_is_not_there_is_ended_before_the_next_line(typed):
    waiting = "ros2 topic echo /nothing std_msgs/msg/String"
    recording = typed(f"export ROS_DOMAIN_ID=42\n{waiting}\nls\nls\n", seconds=30)
    assert shown(recording)[-5:] == [
        "terminal 1, line 3 $ ls",
        "line 2 is still running in terminal 1",
        "[line 3 failed]",
        "terminal 1, line 3 $ ls",
        "terminal 1, line 4 $ ls",
    ]


def test_the_robot_may_be_in_another_domain(typed):
    lines = shown(
        typed(
            "python -m sim --world room --domain 7\n# terminal 2\nROS_DOMAIN_ID=7 ros2 node list\n"
            "ROS_DOMAIN_ID=42 ros2 node list\n"
        )
    )
    assert lines.count("/robot") == 1
    assert lines[-2] == "There are no nodes on ROS domain 42, but on 7: export ROS_DOMAIN_ID=7"


FAILURES = {
    "rso2 run demo driver": "rso2: command not found. Did you mean ros2?",
    "drive": "drive: command not found",
    "ros2 run demo driver | head": "`|` needs a shell, but there is none here: leave it out",
    "ros2 run demo driver &": (
        "`&` needs a shell, but there is none here: open another terminal for the next command"
    ),
    "cd ws && colcon build": (
        "`&&` needs a shell, but there is none here: type each command on a line of its own"
    ),
    "cd $HOME": "`$` needs a shell, but there is none here: type the value itself",
    "ros2 topic pub /x (data)": (
        "`(` needs a shell, but there is none here: put quotes round a value that has it"
    ),
    "ros2 topic list '": "bash: No closing quotation: a quote that is opened has to be closed",
    "colcon test": "colcon test is not executed here: colcon build is",
    "colcon build": "Summary: 0 packages finished: type colcon build in the workspace, the folder ws",
    "cd ws\ncolcon build --packages-select domo --symlink-install": (
        "Summary: 0 packages finished: there is no package 'domo'"
    ),
    "source ws/install/setup.bash": (
        "bash: ws/install/setup.bash: No such file or directory: colcon build makes it"
    ),
    "cd ws\ncolcon build\nsource ws/install/setup.bash": (
        "bash: ws/install/setup.bash: No such file or directory: cd to the right folder first"
    ),
    "source": "bash: : No such file or directory: cd to the right folder first",
    "ros2 run demo driver": "Package 'demo' not found: it is not built",
    "cd ws\ncolcon build\nros2 run demo driver": (
        "Package 'demo' not found: source ws/install/setup.bash was not typed in this terminal"
    ),
    "ros2 topic list": "There are no nodes on ROS domain 0, but on 42: export ROS_DOMAIN_ID=42",
    "export ROS_DOMAIN_ID=7\nros2 topic list": (
        "There are no nodes on ROS domain 7, but on 42: export ROS_DOMAIN_ID=42"
    ),
    "sleep long": "sleep: invalid time interval 'long'",
    f"{SET_UP}ros2 run demo diver": (
        "No executable found: demo has driver, but no diver. Did you mean driver? Changes in"
    ),
    f"{SET_UP}ros2 run dem driver": "Package 'dem' not found: did you mean demo?",
    f"{SET_UP}ros2 run demo": "ros2 run: error: the following arguments are required: executable_name, argv",
    f"{SET_UP}ros2 launch demo dem.launch.py": "file 'dem.launch.py' was not found in the share directory",
    f"{SET_UP}ros2 node info /drivr": "Unable to find node '/drivr'",
}


@pytest.mark.parametrize("text", FAILURES)
def test_a_line_that_fails_is_reported(typed, text):
    lines = shown(typed(text))
    number = text.count("\n") + 1
    assert lines[-1] == f"[line {number} failed]"
    assert lines[-2].startswith(FAILURES[text])


def test_the_lines_after_one_that_fails_are_typed(typed):
    assert shown(typed("drive\nls\n"))[-1] == "terminal 1, line 2 $ ls"


def test_lines_have_terminals_and_numbers():
    text = "ls\n\n# Terminal two:\n$ pwd # here\n# a remark\nros2 x \\\n  'a\n  b'\n## terminal 1\nls"
    assert list(lines_of(text)) == [
        *(Line(1, "1", "ls"), Line(4, "two", "pwd # here"), Line(6, "two", "ros2 x    'a\n  b'")),
        Line(10, "1", "ls"),
    ]


def test_a_quote_that_is_never_closed_ends_after_thirty_lines():
    first, *others = lines_of("ros2 topic list '\n" + "ls\n" * 5_000)
    assert (first.number, first.text.count("\n")) == (1, 30)
    assert [line.text for line in others] == ["ls"] * (5_000 - 30)
    with pytest.raises(InvalidLine, match="a quote that is opened has to be closed"):
        words_of(first.text)


def test_a_value_in_quotes_is_one_word():
    assert words_of("ros2 x \"{a: 'b|c'}\" '$d' # e") == ["ros2", "x", "{a: 'b|c'}", "$d"]
    with pytest.raises(InvalidLine, match=r"^`>` needs a shell"):
        words_of("ros2 x > y")


NEARLY = {
    "nothing is set up": DRIVE,
    "a typo in each word": f"{SET_UP}rso2 rum dmo drivr --ros-args -r driv:=cmd_val",
    "in one line": f"cd ws && colcon build && source install/setup.bash\n{DRIVE} &",
    "in the robot's terminal": f"python -m sim --world room --domain 7\n{SET_UP}{DRIVE}",
}


@pytest.mark.parametrize("text", NEARLY.values(), ids=NEARLY)
def test_a_lenient_run_types_it_as_it_was_meant(prefix, text):
    program = terminals(text, prefix)
    plain = run(program, world="room", seconds=20, quiet=True, expect_error=True)
    assert not [row for row in plain.messages("/cmd_vel") if row.sender == "/driver"]
    lenient = run(replace(program, lenient=True), world="room", seconds=20, quiet=True, expect_error=True)
    assert len([row for row in lenient.messages("/cmd_vel") if row.sender == "/driver"]) > 20


CREATE = "ros2 pkg create --build-type ament_python --node-name hello greeter --dependencies rclpy"


def test_a_package_is_created_built_and_started(typed):
    text = f"cd ws/src\n{CREATE}\n{CREATE}\ncd ..\ncolcon build\nsource install/setup.bash\n"
    text += "export ROS_DOMAIN_ID=42\nros2 run greeter hello\nros2 pkg executables greeter\n"
    lines = shown(typed(text))
    created = lines[lines.index("going to create a new package") :]
    assert created[1:3] == ["package name: greeter", "destination directory: /home/you/ws/src"]
    assert {"build type: ament_python", "dependencies: ['rclpy']", "node_name: hello"} < {*created}
    assert "creating ./greeter/greeter/hello.py" in created
    assert lines[-5:] == [
        "terminal 1, line 7 $ export ROS_DOMAIN_ID=42",
        "terminal 1, line 8 $ ros2 run greeter hello",
        "Hi from greeter.",
        "terminal 1, line 9 $ ros2 pkg executables greeter",
        "greeter hello",
    ]
    second = lines.index(f"terminal 1, line 3 $ {CREATE}")
    assert lines[second + 2 : second + 5] == [
        "The directory already exists: ./greeter",
        "Either remove the directory or choose a different destination directory or package name",
        "[line 3 failed]",
    ]
    assert "Summary: 2 packages finished" in lines
    lines = shown(typed("cd ws\ncolcon build\n"))
    assert lines[-1] == "Summary: 1 package finished", "the next session begins without it"


CREATED = {
    f"{SET_UP}cd src\n{CREATE}\nros2 run greeter hello": "Package 'greeter' not found: it is not built",
    f"{SET_UP}cd src\n{CREATE}\ncd ..\ncolcon build\nros2 run greeter hello": (
        "Package 'greeter' not found: source ws/install/setup.bash again, because it was built later"
    ),
    f"{CREATE}\ncd ws\ncolcon build --packages-select greeter": (
        "Summary: 0 packages finished: there is no package 'greeter'"
    ),
    "ros2 pkg create": "ros2 pkg create: error: the following arguments are required: package_name",
    "ros2 pkg create ../x": "'../x' is no name: use letters, digits and underscores",
}


@pytest.mark.parametrize("text", CREATED)
def test_a_line_about_a_new_package_that_fails_is_reported(typed, text):
    lines = shown(typed(text))
    assert (lines[-2], lines[-1]) == (CREATED[text], f"[line {text.count(chr(10)) + 1} failed]")


def test_the_help_of_pkg_create_is_no_failure(typed):
    assert shown(typed("ros2 pkg create --help"))[-1] != "[line 1 failed]"
