"""The hooks: each has a reason, each is inert outside a run, and names bound early go through them."""

import builtins
import os
import queue
import random
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.clock import Clock, ClockType
from rclpy.executors import MultiThreadedExecutor
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from rclpy.wait_for_message import wait_for_message
from std_msgs.msg import Int32

from sim import run
from sim.ros.hooks import HOOKS, install
from tests.students.engine import mains, timing


@pytest.fixture
def node():
    """The user's own node, in real time."""
    run(mains.Counter, seconds=0.5, quiet=True)
    rclpy.init()
    node = Node("mine")
    yield node
    node.destroy_node()
    rclpy.shutdown()


def test_every_hook_has_a_reason_and_is_there_once():
    assert len(HOOKS) > 30
    for hook in HOOKS:
        assert len(hook.reason) >= len("the graph"), hook
        assert not hook.reason.endswith("."), hook.reason
    places = [(hook.owner, hook.name) for hook in HOOKS]
    assert len(set(places)) == len(places)


def test_installing_again_changes_nothing():
    before = [hook.owner.__dict__[hook.name] for hook in HOOKS]
    install()
    assert [hook.owner.__dict__[hook.name] for hook in HOOKS] == before


def test_a_module_that_may_not_be_imported_is_passed_over(monkeypatch):
    monkeypatch.setitem(sys.modules, "forbidden", None)
    install()


def test_names_bound_before_sim_was_imported_go_through_the_hooks():
    """As in a notebook whose first cell imports `sleep` and whose second imports sim."""
    program = (
        "from time import sleep, monotonic\n"
        "from rclpy import init, ok\n"
        "from tests.students.engine import timing\n"
        "from sim import run\n"
        "def main():\n"
        "    init(); start = monotonic(); sleep(500.0); print(monotonic() - start)\n"
        "    assert ok()\n"
        "print(run(main, seconds=900, quiet=True).prints[0])\n"
        "print(len(run(timing.early_bound_sleep, seconds=2, quiet=True).logs))\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    assert (done.stdout, done.stderr) == ("(500.0, '500.0')\n1\n", "")


def test_outside_a_run_sleeping_and_clocks_are_real():
    start, before = time.monotonic(), time.time()
    time.sleep(0.05)
    assert time.monotonic() - start >= 0.05
    assert time.time() > 1.7e9 and time.time() >= before
    assert Clock().now().nanoseconds > 1.7e18
    assert Clock(clock_type=ClockType.STEADY_TIME).now().nanoseconds > 0
    assert time.perf_counter_ns() > 0


def test_outside_a_run_threads_and_locks_are_real():
    seen, lock, event = [], threading.Lock(), threading.Event()

    def work():
        seen.append(threading.get_ident())
        with lock:
            event.wait(5)

    thread = threading.Thread(target=work)
    thread.start()
    while not lock.locked():
        time.sleep(0.001)
    assert thread.is_alive() and thread.ident == seen[0] != threading.get_ident()
    assert not lock.acquire(timeout=0.02)
    event.set()
    thread.join(5)
    assert not thread.is_alive()
    assert type(lock) is type(threading._allocate_lock())
    assert type(queue.SimpleQueue()).__module__ == "_queue"
    assert type(threading.RLock()).__module__ == "_thread"


def test_outside_a_run_chance_is_real():
    random.seed(1)
    expected = random.random()
    random.seed(1)
    np.random.seed(1)
    state = np.random.get_state()[1].tolist()
    run(mains.Counter, seconds=0.5, seed=7, quiet=True)
    assert random.random() == expected
    assert np.random.get_state()[1].tolist() == state
    assert os.urandom(16) != os.urandom(16)
    assert np.random.default_rng().integers(2**60) != np.random.default_rng().integers(2**60)


def test_outside_a_run_signals_belong_to_the_user():
    kept = signal.signal(signal.SIGUSR1, signal.SIG_IGN)
    assert signal.signal(signal.SIGUSR1, kept) is signal.SIG_IGN
    assert signal.alarm(0) == 0
    assert signal.setitimer(signal.ITIMER_VIRTUAL, 0) == (0.0, 0.0)


def test_outside_a_run_input_and_exit_are_pythons(monkeypatch):
    import io

    monkeypatch.setattr(sys, "stdin", io.StringIO("typed\n"))
    assert builtins.input() == "typed"
    program = "import os, sim; os._exit(7)"
    assert subprocess.run([sys.executable, "-c", program], timeout=60).returncode == 7


def test_outside_a_run_rclpy_waits_in_real_time(node):
    ticks = []
    node.create_timer(0.02, lambda: ticks.append(node.get_clock().now().nanoseconds))
    start = time.monotonic()
    while len(ticks) < 3 and time.monotonic() - start < 5:
        rclpy.spin_once(node, timeout_sec=0.5)
    assert 0.05 < time.monotonic() - start < 5
    assert ticks[0] > 1.7e18
    assert wait_for_message(Int32, node, "nothing", time_to_wait=0.02) == (False, None)
    assert node.get_clock().sleep_for(rclpy.duration.Duration(seconds=0.01))


def test_outside_a_run_executors_use_threads(node):
    idents, barrier = set(), threading.Barrier(2)

    def meet():
        barrier.wait(5)
        idents.add(threading.get_ident())
        timers.pop().cancel()

    group = ReentrantCallbackGroup()
    timers = [node.create_timer(0.01, meet, callback_group=group) for _ in range(2)]
    executor = MultiThreadedExecutor(2)
    executor.add_node(node)
    end = time.monotonic() + 5
    while len(idents) < 2 and time.monotonic() < end:
        executor.spin_once(timeout_sec=0.1)
    executor.shutdown()
    assert len(idents) == 2 and threading.get_ident() not in idents
    events = EventsExecutor()
    events.add_node(node)
    events.spin_once(timeout_sec=0.01)
    events.shutdown()


def test_outside_a_run_signal_handlers_of_rclpy_are_installed():
    handler = signal.getsignal(signal.SIGINT)
    rclpy.init()
    rclpy.shutdown()
    assert signal.getsignal(signal.SIGINT) is handler


def test_in_a_run_a_thread_of_the_users_stays_in_real_time():
    """Only student code of the run lives in simulated time."""
    seen, stop = [], threading.Event()

    def work():
        while not stop.is_set():
            before = time.monotonic()
            time.sleep(0.01)
            seen.append(time.monotonic() - before)

    thread = threading.Thread(target=work)
    thread.start()
    run(timing.Timers, seconds=400, quiet=True)
    stop.set()
    thread.join(5)
    assert len(seen) > 3
    assert all(0.01 <= duration < 5 for duration in seen)
