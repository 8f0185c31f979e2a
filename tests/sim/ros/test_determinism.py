"""Equal nodes, world and seed give equal recordings: here, elsewhere, on a busy machine, on other Pythons."""

import functools
import subprocess
import sys
from pathlib import Path

import pytest
from rclpy.node import Node
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Bool

from sim import run
from tests.patience import PATIENCE
from tests.sim.ros import determinism, programs
from tests.students.engine import names, threads

OTHERS = sorted(set(determinism.REPOSITORY.glob(".venv3??")) - {Path(sys.prefix)})


@pytest.fixture(scope="module")
def here():
    return " ".join(recording.digest for recording in programs.scenarios())


def test_a_second_time_in_this_process_is_equal(here):
    assert " ".join(recording.digest for recording in programs.scenarios()) == here


@pytest.mark.parametrize("seed", [1, pytest.param(2, marks=pytest.mark.soak)])
def test_a_fresh_process_is_equal_whatever_its_hash_seed(here, seed):
    assert determinism.digests(sys.executable, seed) == here


@pytest.mark.soak
def test_other_pythons_are_equal(here):
    if not OTHERS:
        pytest.skip("no other Python is set up: `make VENV=.venv311 PYTHON=python3.11 setup` does so")
    found = {folder.name: determinism.digests(folder / "bin" / "python", 4) for folder in OTHERS}
    assert found == dict.fromkeys(found, here)


@pytest.mark.soak
def test_a_busy_machine_changes_nothing(here):
    """As the bench counts it: one run on a machine with idle processors, one on a busy one."""
    command = [sys.executable, "-m", "tests.bench.digests", "--runs", "2"]
    done = subprocess.run(
        command, cwd=determinism.REPOSITORY, capture_output=True, text=True, timeout=PATIENCE, check=False
    )
    begins = [digest[:4] for digest in here.split()]
    *_, idle, busy, logged = done.stdout.splitlines()
    assert idle.split() == ["idle", sys.executable, *begins, "1"]
    assert busy.split() == ["busy", sys.executable, *begins, "1"]
    assert logged == "1 distinct recording in 2 fresh processes"


def test_another_seed_is_another_run():
    first, second = (run(programs.Wanderer, world="room", seconds=3, seed=s, quiet=True) for s in (1, 2))
    assert first.digest != second.digest
    assert [h.raw for h in first.messages("/scan")] != [h.raw for h in second.messages("/scan")]


def test_the_digest_sees_every_kind_of_evidence():
    """The same nodes for a shorter time, in another order, or with another parameter: all differ."""
    runs = [
        run(names.Talker, threads.queues, seconds=3, quiet=True),
        run(names.Talker, threads.queues, seconds=2, quiet=True),
        run(threads.queues, names.Talker, seconds=3, quiet=True),
        run(names.Talker, seconds=3, quiet=True),
        run(names.Bursts, seconds=3, quiet=True),
    ]
    assert len({recording.digest for recording in runs}) == len(runs)


class RawListener(Node):
    """Keeps the bytes of what it receives; those of a Bool end in the middle of a word."""

    received = []  # noqa: RUF012

    def __init__(self):
        super().__init__("raw_listener")
        for kind, topic in ((Bool, "/bumper"), (LaserScan, "/scan")):
            receive = functools.partial(self.on_message, topic)
            self.create_subscription(kind, topic, receive, 10, raw=True)

    def on_message(self, topic, raw):
        self.received.append((topic, raw))


def test_a_raw_subscription_receives_the_bytes_that_were_sent_and_nothing_behind_them():
    RawListener.received.clear()
    recording = run(RawListener, world="yard", seconds=1, quiet=True)
    for topic in ("/bumper", "/scan"):
        sent = [h.raw for h in recording.messages(topic)][1:]  # the first one was sent before discovery
        assert [raw for name, raw in RawListener.received if name == topic] == sent


@pytest.mark.soak
def test_two_processes_at_once_dont_reach_each_other(here):
    """The same topics, at the same time; with subscribers there would be more messages and callbacks."""
    command = [sys.executable, "-m", "tests.sim.ros.programs"]
    pair = [
        subprocess.Popen(command, cwd=determinism.REPOSITORY, stdout=subprocess.PIPE, text=True)
        for _ in range(2)
    ]
    assert [child.communicate(timeout=PATIENCE)[0].splitlines()[-1] for child in pair] == [here, here]
