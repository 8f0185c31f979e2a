"""Tests of a package, run by pytest in simulated time, on its own module and on others."""

import pytest
from rclpy.node import Node
from std_msgs.msg import String

from grader.companions.qos import LATCHED
from grader.companions.test_runner import CANDIDATES, VERDICTS, run_tests
from sim import run

TEST = """\
import time

import pytest
import rclpy
from steady.node import Steady


def test_a_name():
    rclpy.init()
    node = Steady()
    began = time.monotonic()
    rclpy.spin_once(node, timeout_sec=5.0)
    assert time.monotonic() - began >= 5.0
    rclpy.shutdown()
    assert node.get_name() == "steady"


@pytest.fixture
def broken():
    raise ValueError("no set-up")


def test_a_number():
    assert Steady.number == 7
"""
NODE = "from rclpy.node import Node\n\n\nclass Steady(Node):\n    number = 7\n\n    def __init__(self):\n        super().__init__('steady')\n"


class Sender(Node):
    """Publishes candidates, each after the verdict before it."""

    def __init__(self):
        super().__init__("sender")
        self.left = [
            f"same\n{NODE}",
            "seven\n" + NODE.replace("7", "8"),
            "other\n" + NODE.replace("'steady'", "'other'"),
            "broken\nfrom nowhere import nothing",
        ]
        self.publisher = self.create_publisher(String, CANDIDATES, LATCHED)
        self.create_subscription(String, VERDICTS, self.on_verdict, 10)

    def on_verdict(self, _):
        if self.left:
            self.publisher.publish(String(data=self.left.pop(0)))


def verdicts(folder, test=TEST):
    """What is published about the package, and about each candidate."""
    for path, text in {"test/test_it.py": test, "steady/node.py": NODE, "steady/__init__.py": ""}.items():
        file = folder / "src/steady" / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    program = run_tests(folder, "steady", "steady/node.py")
    recording = run(
        program, companions=[Sender], seconds=100, until=lambda run: len(run.messages(VERDICTS)) > 4
    )
    assert recording.errors == []
    return [received.message.data for received in recording.messages(VERDICTS)]


def test_a_verdict_names_the_candidate_and_what_failed(tmp_path):
    assert verdicts(tmp_path) == [
        "own passed 2 OK",
        "same passed 2 OK",
        "seven failed 2 test_a_number: assert 8 == 7",
        "other failed 2 test_a_name: AssertionError: assert 'other' == 'steady'",
        "broken failed 0 ModuleNotFoundError: No module named 'nowhere'",
    ]


def test_a_set_up_that_fails_and_a_test_without_end_are_failures(tmp_path):
    assert verdicts(tmp_path, TEST.replace("test_a_number()", "test_a_number(broken)"))[0] == (
        "own failed 1 test_a_number: ValueError: no set-up"
    )


LAUNCH_TEST = """\
import asyncio
import threading
import time

import launch_pytest
import pytest
from launch import LaunchDescription, LaunchService
from launch_ros.actions import Node


def description():
    return LaunchDescription([Node(package="demo_nodes_py", executable="talker")])


@launch_pytest.fixture
def launched():
    return description()


@pytest.mark.launch(fixture=launched)
def test_it(launch_context):
    assert not launch_context.is_shutdown
"""
LEFT_RUNNING = """

def test_what_stays():
    service = LaunchService()
    service.include_launch_description(description())
    threading.Thread(target=lambda: asyncio.run(service.run_async()), daemon=True).start()
    time.sleep(1.0)
"""


@pytest.mark.parametrize(
    ("test", "verdict"),
    [
        (LAUNCH_TEST, "own passed 1 OK"),
        (LAUNCH_TEST + LEFT_RUNNING, "own failed 1 left running: talker"),
    ],
)
def test_a_launch_test_has_to_end_what_it_starts(tmp_path, test, verdict):
    file = tmp_path / "src/steady/test/test_it.py"
    file.parent.mkdir(parents=True)
    file.write_text(test)
    program = run_tests(tmp_path, "steady", "launch/it.launch.py", True)
    recording = run(program, companions=[Sender], seconds=30, until=lambda run: bool(run.messages(VERDICTS)))
    assert recording.messages(VERDICTS)[0].message.data == verdict
