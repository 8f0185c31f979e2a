"""Tests of `explore` with threads: real bugs, code inside functions, and the code that it can't look into."""

import importlib
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest
from rclpy.node import Node
from std_msgs.msg import Int32

from sim import explore, run
from tests.students.races import (
    answer_before_entry,
    both_remove,
    callback_too_late,
    cancel_before_handle,
    destroyed_in_use,
    inside,
    last_error_lost,
    spins_inside,
    visible_too_early,
    waits_for_itself,
    watchdog_late,
)

# What `explore` says about each bug.
STORIES = {
    answer_before_entry: (
        "`Asks.on_answer` calls Asks.expected.pop() (line 39) before `Asks.ask` writes "
        "Asks.expected = a dict of 1 (line 35). Then thread Asks.work of Asks still waits at line "
        "29: `self.ask(number).wait()`."
    ),
    both_remove: ("and then `Jobs.clean` calls Jobs.jobs.remove() (line 26). Then `Jobs.clean` fails at"),
    callback_too_late: (
        "`Result.when_set` reads Result.value = None (line 23) before `Result.set` writes Result.value"
    ),
    cancel_before_handle: (
        "`Bridge.on_stop` reads Bridge.goal = None (line 32) before `Bridge.on_answer` writes "
        "Bridge.goal = a ClientGoalHandle (line 29); in the usual order it reads a ClientGoalHandle"
        " there. Then the goal of /fibonacci succeeds at 1.505 s; in the usual order it is canceled"
        " at 1.05 s."
    ),
    destroyed_in_use: (
        "before `Switches.send` calls Switches.publisher.publish() (line 30), and then "
        "`Switches.switch` writes Switches.publisher (line 27)."
    ),
    last_error_lost: (
        "`Batch.watch` reads Batch.error = None (line 31) before `Batch.work` writes Batch.error = "
        "an OSError (line 26)."
    ),
    spins_inside: ("Then no call of `Localizer.on_scan` of /localizer returns."),
    visible_too_early: (
        "`Filter.on_number` reads Filter.offset = nothing (line 18) before `Filter.__init__` writes"
        " Filter.offset = 3 (line 15)."
    ),
    waits_for_itself: (
        "`Drives.tick` reads Drives.mode = None (line 44) before `Drives.on_mode` writes Drives.mode = "
        "'slow' (line 41); in the usual order it reads 'slow' there."
    ),
    watchdog_late: ("`Arm.watch` reads Arm.fed = "),
}
BUGS = pytest.mark.parametrize("bug", STORIES, ids=lambda bug: bug.__name__.rpartition(".")[2])
PROGRAMS = pytest.mark.parametrize(("wrong", "right"), inside.PROGRAMS.values(), ids=inside.PROGRAMS)


def no_errors(recording):
    return not recording.errors


def explored(bug, nodes, orders):
    """Explore one of the bugs."""
    holds, seconds = getattr(bug, "holds", no_errors), getattr(bug, "SECONDS", 4.0)
    return explore(*nodes, holds=holds, orders=orders, seconds=seconds)


@BUGS
def test_a_real_bug_is_found_and_explained(bug):
    found = explored(bug, bug.WRONG, 150)
    assert STORIES[bug] in found.explanation
    assert "It fails again in 10 of 10 runs." in found.explanation
    assert found.unseen == {}


@BUGS
def test_its_repair_is_not_reported(bug):
    found = explored(bug, bug.RIGHT, 8)
    assert found.failed is None, found.explanation


@pytest.mark.soak
@BUGS
def test_its_repair_is_not_reported_in_500_orders(bug):
    found = explored(bug, bug.RIGHT, 500)
    assert found.failed is None, found.explanation


@PROGRAMS
def test_a_race_inside_a_function_is_found(wrong, right):
    found = explore(*wrong, holds=no_errors, level="host", seconds=2)
    assert found.failed
    assert len(found.departures) == 1
    again = run(*wrong, seconds=2, quiet=True, order=found.failed)
    assert again.digest == found.recording.digest


@PROGRAMS
def test_its_right_twin_is_not_reported(wrong, right):
    assert explore(*right, holds=no_errors, level="host", orders=8, seconds=2).failed is None


@pytest.mark.soak
@PROGRAMS
def test_its_right_twin_is_not_reported_in_500_orders(wrong, right):
    found = explore(*right, holds=no_errors, level="host", orders=500, seconds=2)
    assert found.failed is None, found.explanation


def test_threads_that_wait_for_each_other_are_named():
    found = explore(*inside.PROGRAMS["two locks"][0], holds=no_errors, level="host", seconds=2)
    waits = "thread <lambda> of main still waits at line 88: `with second:`"
    assert f"Then {waits}. Then {waits}. Then `look` fails" in found.explanation


# -- code in other modules, and code that can't be looked into ---------------------------------------

WORKER = """
def work(node):
    import helper_of_worker
    for _ in range(10):
        helper_of_worker.increment(node)
        node.get_clock().sleep_for(node.pause)
"""
HELPER = """
def increment(node):
    count = node.count
    node.count = count + 1
"""
MAIN = """
import threading

import rclpy
from rclpy.duration import Duration
from rclpy.node import Node


class Counter(Node):
    def __init__(self):
        super().__init__("counter")
        self.count, self.pause = 0, Duration(seconds=0.01)
        self.workers = [threading.Thread(target=work, args=(self,)) for _ in range(2)]
        for worker in self.workers:
            worker.start()
        self.create_timer(0.5, self.look)

    def look(self):
        assert any(worker.is_alive() for worker in self.workers) or self.count == 20
"""


