"""launch_pytest in a run: the processes of a launch file are programs of the run."""

import re
import subprocess
import sys

import pytest

from sim import run
from sim.absent_packages import explain
from tests.ros_packages.test_launch_pytest import HEAD, OPTIONS, PLUGIN

IN_A_RUN = """
import rclpy
from launch_ros.actions import Node
from std_msgs.msg import String

@pytest.fixture
def talker():
    return Node(
        package="demo_nodes_py", executable="talker", namespace="a", remappings=[("chatter", "talk")],
        cached_output=True,
    )

@launch_pytest.fixture
def description(talker):
    return LaunchDescription([talker])

@pytest.mark.launch(fixture=description)
def test_messages_arrive(talker, launch_context):
    rclpy.init()
    node = rclpy.create_node("test")
    received = []
    node.create_subscription(String, "/a/talk", lambda msg: received.append(msg.data), 10)
    while len(received) < 2:
        rclpy.spin_once(node)
    assert received == ["Hello World: 0", "Hello World: 1"]
    process_tools.assert_stderr_sync(launch_context, talker, lambda text: "World: 3" in text, timeout=3.0)
    assert not process_tools.wait_for_exit_sync(launch_context, talker, timeout=0.5)
    rclpy.shutdown()
    yield
    assert talker.return_code == 0
"""


def test_in_a_run_the_processes_are_programs_of_the_run(tmp_path):
    (tmp_path / "test_it.py").write_text(HEAD + IN_A_RUN)
    codes = []

    def tests() -> None:
        options = ["-s", "--tb=short", "-o", "addopts=", "--rootdir", str(tmp_path)]
        codes.append(pytest.main([*OPTIONS, *options, *PLUGIN, str(tmp_path)]))

    recording = run(tests, seconds=60)
    assert [int(code) for code in codes] == [0]
    assert recording.ended.reason == "finished"
    logged = [line.text for line in recording.logs if line.node == "talker-1"]
    assert logged == [
        "process started with pid [1]",
        "sending signal 'SIGINT' to process[talker-1]",
        "process has finished cleanly [pid 1]",
    ]


def test_a_launch_service_of_a_program_starts_programs_of_the_run():
    statuses = []

    def program() -> None:
        from launch import LaunchDescription, LaunchService
        from launch.actions import Shutdown, TimerAction
        from launch_ros.actions import Node

        service = LaunchService()
        talker = Node(package="demo_nodes_py", executable="talker")
        shutdown = TimerAction(period=3.5, actions=[Shutdown()])
        service.include_launch_description(LaunchDescription([talker, shutdown]))
        statuses.append(service.run())

    recording = run(program, seconds=60)
    assert statuses == [0]
    assert [row.stamp for row in recording.messages("/chatter")] == [1.0, 2.0, 3.0]


@pytest.mark.parametrize("name", ["launch_testing", "launch_testing_ros.actions"])
def test_a_test_that_imports_launch_testing_gets_the_sentence_of_a_run(tmp_path, name):
    (tmp_path / "test_file.py").write_text(f"import {name}\n")
    (tmp_path / "test_body.py").write_text(f"def test_it():\n    from {name} import x\n")
    (tmp_path / "test_other.py").write_text("def test_it():\n    import nothing_of_this_name\n")
    command = [sys.executable, "-m", "pytest", *OPTIONS, *PLUGIN, "--continue-on-collection-errors", "."]
    out = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False).stdout
    heading = re.escape(" What to do ")
    found = re.findall(rf"^-+{heading}-+\n(.*)$", out, re.MULTILINE)
    assert found == [explain(name.partition(".")[0])] * 2
