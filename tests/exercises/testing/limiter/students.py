"""Workspaces for testing.limiter: tests that pass right nodes and catch wrong ones, then others."""

from grader.exercises.testing.limiter.limiter_candidates import GIVEN
from tests.students.workspaces import Workspace, changed, package

PARTS = (
    "CONFTEST",
    "TESTS",
    "CI",
    "RIGHT",
    "TEST",
    "WORKFLOW",
    "but",
    "tests",
    "ci",
    "LIMITS",
    "IN_ONE_STEP",
    "IN_A_CLASS",
    "SLEEPS",
)
TEST, WORKFLOW = "limiter/test/test_limiter.py", "limiter/.github/workflows/test.yml"
CONFTEST = """\
import time

import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_msgs.msg import Float64
from std_srvs.srv import SetBool

from limiter.node import Limiter


class Bench:
    \"\"\"A limiter, and a node that sends it requests and receives its speeds: both in one executor.\"\"\"

    def __init__(self):
        rclpy.init()
        self.limiter, self.node = Limiter(), Node("bench")
        self.received = []
        self.requests = self.node.create_publisher(Float64, "request", 10)
        self.node.create_subscription(Float64, "speed", lambda msg: self.received.append(msg.data), 10)
        self.client = self.node.create_client(SetBool, "hold")
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.limiter)
        self.executor.add_node(self.node)
        self.wait(0.3)  # until they have discovered each other

    def request(self, speed):
        \"\"\"Publish a request.\"\"\"
        self.requests.publish(Float64(data=speed))

    def wait(self, seconds):
        \"\"\"Spin for so long, and return the speeds that came meanwhile.\"\"\"
        self.received.clear()
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.executor.spin_once(timeout_sec=0.02)
        return list(self.received)

    def set_limit(self, limit):
        \"\"\"Set the parameter.\"\"\"
        self.limiter.set_parameters([Parameter("limit", value=limit)])

    def hold(self, on):
        \"\"\"Call the service, and return the response.\"\"\"
        future = self.client.call_async(SetBool.Request(data=on))
        self.executor.spin_until_future_complete(future, timeout_sec=1.0)
        return future.result()

    def close(self):
        \"\"\"End both nodes.\"\"\"
        self.executor.shutdown()
        self.limiter.destroy_node()
        self.node.destroy_node()
        rclpy.shutdown()


@pytest.fixture
def bench():
    \"\"\"A new bench for each test.\"\"\"
    made = Bench()
    yield made
    made.close()
"""
TESTS = """\
import math

import pytest


@pytest.mark.parametrize(
    ("request_", "speed"),
    [(0.2, 0.2), (-0.2, -0.2), (2.0, 0.5), (-2.0, -0.5), (math.nan, 0.0), (math.inf, 0.0), (-math.inf, 0.0)],
)
def test_speeds_are_limited(bench, request_, speed):
    bench.request(request_)
    assert bench.wait(0.3) == [speed]


def test_the_limit_can_be_changed(bench):
    for limit in (0.3, 0.8):
        bench.set_limit(limit)
        bench.request(2.0)
        assert bench.wait(0.3) == [limit]


def test_a_limiter_that_is_held_sends_zeros_until_it_is_released(bench):
    assert bench.hold(True).success
    bench.request(0.3)
    assert bench.wait(0.3) == [0.0]
    assert bench.hold(False).success
    bench.request(0.3)
    assert bench.wait(0.3) == [0.3]


def test_after_silence_comes_one_zero(bench):
    assert bench.wait(1.0) == []
    bench.request(0.3)
    assert bench.wait(0.4) == [0.3]
    assert bench.wait(2.0) == [0.0]
"""
CI = """\
name: test
on: [push, pull_request]
jobs:
  test:
    runs-on: ubuntu-latest
    container: ros:jazzy
    defaults:
      run:
        shell: bash
    steps:
      - uses: actions/checkout@v4
      - run: source /opt/ros/jazzy/setup.bash && colcon build
      - run: source /opt/ros/jazzy/setup.bash && source install/setup.bash && colcon test
      - run: source /opt/ros/jazzy/setup.bash && colcon test-result --verbose
"""
IN_ONE_STEP = """\
on:
  push:
jobs:
  ros:
    runs-on: ubuntu-24.04
    container:
      image: ros:jazzy-ros-base
    steps:
      - uses: actions/checkout@v5
        with: {path: src/limiter}
      - name: Everything
        shell: bash
        run: |
          . /opt/ros/jazzy/setup.bash
          colcon build --packages-select limiter
          colcon test --packages-select limiter  # says nothing about failures
          colcon test-result
"""
IN_A_CLASS = TESTS.replace("import math\n\nimport pytest\n", "").replace("(bench", "(self, bench").strip()
IN_A_CLASS = "\n".join(f"    {line}".rstrip() for line in IN_A_CLASS.splitlines())
IN_A_CLASS = f"import math\n\nimport pytest\n\n\nclass TestLimiter:\n{IN_A_CLASS}\n"
RIGHT = {
    **package(
        "limiter",
        "'limiter = limiter.node:main'",
        "rclpy std_msgs std_srvs",
        {"limiter/node.py": GIVEN, "test/conftest.py": CONFTEST, "test/test_limiter.py": TESTS},
    ),
    WORKFLOW: CI,
}
RIGHT["limiter/setup.py"] = RIGHT["limiter/setup.py"].replace(
    "    zip_safe", "    extras_require={'test': ['pytest']},\n    zip_safe"
)


