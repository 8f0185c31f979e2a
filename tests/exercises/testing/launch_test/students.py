"""Workspaces for testing.launch_test: tests that catch wrong launch files only, then others."""

from grader.exercises.testing.launch_test.launch_candidates import GIVEN
from tests.students.workspaces import Workspace, changed, package

PARTS = ("NODE", "CONFTEST", "HEAD", "TESTS", "RIGHT", "TEST", "but", "tests", "IN_ONE_LAUNCH", "ON_THE_TEXT")
TEST = "speed_guard/test/test_launch.py"
NODE = """\
import sys

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float64


class Guard(Node):
    def __init__(self, limits):
        super().__init__("limiter" if limits else "relay")
        self.declare_parameter("limit", 0.5)  # m/s, forward
        self.declare_parameter("backward_limit", 0.5)  # m/s
        self.limits = limits
        self.speeds = self.create_publisher(Float64, "speed", 10)
        self.create_subscription(Float64, "request", self.on_request, 10)

    def on_request(self, msg):
        limit, backward = (self.get_parameter(name).value for name in ("limit", "backward_limit"))
        speed = max(-backward, min(limit, msg.data)) if self.limits else msg.data
        self.speeds.publish(Float64(data=speed))


def main(limits=True):
    rclpy.init()
    rclpy.spin(Guard(limits))


def relay():
    main(limits=False)
"""
CONFTEST = """\
import time

import pytest
import rclpy
from rclpy.node import Node
from std_msgs.msg import Float64


class Bench:
    \"\"\"A node that sends requests to what was launched, and receives its speeds.\"\"\"

    def __init__(self):
        rclpy.init()
        self.node, self.received = Node("bench"), []
        self.requests = self.node.create_publisher(Float64, "/front/wanted", 10)
        self.node.create_subscription(Float64, "/front/driven", self.on_speed, 10)
        end = time.monotonic() + 10.0
        while not self.requests.get_subscription_count() and time.monotonic() < end:
            self.wait(0.1)  # until the launched node is there
        self.wait(0.5)  # until it has discovered this one, too

    def on_speed(self, msg):
        \"\"\"Note a speed.\"\"\"
        self.received.append(msg.data)

    def request(self, speed):
        \"\"\"Publish a request.\"\"\"
        self.requests.publish(Float64(data=speed))

    def wait(self, seconds):
        \"\"\"Spin for so long, and return the speeds that came meanwhile.\"\"\"
        self.received.clear()
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            rclpy.spin_once(self.node, timeout_sec=0.02)
        return list(self.received)

    def close(self):
        \"\"\"End the node.\"\"\"
        self.node.destroy_node()
        rclpy.shutdown()


@pytest.fixture
def bench():
    \"\"\"A new bench for each test.\"\"\"
    made = Bench()
    yield made
    made.close()
"""
HEAD = """\
from pathlib import Path

import launch_pytest
import pytest
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch_pytest.actions import ReadyToTest

FILE = Path(__file__).parents[1] / "launch" / "guard.launch.py"


@launch_pytest.fixture
def launched():
    return LaunchDescription([IncludeLaunchDescription(str(FILE)), ReadyToTest()])


@pytest.mark.launch(fixture=launched)
"""
TESTS = f"""\
{HEAD}def test_the_launched_node_limits_speeds(bench):
    for requested, speed in [(2.0, 0.3), (-2.0, -0.3), (0.2, 0.2)]:
        bench.request(requested)
        assert bench.wait(0.5) == [speed]
"""
RIGHT = {
    **package(
        "speed_guard",
        "'limiter = speed_guard.node:main', 'relay = speed_guard.node:relay'",
        "rclpy std_msgs launch launch_ros",
        {
            "speed_guard/node.py": NODE,
            "launch/guard.launch.py": GIVEN,
            "test/conftest.py": CONFTEST,
            "test/test_launch.py": TESTS,
        },
    ),
}


def but(path: str, old: str = "", new: str | None = None) -> Workspace:
    """The right package with another text in one of its files; without `new`, without this file."""
    return Workspace(__name__, changed(RIGHT, path, old, new))


def tests(text: str) -> Workspace:
    """The right package with other tests."""
    return Workspace(__name__, {**RIGHT, TEST: text})


