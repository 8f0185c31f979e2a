"""What holds for all tests: how workers share them, and what is left out on this machine."""

from __future__ import annotations

import asyncio
import gc
import importlib
import os
import signal
import tomllib
from collections import Counter
from collections.abc import Generator, Iterator
from pathlib import Path
from typing import Any

import pytest
from xdist.scheduler import LoadScopeScheduling

ROOT = Path(__file__).parents[1]
# The tests of each part also run where nothing of the parts above it is installed: see .ci/parts.
pytest_plugins = ["tests.sandboxes"] if (ROOT / "grader" / "marking").exists() else []
DISTRO = importlib.import_module("sim.distro").DISTRO if (ROOT / "sim").exists() else "jazzy"

# What takes long or waits comes first, and many small files last: so no worker is left alone at the end. The
# lessons are run before tests/exercises/ looks at some of them again.
LESSONS = "tests/tooling/test_lessons.py"
FIRST = ("tests/browser/", LESSONS, "tests/marking/", "tests/tooling/", "tests/exercises/", "tests/sim/ros/")


IN_LAB = "cells_in_lab", "course", "play_in_lab", "replay_in_lab", "students_lab", "terminals"
LAB = [f"tests/browser/test_{name}.py" for name in IN_LAB]
ON_HUB = "browser/test_hub_day", "marking/extras/hub/test_killed_hub", "marking/extras/hub/test_real_hub"
HUB = [f"tests/{name}.py" for name in ON_HUB]
# What a class may use besides marking, and pages in the browser but for the main ones: only CI, `make test
# ARGS=extras` and runs that name them test it.
EXTRAS = "tests/marking/extras", "tests/browser"
MAIN = tuple(f"tests/browser/test_{name}" for name in ("cells_in_lab", "course", "students_lab", "terminal"))
# What is run on another ROS distribution: the engine, two assignments, scores in two processes, two lessons.
ASSIGNMENTS = [f"tests/exercises/test_{name}.py" for name in ("nodes", "topics", "remote")]
ON_OTHERS = "tests/sim/ros/", *ASSIGNMENTS
RUNS = f"{LESSONS}::test_a_lesson_runs_from_top_to_bottom"
LESSONS_ON_OTHERS = f"{RUNS}[00_robot/lesson]", f"{RUNS}[01_nodes/lesson]"


class ByFile(LoadScopeScheduling):
    """A file's tests share its fixtures, so one worker runs them; score tables are dealt out by exercise.

    And one worker drives JupyterLab, one a cluster, and one a hub, whose users are those of the machine.
    """

    def _split_scope(self, nodeid: str) -> str:
        file, _, rest = nodeid.partition("::")
        if file in LAB:
            return "JupyterLab"
        if file.startswith("tests/marking/extras/dask_cluster/"):
            return "cluster"
        if file in HUB:
            return "hub"
        exercise = rest.partition("[")[2].partition("-")[0] if file.startswith("tests/exercises/") else ""
        return f"{file}[{exercise}]" if exercise else file


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """Collect tests without the garbage collector: almost all that is created stays."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.enable()


def pytest_configure() -> None:
    """Let Ctrl-C reach tests, also where the shell that started them ignores it in background jobs."""
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_xdist_auto_num_workers() -> int:
    """Two workers more than there are cores: tests wait for browsers, kernels and processes that mark."""
    return len(os.sched_getaffinity(0)) + 2


def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> LoadScopeScheduling | None:
    if config.option.dist != "loadfile":
        return None
    config.option.loadscopereorder = False
    return ByFile(config, log)


@pytest.hookimpl(tryfirst=True)  # before the marks are read that a run selects
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    def place(item: pytest.Item) -> int:
        return next((n for n, folder in enumerate(FIRST) if item.nodeid.startswith(folder)), len(FIRST))

    items.sort(key=place)
    differences = differences_of(DISTRO)
    for item in items:
        if is_extra(item.nodeid, config.args):
            item.add_marker("extras")
        daily = item.nodeid.startswith(ON_OTHERS) and not item.get_closest_marker("soak")
        if daily or item.nodeid in LESSONS_ON_OTHERS:
            item.add_marker("distributions")
        if item.nodeid in differences:
            item.add_marker(pytest.mark.xfail(reason=differences[item.nodeid], strict=True))


def differences_of(distro: str) -> dict[str, str]:
    """Why tests fail on a ROS distribution other than Jazzy, by their ids."""
    rows = tomllib.loads((Path(__file__).parent / "distributions.toml").read_text("utf-8")).get(distro, ())
    return {test: row["why"] for row in rows for test in row["tests"]}


def is_extra(nodeid: str, arguments: list[str]) -> bool:
    """Whether a test is one of the extras, and no argument of pytest names such a file or folder."""
    named = any(place in argument for argument in arguments for place in EXTRAS)
    return nodeid.startswith(EXTRAS) and not nodeid.startswith(MAIN) and not named


@pytest.fixture(autouse=True)
def no_event_loop_is_left_running() -> Iterator[None]:
    """Where one is, `play` returns at once, and so a later test would fail for this one's fault."""
    before = asyncio._get_running_loop()
    yield
    assert asyncio._get_running_loop() is before, "this test left an event loop running in its thread"


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """One line for each reason why tests were left out."""
    skipped = terminalreporter.stats.get("skipped", [])
    for reason, number in Counter(report.longrepr[2] for report in skipped).items():
        terminalreporter.write_line(f"Left out: {number} tests, {reason.removeprefix('Skipped: ')}")
