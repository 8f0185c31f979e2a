from collections.abc import Iterator
from dataclasses import replace

import psutil
import pytest

from grader.marking.extras.dask_cluster.on_worker import RunSettings, WorkerPool
from grader.marking.result import Result
from grader.marking.sandbox import ResourceLimits
from grader.marking.task import MarkingTask, TimeLimits
from tests.marking.assignment import hand_in, release

FIRST = RunSettings("first", True, "a secret of this test", TimeLimits(), ResourceLimits())


@pytest.fixture
def right(tmp_path) -> MarkingTask:
    """A right submission."""
    return hand_in(tmp_path / "ann", release(tmp_path / "02_two"))


@pytest.fixture
def worker_pool() -> Iterator[WorkerPool]:
    worker_pool = WorkerPool()
    yield worker_pool
    worker_pool.close()


def test_a_worker_has_one_pool_which_ends_with_its_run(worker_pool, right):
    before = set(psutil.Process().children(True))
    points = []
    for run in ("first", "first", "second"):
        kind, text = worker_pool.mark(replace(FIRST, run=run), right)
        points.append((kind, Result.from_json(text).points))
        assert len(set(psutil.Process().children()) - before) == 2
    assert points == [("marked", 23.0)] * 3
    worker_pool.leave("first")
    assert len(set(psutil.Process().children()) - before) == 2
    worker_pool.leave("second")
    assert set(psutil.Process().children(True)) <= before


def test_a_run_that_is_over_is_not_begun_again(worker_pool, right):
    before = set(psutil.Process().children(True))
    worker_pool.leave("first")
    assert worker_pool.mark(FIRST, right) == ("failed", "RuntimeError: the run is over")
    assert set(psutil.Process().children(True)) <= before


def test_nothing_is_raised_for_dask_would_log_the_secret(worker_pool, right):
    why = "AttributeError: 'int' object has no attribute 'release'"
    assert worker_pool.mark(FIRST, 7) == ("failed", why)
    assert "secret" not in repr(FIRST)


def test_a_machine_without_a_sandbox_is_reported(worker_pool, right, monkeypatch):
    monkeypatch.setenv("PATH", "")
    kind, why = worker_pool.mark(replace(FIRST, unsafe=False), right)
    assert kind == "unfit"
    assert why.startswith("Marking runs students' code in a sandbox made by bubblewrap, and this machine ")
