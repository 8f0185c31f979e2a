"""The hooks: each has a reason, each is inert outside a run, and names bound early go through them."""

import ast
import builtins
import os
import platform
import queue
import random
import signal
import subprocess
import sys
import threading
import time
from importlib import metadata
from pathlib import Path

import numpy as np
import pytest
import rclpy
from rclpy.action import ActionClient
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.clock import Clock, ClockType
from rclpy.executors import MultiThreadedExecutor
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from rclpy.time_source import TimeSource
from rclpy.wait_for_message import wait_for_message
from std_msgs.msg import Int32

from sim import run
from sim.distro import DISTRO, RCLPY_DISTRIBUTION
from sim.ros.hooks import rclpy_internals, verify
from sim.ros.hooks.install import install
from sim.ros.hooks.table import HOOKS, Hook
from sim.ros.hooks.verify import (
    RCLPY_OF,
    WRITTEN_FOR,
    HookError,
    check_arguments,
    check_internals,
    original_of,
)
from sim.ros.rclpy_cpp import NODE_ARGUMENTS
from tests.patience import PATIENCE, until
from tests.students.engine import mains, timing

COURSE = Path(__file__).parents[3]


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
    before = [vars(hook.owner)[hook.name] for hook in HOOKS]
    install()
    assert [vars(hook.owner)[hook.name] for hook in HOOKS] == before


def test_a_module_that_may_not_be_imported_is_passed_over():
    program = "import sys; sys.modules['forbidden'] = None; import sim; print(sim.run(seconds=1).ended[0])"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=PATIENCE)
    assert (done.stdout, done.stderr) == ("time\n", "")


def rclpys(**places):
    """A class that is as one of rclpy's, with these functions in it."""
    return type("Node", (), {"__module__": "rclpy.node", **places})


def fit(hook):
    """Look whether a hook fits what its owner has."""
    check_arguments(hook, original_of(hook), hook.make(None))


def test_a_place_that_rclpy_has_renamed_is_named_with_both_versions(monkeypatch):
    monkeypatch.setattr(verify, "version", {RCLPY_DISTRIBUTION: "8.0.0"}.__getitem__)
    with pytest.raises(HookError) as caught:
        fit(Hook(rclpys(), "create_timer", "the graph", lambda original: None))
    assert str(caught.value) == (
        "A run reaches into rclpy.node.Node.create_timer, which rclpy 8.0.0 does not have: "
        f"this course was written for rclpy {WRITTEN_FOR['rclpy']}."
    )


@pytest.mark.parametrize(
    ("now", "of_the_hook", "words"),
    [
        ("self, period", "self, seconds", "has no argument 'seconds' there"),
        ("self, callback, period", "self, period, callback", "has no argument 'period' there"),
        ("self, *, period", "self, period", "has no argument 'period' there"),
        ("self, *periods", "self, period", "has no argument 'period' there"),
        ("self, period, clock", "self, period", "has an argument 'clock' that its hook does not take"),
        ("self, period, clock", "self, period, *a", "has an argument 'clock' that its hook does not take"),
        ("self, *, clock", "self, *more", "has an argument 'clock' that its hook does not take"),
    ],
)
def test_other_arguments_than_a_hook_was_written_for_are_named(monkeypatch, now, of_the_hook, words):
    monkeypatch.setattr(verify, "version", {RCLPY_DISTRIBUTION: "8.0.0"}.__getitem__)
    owner = rclpys(create_timer=eval(f"lambda {now}: None"))
    with pytest.raises(HookError) as caught:
        fit(Hook(owner, "create_timer", "the graph", lambda original: eval(f"lambda {of_the_hook}: None")))
    assert str(caught.value) == (
        f"A run reaches into rclpy.node.Node.create_timer, which in rclpy 8.0.0 {words}: "
        f"this course was written for rclpy {WRITTEN_FOR['rclpy']}."
    )


@pytest.mark.parametrize(
    ("now", "of_the_hook"),
    [("self, a, *, b=1", "self, *r, **m"), ("self, a, b", "self, a, *r, **m"), ("self, *, a", "self, *, a")],
)
def test_a_hook_may_pass_on_what_it_does_not_look_at(now, of_the_hook):
    owner = rclpys(create_timer=eval(f"lambda {now}: None"))
    fit(Hook(owner, "create_timer", "the graph", lambda original: eval(f"lambda {of_the_hook}: None")))


