"""The programs of demo_nodes_py, as tutorials and launch files start them."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from rcl_interfaces.msg import Parameter, ParameterValue
from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node

from sim import Process, executable, run
from sim.ros.packages import ExecutableNotFound

SERIALIZED = rb"b'\x00\x01\x00\x00\x0f\x00\x00\x00Hello World: 0\x00'".decode()
SERVER = "set_parameters_callback"
LAUNCH = """
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package="demo_nodes_py", executable="talker", remappings=[("chatter", "words")]),
        Node(package="demo_nodes_py", executable="listener", name="ear", remappings=[("chatter", "words")]),
    ])
"""


def program(name: str, arguments: str = "") -> Process:
    return Process(executable("demo_nodes_py", name), arguments=arguments.split())


def log(recording) -> list[tuple[str, str]]:
    assert [error.says for error in recording.errors] == []
    started = "process started with pid"
    return [(line.node, line.text) for line in recording.logs if not line.text.startswith(started)]


def test_a_listener_receives_what_a_talker_publishes():
    recording = run(program("talker"), program("listener"), program("listener_serialized"), seconds=2.5)
    assert log(recording) == [
        ("talker", 'Publishing: "Hello World: 0"'),
        ("listener", "I heard: [Hello World: 0]"),
        ("serialized_subscriber", rf'I heard: "{SERIALIZED}"'),
        ("talker", 'Publishing: "Hello World: 1"'),
        ("listener", "I heard: [Hello World: 1]"),
        ("serialized_subscriber", rf'I heard: "{SERIALIZED}"'.replace("World: 0", "World: 1")),
    ]


def test_a_launch_file_starts_both_under_other_names(tmp_path):
    path = tmp_path / "talk.launch.py"
    path.write_text(LAUNCH)
    recording = run(path, seconds=1.5, quiet=True)
    assert log(recording) == [
        ("talker", 'Publishing: "Hello World: 0"'),
        ("ear", "I heard: [Hello World: 0]"),
    ]
    assert [message.message.data for message in recording.messages("/words")] == ["Hello World: 0"]


@pytest.mark.parametrize("client", ["add_two_ints_client", "add_two_ints_client_async"])
def test_clients_wait_for_the_service_and_call_it(client):
    def late_server():
        time.sleep(1.5)
        executable("demo_nodes_py", "add_two_ints_server")()

    recording = run(late_server, program(client), seconds=4, quiet=True)
    assert log(recording) == [
        ("add_two_ints_server", "Incoming request\na: 2 b: 3"),
        ("add_two_ints_client", "Result of add_two_ints: 5"),
    ]
    printed = "".join(text for _, text in recording.prints)
    assert printed == "service not available, waiting again...\n"


def test_the_programs_with_quality_of_service_end_after_their_cycles():
    recording = run(
        program("talker_qos", "--reliable -n 2"), program("listener_qos", "-n 1"), seconds=5, quiet=True
    )
    assert sorted(log(recording)) == [
        ("listener_qos", "Best effort listener"),
        ("listener_qos", "I heard: [Hello World: 0]"),
        ("talker_qos", 'Publishing: "Hello World: 0"'),
        ("talker_qos", 'Publishing: "Hello World: 1"'),
        ("talker_qos", "Reliable talker"),
    ]


class Setter(Node):
    """Sets a parameter of the node set_parameters_callback, and looks at both afterwards."""

    def __init__(self):
        super().__init__("setter")
        group = ReentrantCallbackGroup()
        self.set = self.create_client(SetParameters, f"{SERVER}/set_parameters", callback_group=group)
        self.get = self.create_client(GetParameters, f"{SERVER}/get_parameters", callback_group=group)
        self.timer = self.create_timer(0.5, self.change)

    async def change(self):
        self.timer.cancel()
        new = Parameter(name="param1", value=ParameterValue(type=3, double_value=1.0))
        answer = await self.set.call_async(SetParameters.Request(parameters=[new]))
        self.get_logger().info(" ".join(result.reason for result in answer.results))
        found = await self.get.call_async(GetParameters.Request(names=["param1", "param2"]))
        self.get_logger().info(" ".join(f"{value.double_value}" for value in found.values))


def test_setting_one_parameter_sets_the_other():
    recording = run(program("set_parameters_callback"), Setter, seconds=2, quiet=True)
    assert [text for node, text in log(recording) if node == "setter"][-1] == "1.0 4.0"


def test_a_program_that_the_course_lacks_is_refused_with_those_that_there_are():
    with pytest.raises(ExecutableNotFound) as refused:
        executable("demo_nodes_py", "talkr")
    assert str(refused.value) == (
        "No executable found: demo_nodes_py has add_two_ints_client, add_two_ints_client_async, "
        "add_two_ints_server, listener, listener_qos, listener_serialized, set_parameters_callback, talker, "
        "talker_qos, but no talkr. Did you mean talker?"
    )


def test_ros2_run_starts_a_talker_in_a_terminal():
    ros2 = Path(sys.executable).with_name("ros2")
    command = [ros2, "run", "demo_nodes_py", "talker"]
    process = subprocess.Popen(
        command, stderr=subprocess.PIPE, text=True, env={**os.environ, "ROS_DOMAIN_ID": "87"}, process_group=0
    )
    try:
        assert 'Publishing: "Hello World: 0"' in process.stderr.readline()
    finally:
        os.killpg(process.pid, signal.SIGINT)
        process.communicate()
