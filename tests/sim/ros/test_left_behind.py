"""A run leaves nothing behind: no thread, file, node or context, and no harm to the user's own ones."""

import contextlib
import gc
import os
import subprocess
import sys
import threading
import weakref
from pathlib import Path

import pytest
import rclpy
import rclpy.context
import rclpy.utilities
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Int32

from sim import run
from sim.ros.engine.running_program import RunningProgram
from sim.ros.fibers.scheduler import active
from tests.patience import PATIENCE, until
from tests.students.engine import actions, errors, mains, services, threads

RUNS = 200
WARM_UP = 5
MEGABYTE = 2**20


def footprint():
    """What the operating system knows of this process: threads, open files, shared memory."""
    maps = Path("/proc/self/maps").read_text()  # not all of /dev/shm: other processes share it
    shared = {line.split("/dev/shm/")[1] for line in maps.splitlines() if "/dev/shm/fast" in line}
    return len(os.listdir("/proc/self/task")), len(os.listdir("/proc/self/fd")), shared


def nothing_is_left(before):
    """Wait until there is no more than before: Linux lists a thread that has ended for a moment longer."""

    def as_before():
        (threads, files, shared), (threads_before, files_before, shared_before) = footprint(), before
        return threads <= threads_before and files <= files_before and shared <= shared_before

    return until(as_before, "threads and files to be gone")


def memory():
    """Resident memory of this process in bytes."""
    gc.collect()
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def live_nodes():
    """How many Node objects there are; a run has collected its garbage.

    By type(), since an object of another test may raise an error when isinstance reads its __class__.
    """
    return sum(issubclass(type(thing), Node) for thing in gc.get_objects())


def many_kinds():
    """A node of every kind of entity, an error, and threads that never end."""
    run(mains.with_finally, threads.queues, threads.multi_reentrant, world="room", seconds=1, quiet=True)
    run(services.Adder, services.await_exclusive, errors.InTimer, seconds=1.5, quiet=True)
    run(actions.Server, actions.Client, seconds=1, quiet=True)


