"""The script that runs rclpy's own tests in a run: each kind of outcome, on a checkout as small as can be."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
TESTS = '''
import sys
import threading
import time
import unittest

import pytest
import rclpy
from rclpy.experimental import EventsExecutor


class TestNode(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rclpy.init()
        cls.node = rclpy.create_node("node")

    @classmethod
    def tearDownClass(cls):
        cls.node.destroy_node()
        rclpy.shutdown()

    def test_passes(self):
        assert self.node.get_name() == "node"

    def test_is_refused(self):
        EventsExecutor()

    def test_is_refused_in_a_part(self):
        with self.subTest("a part"):
            EventsExecutor()

    def test_is_refused_in_a_thread(self):
        made = []
        thread = threading.Thread(target=lambda: made.append(EventsExecutor()))
        thread.start()
        thread.join()
        assert made


@pytest.mark.parametrize("seconds", [0.5])
def test_waits(seconds):
    rclpy.init()
    node = rclpy.create_node("node")
    ticks = []
    node.create_timer(seconds / 10, lambda: ticks.append(time.monotonic()))
    while len(ticks) < 10:
        rclpy.spin_once(node)
    rclpy.shutdown()


def test_differs():
    assert "sim" not in sys.modules, "a module of the course"


def test_fails_plainly_too():
    assert False
'''
REFUSED = (
    "NotImplementedError: EventsExecutor can't run in simulated time. Use SingleThreadedExecutor or "
    "MultiThreadedExecutor.\n"
)
GO_ON = '''
import pytest
import rclpy
from rclpy.clock import Clock


@pytest.fixture(scope="session", autouse=True)
def starts_rclpy_once():
    rclpy.init()


@pytest.mark.parametrize("name", ["one", "two"])
def test_builds_on_a_fixture_of_all(name):
    assert rclpy.create_node(name).get_name() == name


class TestClock:
    def test_clock_now(self):
        clock = Clock()
        assert clock.now() < clock.now()
'''


def fidelity(*words):
    command = [sys.executable, "-m", "tests.fidelity", *map(str, words)]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True)


def checkout(folder, **files):
    tests = folder / "rclpy" / "test"
    tests.mkdir(parents=True)
    (tests / "__init__.py").write_text("raise RuntimeError('not with rclpy imported')\n")
    for name, text in files.items():
        (tests / f"{name}.py").write_text(text)
    return folder


def test_it_says_which_tests_pass_are_refused_or_differ(tmp_path):
    done = fidelity(checkout(tmp_path, test_small=TESTS))
    assert done.returncode == 1
    table, words = done.stdout.split("differs: ")
    assert table == """\
file           tests  pass plainly  pass in a run  skipped  refused  differ
test_small.py      7             6              2        0        3       1
all                7             6              2        0        3       1
"""
    assert words == (
        "test/test_small.py::test_differs\n"
        "    AssertionError: a module of the course\n"
        f"refused: test/test_small.py::TestNode::test_is_refused\n    {REFUSED}"
        f"refused: test/test_small.py::TestNode::test_is_refused_in_a_part\n    {REFUSED}"
        f"refused: test/test_small.py::TestNode::test_is_refused_in_a_thread\n    {REFUSED}"
    )


def test_what_is_known_to_differ_has_its_reason_and_is_no_news(tmp_path):
    done = fidelity(checkout(tmp_path, test_clock=GO_ON))
    assert done.stdout == """\
file           tests  pass plainly  pass in a run  skipped  refused  differ
test_clock.py      3             3              2        0        0       1
all                3             3              2        0        0       1
differs, as known: test/test_clock.py::TestClock::test_clock_now
    Between two looks at a clock no time passes: computing takes none.
"""
    assert done.returncode == 0


def test_another_folder_is_named(tmp_path):
    done = fidelity(tmp_path)
    assert done.returncode == 2
    assert done.stderr.splitlines()[-1] == (
        f"python -m tests.fidelity: error: {tmp_path} is no checkout of ros2/rclpy: it has no rclpy/test"
    )
