"""The script that runs rclpy's own tests in a run: each kind of outcome, on a checkout as small as can be."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
TESTS = '''
import sys
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
    assert "sim" not in sys.modules, "a module of ours"


def test_fails_plainly_too():
    assert False
'''


def fidelity(*words):
    command = [sys.executable, "-m", "tests.fidelity", *map(str, words)]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True)


def test_it_says_which_tests_pass_are_refused_or_differ(tmp_path):
    folder = tmp_path / "rclpy" / "test"
    folder.mkdir(parents=True)
    (folder / "__init__.py").write_text("raise RuntimeError('not with rclpy imported')\n")
    (folder / "test_small.py").write_text(TESTS)
    table, words = fidelity(tmp_path).stdout.split("differs: ")
    assert table == """\
file           tests  pass plainly  pass in a run  skipped  refused  differ
test_small.py      5             4              2        0        1       1
all                5             4              2        0        1       1
"""
    assert words == (
        "test/test_small.py::test_differs\n"
        "    AssertionError: a module of ours\n"
        "refused: test/test_small.py::TestNode::test_is_refused\n"
        "    NotImplementedError: EventsExecutor can't run in simulated time. Use SingleThreadedExecutor or "
        "MultiThreadedExecutor.\n"
    )


def test_another_folder_is_named(tmp_path):
    done = fidelity(tmp_path)
    assert done.returncode == 2
    assert done.stderr.splitlines()[-1] == (
        f"python -m tests.fidelity: error: {tmp_path} is no checkout of ros2/rclpy: it has no rclpy/test"
    )