def two_hundred_runs():
    """Print what they leave behind: are threads, files and nodes as before, and how many MB came?"""
    for _ in range(WARM_UP):
        many_kinds()
    before, bytes_before, nodes = footprint(), memory(), live_nodes()
    for _ in range(RUNS // 3 + 1):
        many_kinds()
    print(nothing_is_left(before), live_nodes() == nodes, (memory() - bytes_before) / MEGABYTE)


@pytest.mark.soak
def test_two_hundred_runs_leave_threads_files_and_memory_flat():
    """In a process of their own: the memory of this one depends on the tests before."""
    program = "from tests.sim.ros import test_left_behind as here; here.two_hundred_runs()"
    command = [sys.executable, "-c", program]
    done = subprocess.run(
        command, cwd=Path(__file__).parents[3], capture_output=True, text=True, timeout=PATIENCE, check=True
    )
    footprint_is_equal, nodes_are_equal, megabytes = done.stdout.split()
    assert (footprint_is_equal, nodes_are_equal) == ("True", "True")
    assert float(megabytes) < 10


@pytest.mark.parametrize("program", [
    mains.Counter, mains.classic, mains.own_executor, mains.own_context, mains.spin_once_loop,
    threads.queues, threads.pool, threads.multi_reentrant, errors.InTimer, errors.InInit,
    errors.in_parallel_callback, services.await_exclusive, services.multi_exclusive, actions.parallel_server,
], ids=lambda program: program.__qualname__)  # fmt: skip
def test_no_node_outlives_its_run(program):
    run(program, seconds=2, quiet=True)
    before, nodes = footprint(), live_nodes()
    run(program, seconds=2, quiet=True)
    assert live_nodes() == nodes
    assert nothing_is_left(before)


def test_a_stream_that_someone_keeps_keeps_nothing_of_the_run(capsys):
    import sys

    kept, nodes = [], weakref.WeakSet()

    def keeps_stdout():
        rclpy.init()
        nodes.add(mains.Counter())
        kept.append(sys.stdout)

    run(keeps_stdout, seconds=1, quiet=True)
    gc.collect()
    assert len(nodes) == 0
    kept[0].write("afterwards\n")
    assert capsys.readouterr().out == "afterwards\n"


@pytest.mark.parametrize("users", [(700, 10, 10), (5_000, 5, 5), (0, 10, 10)])
def test_the_garbage_collector_is_the_users_again(users):
    def tunes_it():
        rclpy.init()
        seen.append(gc.get_threshold())
        gc.set_threshold(1, 1, 1)

    seen: list[tuple[int, int, int]] = []
    usual = gc.get_threshold()
    gc.set_threshold(*users)
    users = gc.get_threshold()  # some Pythons have no third
    try:
        run(tunes_it, seconds=1, quiet=True)
        assert gc.get_threshold() == users
    finally:
        gc.set_threshold(*usual)
    assert seen == [(max(users[0], 3_000) if users[0] else 0, *users[1:])]  # 0: it was switched off


def test_rclpy_is_as_it_was_without_an_init():
    run(mains.own_context, mains.shuts_itself_down, seconds=3, quiet=True)
    assert not rclpy.ok()
    assert rclpy.utilities.g_default_context is None or not rclpy.utilities.g_default_context.ok()
    assert (active(), RunningProgram.loaded) == (None, None)


@pytest.fixture
def users_node():
    """The user's own node, made in a cell before, with a context that stays alive."""
    rclpy.init()
    node = Node("mine")
    yield node
    node.destroy_node()
    rclpy.shutdown()


def received_by(node):
    """Publishes on the user's own node, in real time, and returns what its own subscription got."""
    got = []
    subscription = node.create_subscription(Int32, "mine", lambda msg: got.append(msg.data), 10)
    publisher = node.create_publisher(Int32, "mine", 10)
    publisher.publish(Int32(data=5))
    until(lambda: rclpy.spin_once(node, timeout_sec=0.1) or got)
    node.destroy_subscription(subscription)
    node.destroy_publisher(publisher)
    return got


def test_the_users_own_node_works_before_and_after_runs(users_node):
    context, users = rclpy.utilities.get_default_context(), rclpy.context.g_logging_ref_count
    assert received_by(users_node) == [5]
    for program in (mains.classic, mains.shuts_itself_down, mains.init_again, errors.InTimer):
        run(program, seconds=2, quiet=True)
        assert rclpy.utilities.get_default_context() is context
        assert context.ok() and rclpy.ok()
        assert received_by(users_node) == [5]
    assert rclpy.context.g_logging_ref_count == users


def test_the_users_node_and_a_run_dont_reach_each_other(users_node):
    got = []
    users_node.create_subscription(Int32, "count", got.append, 10)
    users_node.create_publisher(Int32, "count", 10)
    recording = run(mains.Counter, seconds=2, quiet=True)
    rclpy.spin_once(users_node, timeout_sec=0.2)
    assert got == []
    assert recording.graph.nodes == ["/counter"]
    assert {received.sender for received in recording.messages("/count")} == {"/counter"}


def test_the_users_executor_spins_in_a_thread_during_a_run(users_node):
    ticks = []
    users_node.create_timer(0.01, lambda: ticks.append(threading.get_ident()))
    executor = SingleThreadedExecutor()
    executor.add_node(users_node)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    run(mains.classic, seconds=900_000, until=lambda _: len(ticks) > 3, quiet=True)
    usual = run(mains.classic, world="room", seconds=20, quiet=True)
    executor.shutdown()
    thread.join(PATIENCE)
    assert not thread.is_alive()
    assert set(ticks) == {thread.ident}
    assert usual.digest == run(mains.classic, world="room", seconds=20, quiet=True).digest


def test_a_run_that_fails_to_start_leaves_nothing():
    run(mains.Counter, seconds=1, quiet=True)
    before = footprint()
    for arguments in ({"world": "moon"}, {"seconds": -1}, {"seed": "three"}):
        with contextlib.suppress(Exception):
            run(mains.Counter, quiet=True, **arguments)
        assert active() is None
    run(mains.Counter, seconds=1, quiet=True)
    assert nothing_is_left(before)