def test_a_hook_that_does_not_fit_is_said_on_import_and_none_is_installed():
    program = (
        "import threading, time, rclpy.node\n"
        "sleep = time.sleep\n"
        "del rclpy.node.Node.create_timer, threading.Thread.join\n"
        "try:\n    import sim\nexcept ImportError as error:\n    print(error)\n"
        "print(time.sleep is sleep)\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=PATIENCE)
    assert (done.stdout, done.stderr) == (
        f"A run reaches into rclpy.node.Node.create_timer, which rclpy {RCLPY_OF[DISTRO]} does not have: "
        f"this course was written for rclpy {WRITTEN_FOR['rclpy']}.\nTrue\n",
        "",
    )


@pytest.fixture
def internals(monkeypatch):
    """Puts an entry into one of the tables of rclpy's internals, and nothing into the others."""

    def only(table, entry):
        for name, empty in (("ATTRIBUTES", {}), ("VARIABLES", ()), ("FUNCTIONS", {})):
            monkeypatch.setattr(rclpy_internals, name, entry if name == table else empty)

    return only


@pytest.mark.parametrize(
    ("table", "entry", "name"),
    [
        ("ATTRIBUTES", {Node: ("_time_sources",)}, "rclpy.node.Node._time_sources"),
        ("VARIABLES", ((rclpy, ("__executors",)),), "rclpy.__executors"),
        ("FUNCTIONS", {"Node.__init__": 5}, "rclpy._rclpy_pybind11.Node.__init__"),
        ("FUNCTIONS", {"Node.create_timer": 1}, "rclpy._rclpy_pybind11.Node.create_timer"),
        ("FUNCTIONS", {"rclpy_serialize": 1}, "rclpy._rclpy_pybind11.rclpy_serialize"),
    ],
)
def test_what_rclpy_has_changed_beside_the_hooks_is_named(monkeypatch, internals, table, entry, name):
    monkeypatch.setattr(verify, "version", {RCLPY_DISTRIBUTION: "8.0.0"}.__getitem__)
    internals(table, entry)
    with pytest.raises(HookError) as caught:
        check_internals()
    assert str(caught.value) == (
        f"A run uses {name}, which rclpy 8.0.0 does not have, or has with other arguments: "
        f"this course was written for rclpy {WRITTEN_FOR['rclpy']}."
    )


@pytest.mark.parametrize(
    ("table", "entry"),
    [
        ("ATTRIBUTES", {TimeSource: ("_clock_sub",), ActionClient: ("_is_feedback_ready",)}),
        ("VARIABLES", ((rclpy, ("__executor",)),)),
        ("FUNCTIONS", {"Node.__init__": NODE_ARGUMENTS, "rclpy_serialize": 2}),
    ],
)
def test_what_is_as_it_was_is_not_named(internals, table, entry):
    internals(table, entry)
    assert rclpy_internals.missing() == []


# Private names of Python's own modules, of named tuples, and of messages, that sim/ros uses.
PYTHONS = {"_PySimpleQueue", "_Local", "_asdict", "_fields", "_getframe", "_get_running_loop", "_max_workers",
           "_replace", "_set_running_loop", "_started", "_target", "_thread_name_prefix"}  # fmt: skip
OF_MESSAGES = {"_check_fields"}


def private_names(files):
    """Private attributes that these sources use and do not define; and the names they use of rclpy's C++."""
    used, own, cpp = set(), set(), set()
    for file in files:
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
                own.add(node.name)
            elif isinstance(node, ast.AnnAssign | ast.Assign) and not isinstance(node.value, ast.Attribute):
                own |= {name.id for name in getattr(node, "targets", [getattr(node, "target", None)])
                        if isinstance(name, ast.Name)}  # fmt: skip
            elif isinstance(node, ast.Attribute) and ast.unparse(node.value) == "cpp":
                cpp.add(node.attr)
            elif isinstance(node, ast.Attribute) and node.attr.startswith("_") and node.attr[1] != "_":
                mine = isinstance(node.ctx, ast.Store) and ast.unparse(node.value) == "self"
                (own if mine else used).add(node.attr)
    return used - own, cpp


def test_every_private_name_of_rclpy_that_a_run_uses_is_in_the_list():
    used, cpp = private_names(sorted((Path(rclpy_internals.__file__).parents[1]).rglob("*.py")))
    listed = {name for names in rclpy_internals.ATTRIBUTES.values() for name in names}
    listed |= {name for _, names in rclpy_internals.VARIABLES for name in names}
    hooked = {hook.name for hook in HOOKS}
    assert sorted(used - listed - hooked - PYTHONS - OF_MESSAGES - {"_sim"}) == []
    functions = {name.split(".")[0] for name in rclpy_internals.FUNCTIONS}
    owners = {getattr(hook.owner, "__name__", "") for hook in HOOKS}
    assert sorted(cpp - functions - listed - hooked - owners - {"__name__"}) == []


def test_one_module_imports_rclpys_cpp_layer():
    folders = (COURSE / name for name in ("sim", "grader", "ros_packages/python"))
    files = [file for folder in folders for file in folder.rglob("*.py")]
    found = [file for file in files if "implementation_singleton" in file.read_text(encoding="utf-8")]
    assert [file.relative_to(COURSE).as_posix() for file in found] == ["sim/ros/rclpy_cpp.py"]


def test_a_place_of_pythons_own_is_named_with_pythons_versions():
    with pytest.raises(HookError) as caught:
        fit(Hook(time, "sleeps", "sleeping takes simulated time", lambda original: None))
    assert str(caught.value) == (
        f"A run reaches into time.sleeps, which Python {platform.python_version()} does not have: "
        "this course was written for Python 3.11 to 3.14."
    )


def test_the_hooks_were_written_for_the_versions_that_are_installed():
    assert RCLPY_OF[DISTRO] == metadata.version(RCLPY_DISTRIBUTION)
    assert WRITTEN_FOR["numpy"] == metadata.version("numpy")


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
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=PATIENCE)
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
            event.wait(PATIENCE)

    thread = threading.Thread(target=work)
    thread.start()
    until(lock.locked)
    assert thread.is_alive() and thread.ident == seen[0] != threading.get_ident()
    assert not lock.acquire(timeout=0.02)
    event.set()
    thread.join(PATIENCE)
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
    assert subprocess.run([sys.executable, "-c", program], timeout=PATIENCE).returncode == 7