IN_ONE_LAUNCH = """\
import asyncio
from pathlib import Path

import launch_pytest
import pytest
import rclpy
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from std_msgs.msg import Float64

SOURCE = PythonLaunchDescriptionSource(str(Path(__file__).parent.parent / "launch/guard.launch.py"))


@launch_pytest.fixture(scope="module")
def description():
    return LaunchDescription([IncludeLaunchDescription(SOURCE)])


@pytest.fixture
def node():
    rclpy.init()
    yield rclpy.create_node("asker")
    rclpy.shutdown()


@pytest.mark.launch(fixture=description)
@pytest.mark.parametrize(("request_", "speed"), [(1.0, 0.3), (-0.75, -0.3)])
async def test_answers(node, request_, speed):
    received = []
    publisher = node.create_publisher(Float64, "/front/wanted", 10)
    node.create_subscription(Float64, "/front/driven", lambda msg: received.append(msg.data), 10)
    for step in range(40):
        rclpy.spin_once(node, timeout_sec=0)
        if step == 20:
            publisher.publish(Float64(data=request_))
        await asyncio.sleep(0.05)
    assert received == [speed]
"""
LaunchTest = Workspace(__name__, RIGHT)
InTwoTests = tests(f"""\
{HEAD}def test_fast(bench):
    bench.request(7.5)
    assert bench.wait(0.3) == [pytest.approx(0.3)]


@pytest.mark.launch(fixture=launched)
def test_after_the_shutdown(bench):
    bench.request(-1.0)
    assert bench.wait(0.3) == [-0.3]
    yield
    bench.request(-0.1)
    assert bench.wait(0.3) == []
""")
OfItsOwn = tests(IN_ONE_LAUNCH)  # a design of its own
Yields = but(
    TEST,
    "    return LaunchDescription([IncludeLaunchDescription(str(FILE)), ReadyToTest()])\n",
    """\
    description = LaunchDescription([IncludeLaunchDescription(str(FILE)), ReadyToTest()])
    yield description
    assert description.entities
""",
)

NoTests = but(TEST)
NothingIsAsserted = tests(f"{HEAD}def test_it(bench):\n    bench.request(2.0)\n    bench.wait(0.5)\n")
OnlyStarts = tests(f"{HEAD}def test_it(launch_context):\n    assert launch_context is not None\n")
FailsOnItsOwn = but(TEST, "(2.0, 0.3)", "(2.0, 0.5)")
OnlySomething = tests(
    f"{HEAD}def test_it(bench):\n    bench.request(0.2)\n    assert 0.2 in bench.wait(0.5)\n"
)
OneRequest = but(TEST, "[(2.0, 0.3), (-2.0, -0.3), (0.2, 0.2)]", "[(2.0, 0.3)]")
OnlyTheLast = but(TEST, "bench.wait(0.5) == [speed]", "bench.wait(0.5)[-1:] == [speed]")
SmallRequests = but(TEST, "[(2.0, 0.3), (-2.0, -0.3), (0.2, 0.2)]", "[(0.1, 0.1), (0.2, 0.2)]")
OtherTopics = but("speed_guard/test/conftest.py", "/front/driven", "/front/speed")
WaitsForever = tests(f"""\
{HEAD}def test_it(bench):
    bench.request(2.0)
    while 0.3 not in bench.wait(0.1):
        pass
""")
NeverEnds = tests(f"{HEAD}def test_it(bench):\n    while True:\n        bench.wait(1.0)\n")
ON_THE_TEXT = """


def test_the_text():
    text = Path(__file__).parents[1].joinpath("launch/guard.launch.py").read_text()
    for line in ('executable="limiter"', 'namespace="front"', '"limit": 0.3', '("request", "wanted")'):
        assert line in text
"""
AlsoLooksAtTheText = tests(f"{TESTS}{ON_THE_TEXT}")
LeavesItRunning = tests("""\
import asyncio
import threading
from pathlib import Path

from launch import LaunchDescription, LaunchService
from launch.actions import IncludeLaunchDescription


def test_it(bench):
    service = LaunchService()
    file = Path(__file__).parents[1] / "launch" / "guard.launch.py"
    service.include_launch_description(LaunchDescription([IncludeLaunchDescription(str(file))]))
    threading.Thread(target=lambda: asyncio.run(service.run_async()), daemon=True).start()
    bench.wait(1.0)
    bench.request(2.0)
    assert bench.wait(0.5) == [0.3]
""")