@pytest.fixture
def load(tmp_path, monkeypatch):
    """Write a module and import it; all of them are forgotten afterwards."""
    monkeypatch.syspath_prepend(tmp_path)
    loaded = []

    def load(name: str, source: str, imported: bool = True):
        loaded.append(name)
        (tmp_path / f"{name}.py").write_text(source, encoding="utf-8")
        return importlib.import_module(name) if imported else None

    yield load
    for name in loaded:
        sys.modules.pop(name, None)


def test_modules_that_a_function_imports_are_looked_into(load):
    load("helper_of_worker", HELPER, imported=False)
    load("worker_of_counter", WORKER)
    node = load("counter_with_worker", f"from worker_of_counter import work\n{MAIN}").Counter
    found = explore(node, holds=no_errors, level="host", seconds=2)
    assert "before line 4 of increment" in found.explanation
    assert found.unseen == {}


def test_a_module_that_is_imported_in_the_run_is_looked_into(load):
    load("helper_of_worker", HELPER, imported=False)
    load("worker_of_counter", WORKER)
    node = load("counter_with_worker", f"from worker_of_counter import work\n{MAIN}").Counter
    found = explore(node, holds=no_errors, level="host", seconds=2)
    del sys.modules["helper_of_worker"]
    assert run(node, seconds=2, quiet=True, order=found.failed).digest == found.recording.digest


def test_code_without_source_is_named(load):
    module = load("counter_without_source", MAIN)
    increment = HELPER + WORKER.replace("import helper_of_worker", "pass").replace("helper_of_worker.", "")
    exec(increment, vars(module))
    found = explore(module.Counter, holds=no_errors, level="host", orders=2, seconds=1)
    assert found.explanation == (
        "It holds in the usual order and in 2 others. No thread was preempted in `increment`, `work` (its "
        "source code is not available)."
    )


def test_code_that_has_changed_since_it_was_loaded_is_named(load, tmp_path):
    module = load("counter_that_changes", HELPER + WORKER.replace("import helper_of_worker", "pass") + MAIN)
    module.helper_of_worker = module
    source = Path(module.__file__)
    source.write_text(source.read_text(encoding="utf-8").replace("count + 1", "count + 2"), encoding="utf-8")
    found = explore(module.Counter, holds=no_errors, level="host", orders=2, seconds=1)
    assert (
        "No thread was preempted in `increment` (its source code has changed since it was loaded)."
        in repr(found)
    )


def test_compiled_code_is_named(load, tmp_path):
    source = tmp_path / "compiled_part.c"
    source.write_text(
        '#include <Python.h>\nstatic struct PyModuleDef part = {PyModuleDef_HEAD_INIT, "compiled_part"};\n'
        "PyMODINIT_FUNC PyInit_compiled_part(void) { return PyModule_Create(&part); }\n"
    )
    target = tmp_path / f"compiled_part{sysconfig.get_config_var('EXT_SUFFIX')}"
    include = sysconfig.get_paths()["include"]
    subprocess.run(["gcc", "-shared", "-fPIC", f"-I{include}", "-o", target, source], check=True)
    load("helper_of_worker", HELPER, imported=False)
    load("worker_of_counter", WORKER)
    node = load(
        "counter_with_compiled", f"import compiled_part\nfrom worker_of_counter import work\n{MAIN}"
    ).Counter
    found = explore(node, holds=lambda recording: True, level="host", orders=1, seconds=1)
    assert found.explanation.endswith(" No thread was preempted in `compiled_part` (it is compiled).")


CELL = 'found = explore(Counter, holds=holds, level="host", orders=2, seconds=1)'


def test_the_cell_that_explores_is_no_code_of_the_nodes(load):
    names = vars(load("counter_in_a_notebook", f"from sim import explore\n{HELPER}\n{WORKER}\n{MAIN}"))
    names |= {"helper_of_worker": load("helper_of_worker", HELPER), "holds": lambda recording: True}
    exec(compile(CELL, names["__file__"], "exec"), names)  # as a notebook's cell, with the nodes' names
    assert names["found"].unseen == {}


def test_nothing_is_named_without_threads(load):
    module = load("without_threads", MAIN.replace("range(2)", "range(0)"))
    exec(HELPER, vars(module))
    assert explore(module.Counter, holds=lambda recording: True, orders=2, seconds=1).unseen == {}


class Repeats(Node):
    """Has one thread, and its work in a lambda."""

    def __init__(self):
        super().__init__("repeats")
        publisher = self.create_publisher(Int32, "data", 10)
        self.create_timer(0.5, lambda: publisher.publish(Int32(data=3)))


@pytest.mark.parametrize("order", [0, 1, 2])
def test_a_lambda_of_a_program_with_one_thread_does_its_work_in_every_order(order):
    recording = run(Repeats, seconds=1.2, order=order, quiet=True)
    assert [received.message.data for received in recording.messages("/data")] == [3, 3]
