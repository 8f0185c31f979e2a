"""Of several start values of a parameter, a run says which one its node got, and why a later one lost."""

import pytest
from rclpy.node import Node

from sim import Process, run

WARNS = (
    "/arm: `speed` is 2.0 (arm.yaml); it was also given 1.0 (the launch file) and 3.0 (the launch file). "
    "ROS collects the values under each name of a node, in the order in which the names first occur, and "
    "the last name wins, here `/**`, then `arm`. Use one name in all of them."
)
FILES = {  # the name in the file, then what the launch file gives: the value, and what is logged
    "arm": (2.0, "WARN", WARNS),
    "/**": (
        3.0,
        "INFO",
        "/arm: `speed` is 3.0 (the launch file); it was also given 1.0 (the launch file) and 2.0 (arm.yaml).",
    ),
    "/leg": (3.0, "INFO", "/arm: `speed` is 3.0 (the launch file); it was also given 1.0 (the launch file)."),
}


class Arm(Node):
    def __init__(self):
        super().__init__("arm")
        self.declare_parameter("speed", 0.0)
        self.declare_parameter("limits.low", 0)
        self.declare_parameter("joints", [0.0])


def about(recording):
    return [(line.level, line.text) for line in recording.logs if line.node == "parameters"]


def given_three_times(tmp_path, name):
    """A launch file that gives an arm's speed in a dict, in a file under this name, and in another dict."""
    (tmp_path / "arm.yaml").write_text(f"{name}:\n  ros__parameters:\n    speed: 2.0\n")
    (tmp_path / "arm.py").write_text(
        "import rclpy\nrclpy.init()\nnode = rclpy.create_node('arm')\n"
        "print(node.declare_parameter('speed', 0.0).value)\nrclpy.spin(node)\n"
    )
    file = tmp_path / "arm.launch.py"
    file.write_text(
        "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
        "def generate_launch_description():\n"
        f"    values = [{{'speed': 1.0}}, '{tmp_path}/arm.yaml', {{'speed': 3.0}}]\n"
        f"    words = ['{tmp_path}/arm.py']\n"
        "    arm = Node(executable='python3', arguments=words, name='arm', parameters=values)\n"
        "    return LaunchDescription([arm])\n"
    )
    return file


@pytest.mark.parametrize("name", FILES)
def test_a_dict_a_file_and_a_dict(name, tmp_path):
    recording = run(given_three_times(tmp_path, name), seconds=1, quiet=True)
    value, level, line = FILES[name]
    assert "".join(text for _, text in recording.prints) == f"{value}\n"
    assert about(recording) == [(level, line)]
    assert recording.end_logs == []
    assert recording.errors == []


@pytest.mark.parametrize(
    ("parameters", "lines"),
    [
        ([{"speed": 1.0}, {"speed": 1.0}], []),
        ([{"speed": 1.0}, {"limits.low": 2}], []),
        (
            [{"joints": [1.0]}, {"joints": [1.0, 2.0]}],
            ["/arm: `joints` is [1.0, 2.0] (an argument); it was also given [1.0] (an argument)."],
        ),
        (
            [{"speed": 1.0}, {"speed": 2.0}],
            ["/arm: `speed` is 2.0 (an argument); it was also given 1.0 (an argument)."],
        ),
    ],
)
def test_only_different_values_of_one_parameter_are_news(parameters, lines):
    recording = run(Process(Arm, parameters=parameters), seconds=0.5, quiet=True)
    assert about(recording) == [("INFO", line) for line in lines]


@pytest.mark.parametrize(
    ("name", "level"),
    [("/*", "INFO"), ("/**/arm", "INFO"), ("other", None), ("/left/arm", None), ("ar", None)],
)
def test_names_with_wildcards_are_understood_as_rcl_does(name, level, tmp_path):
    file = tmp_path / "a.yaml"
    file.write_text(f"{name}:\n  ros__parameters:\n    limits:\n      low: 2\n")
    words = ["--ros-args", "-p", "arm:limits.low:=1", "--params-file", str(file)]
    recording = run(Process(Arm, arguments=words), seconds=0.5, quiet=True)
    found = f"/arm: `limits.low` is 2 ({file.name}); it was also given 1 (an argument)."
    assert about(recording) == ([(level, found)] if level else [])


def test_what_is_in_a_namespace_is_under_it(tmp_path):
    file = tmp_path / "a.yaml"
    file.write_text(
        "left:\n  arm:\n    ros__parameters: {speed: 2.0}\n/right/arm:\n  ros__parameters: {speed: 3.0}\n"
    )
    words = ["--ros-args", "-p", "speed:=1.0", "--params-file", str(file)]
    recording = run(Process(Arm, namespace="left", arguments=words), seconds=0.5, quiet=True)
    assert about(recording) == [
        ("INFO", "/left/arm: `speed` is 2.0 (a.yaml); it was also given 1.0 (an argument).")
    ]