def test_outside_a_run_rclpy_waits_in_real_time(node):
    ticks = []
    start = time.monotonic()
    node.create_timer(0.02, lambda: ticks.append(node.get_clock().now().nanoseconds))
    while len(ticks) < 3:
        rclpy.spin_once(node)
    assert time.monotonic() - start > 0.05
    assert ticks[0] > 1.7e18
    assert wait_for_message(Int32, node, "nothing", time_to_wait=0.02) == (False, None)
    assert node.get_clock().sleep_for(rclpy.duration.Duration(seconds=0.01))


def test_outside_a_run_executors_use_threads(node):
    idents, barrier = set(), threading.Barrier(2)

    def meet():
        barrier.wait(PATIENCE)
        idents.add(threading.get_ident())
        timers.pop().cancel()

    group = ReentrantCallbackGroup()
    timers = [node.create_timer(0.01, meet, callback_group=group) for _ in range(2)]
    executor = MultiThreadedExecutor(2)
    executor.add_node(node)
    until(lambda: executor.spin_once(timeout_sec=0.1) or len(idents) == 2)
    executor.shutdown()
    assert threading.get_ident() not in idents
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
    run(timing.Timers, seconds=900_000, until=lambda _: len(seen) > 3, quiet=True)
    stop.set()
    thread.join(PATIENCE)
    assert all(0.01 <= duration < PATIENCE for duration in seen)


def test_a_students_locks_are_free_in_a_child_process(capfd):
    """As those of logging's handlers, which Python makes anew after a fork."""
    child = []

    def main():
        lock = threading.RLock()
        lock.acquire()
        lock._at_fork_reinit()
        child.append(lock.acquire(blocking=False))

    assert run(main, seconds=1, quiet=True).errors == []
    assert child == [True] and capfd.readouterr().err == ""