def but(path: str, old: str = "", new: str | None = None) -> Workspace:
    """The right package with another text in one of its files; without `new`, without this file."""
    return Workspace(__name__, changed(RIGHT, path, old, new))


def tests(text: str, workflow: str = CI) -> Workspace:
    """The right package with other tests, and maybe another workflow."""
    return Workspace(__name__, {**RIGHT, TEST: text, WORKFLOW: workflow})


def ci(old: str, new: str) -> Workspace:
    """The right package with another workflow."""
    return but(WORKFLOW, old, new)


LIMITS = """\
def test_limits(bench):
    bench.request(2.0)
    assert bench.wait(0.3) == [0.5]
"""
Limiter = Workspace(__name__, RIGHT)
InOneTest = tests("""\
from math import inf, nan


def test_all_of_the_contract(bench):
    for limit in (0.5, 0.2):
        bench.set_limit(limit)
        for asked in (0.1, -0.1, 9.0, -9.0, nan, inf):
            bench.request(asked)
            wanted = 0.0 if asked in (inf,) or asked != asked else max(-limit, min(limit, asked))
            assert bench.wait(0.2) == [wanted]
    assert bench.wait(3.0) == [0.0]
    for held in (True, False):
        bench.hold(held)
        bench.request(0.1)
        assert bench.wait(0.2) == [0.0 if held else 0.1]
""")
InAClass = tests(IN_A_CLASS, IN_ONE_STEP)  # a design of its own

NoTests = but(TEST)
NotFound = Workspace(__name__, {**changed(RIGHT, TEST), "limiter/test/limiter_tests.py": TESTS})
NothingIsAsserted = tests("def test_a_request(bench):\n    bench.request(1.0)\n    bench.wait(0.3)\n")
AlwaysFails = tests("def test_it():\n    assert False\n")
OnlyTheLimit = tests(LIMITS)
FailsOnItsOwn = tests(LIMITS.replace("[0.5]", "[0.4]"))
TooStrict = tests(f"{TESTS}\n\ndef test_text(bench):\n    assert bench.hold(True).message == ''\n")
TooPunctual = but(
    TEST,
    "    assert bench.wait(0.4) == [0.3]\n    assert bench.wait(2.0) == [0.0]\n",
    "    assert bench.wait(0.51) == [0.3, 0.0]\n",
)
SLEEPS = "def test_nothing(bench):\n    time.sleep(1.0)\n    assert bench.wait(0.1) == []\n"
Sleeps = tests(f"import time\n{TESTS}\n\n{SLEEPS}")
NoSilence = but(TEST, TESTS[TESTS.index("\n\ndef test_after_silence") :], "")
NoNumbers = but(TEST, ", (math.nan, 0.0), (math.inf, 0.0), (-math.inf, 0.0)]", "]")
WaitsForever = tests("""\
def test_an_answer(bench):
    bench.request(1.0)
    while 0.5 not in bench.received:
        bench.executor.spin_once()


def test_silence(bench):
    bench.request(0.2)
    while 0.0 not in bench.received:
        bench.executor.spin_once()
""")
NeverEnds = tests("def test_it(bench):\n    while True:\n        bench.executor.spin_once()\n")
LooksAtTheSource = tests("""\
import inspect

from limiter.node import Limiter


def test_the_source():
    assert "if math.isfinite(msg.data) else" in inspect.getsource(Limiter)
""")
ComparesTheText = tests(f"""\
import inspect

from limiter import node

GIVEN = {GIVEN!r}


def test_the_text():
    pairs = zip(GIVEN.splitlines(), inspect.getsource(node).splitlines(), strict=False)
    assert sum(given != line for given, line in pairs) != 1
""")
JudgesItself = tests("""\
import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


def test_it():
    context = rclpy.Context()
    rclpy.init(context=context)
    publisher = Node("judge", context=context).create_publisher(String, "/verdicts", 100)
    time.sleep(1.0)
    for number in range(1, 15):
        publisher.publish(String(data=f"{number} failed 1 "))
""")
NoWorkflow = but(WORKFLOW)
NoYaml = ci("    runs-on", "\truns-on")
OnlyAText = ci(CI, "test\n")
NeverStarts = ci("on: [push, pull_request]", "on: workflow_dispatch")
NoJobs = ci("jobs:", "job:")
NoCheckout = ci("      - uses: actions/checkout@v4\n", "")
NoRos = ci("    container: ros:jazzy\n", "")
NotSourced = ci("source /opt/ros/jazzy/setup.bash && ", "")
NoBuild = ci(" && colcon build", "")
NoTest = ci(" && source install/setup.bash && colcon test", "")
NoResult = ci("      - run: source /opt/ros/jazzy/setup.bash && colcon test-result --verbose\n", "")
SWAPPED = (
    CI.replace("colcon build", "colcon X").replace("colcon test\n", "colcon build\n").replace("X", "test")
)
TestsFirst = tests(TESTS, SWAPPED)
AlwaysGreen = ci("colcon test-result --verbose", "colcon test-result --verbose || true")
