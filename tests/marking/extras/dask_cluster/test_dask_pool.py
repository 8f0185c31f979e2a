import gc
import re
import shutil
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import psutil
import pytest
from distributed.utils import asyncio_run

from grader.marking.errors import DaskPoolError
from grader.marking.extras.dask_cluster import DaskPool
from grader.marking.pool import Pool
from grader.marking.result import Result
from grader.marking.task import MarkingTask
from tests.marking.assignment import hand_in, release, task
from tests.marking.extras.dask_cluster import liars
from tests.marking.student_processes import USUAL
from tests.marking.tiny import ROOT
from tests.patience import PATIENCE, until

HOW = {"unsafe": True, "secret": "a secret", "time_limits": USUAL}
REMOTE = {**HOW, "wait_s": PATIENCE}
LOST = "The worker that marked this was lost."


@pytest.fixture(scope="module")
def tasks(tmp_path_factory) -> list[MarkingTask]:
    """A right submission, one half right, and one that ends its process; three that are damaged."""
    folder = tmp_path_factory.mktemp("class")
    released = release(folder / "02_two")
    half, stop = ({"temperature": source} for source in ("Thermometer = None", "import os\nos._exit(0)"))
    made = {"right": {}, "half": half, "stop": stop, "broken": {}, "link": {}}
    for name, answers in made.items():
        hand_in(folder / name, released, answers)
    (folder / "broken" / "two.ipynb").write_bytes(b"\x00")
    (folder / "link" / "notes").symlink_to("/etc/passwd")
    return [task(folder / name, released) for name in (*made, "nothing")]


@pytest.fixture(scope="module")
def here(tasks) -> dict[str, str]:
    """What the pool of this machine gives."""
    with Pool(2, **HOW) as pool:
        return grades(pool.mark(tasks))


def grades(results: Iterator[Result]) -> dict[str, str]:
    return {result.student: result.grade_json() for result in results}


def at_work_on(pool: DaskPool, student: str) -> str:
    """The address of the worker that marks a student's submission."""
    return next(job.address for job in pool._running.values() if job.task.student == student)


@pytest.mark.soak
def test_a_class_has_the_grades_that_one_machine_gives_though_a_worker_is_killed(
    shared, tasks, here, waiting, gate
):
    shared.with_workers(2)
    with DaskPool(shared.address, **REMOTE) as pool, ThreadPoolExecutor(1) as thread:
        results = thread.submit(lambda: grades(pool.mark([waiting, *tasks])))
        gate.read_text()
        shared.kill(at_work_on(pool, "ann"))
        gate.read_text()
        found = results.result()
        assert shared.children() != []
    assert shared.children() == []
    ann = Result.from_json(found.pop("ann"))
    assert (ann.verdict, ann.points, ann.flags) == ("marked", 23.0, [])
    assert found == here


def test_no_tasks_give_no_results(shared):
    with DaskPool(shared.address, **REMOTE) as pool:
        assert list(pool.mark([])) == []


@pytest.mark.soak
def test_a_submission_that_ends_every_worker_is_left_to_the_instructor(
    shared, tasks, here, waiting, gate, monkeypatch
):
    monkeypatch.setattr("grader.marking.extras.dask_cluster.dask_pool.TRIES", 2)
    shared.with_workers(3)
    with DaskPool(shared.address, **REMOTE) as pool, ThreadPoolExecutor(1) as thread:
        results = thread.submit(lambda: grades(pool.mark([waiting, tasks[0]])))
        for _ in range(2):
            gate.read_text()
            shared.kill(at_work_on(pool, "ann"))
        found = results.result()
    broken = Result("ann", "02_two", "0" * 64, "broken", LOST)
    assert found == {"ann": broken.grade_json(), "right": here["right"]}


def test_who_closes_it_ends_what_is_marked(shared, staying, gate):
    shared.with_workers(1)
    with ThreadPoolExecutor(1) as thread:
        with DaskPool(shared.address, **REMOTE) as pool:
            result = thread.submit(next, pool.mark([staying]))
            gate.read_text()
            left = shared.children()
        assert isinstance(result.exception(), DaskPoolError)
    assert len(left) > 3
    assert psutil.wait_procs(left, PATIENCE)[1] == []


@pytest.mark.soak
def test_a_scheduler_that_goes_stops_the_marking_and_what_came_before_stays(cluster, tasks, staying, gate):
    cluster.with_workers(1)
    with DaskPool(cluster.address, **REMOTE) as pool, ThreadPoolExecutor(1) as thread:
        marking = pool.mark([tasks[0], staying])
        assert next(marking).points == 23.0
        result = thread.submit(next, marking)
        gate.read_text()
        pool._client._timeout = 1.0
        cluster.scheduler.kill()
        output = f"the scheduler at {cluster.address} has not answered for {PATIENCE:g} s"
        assert str(result.exception()) == output
    cluster.processes[1].kill()  # a worker that gets a signal waits for its cell


@pytest.fixture
def another(tmp_path) -> Path:
    """The course with one file more."""
    for package in ("grader", "sim"):
        shutil.copytree(ROOT / package, tmp_path / "another" / package)
    (tmp_path / "another" / "grader" / "more.py").touch()
    return tmp_path / "another"


@pytest.fixture
def broken(tmp_path) -> Path:
    """A folder in which the course can't be found."""
    (tmp_path / "broken" / "grader").mkdir(parents=True)
    error = "raise ModuleNotFoundError(\"No module named 'grader'\")"
    (tmp_path / "broken" / "grader" / "__init__.py").write_text(error)
    return tmp_path / "broken"


@pytest.mark.soak
def test_workers_that_cant_mark_are_named_and_left_out(cluster, tasks, another, broken, capsys):
    cluster.worker(PYTHONPATH=str(another))
    cluster.worker(PYTHONPATH=str(broken))
    cluster.worker(PATH="")  # there is no bubblewrap
    cluster.with_workers(3)
    sandboxed = {**REMOTE, "unsafe": False}
    with DaskPool(cluster.address, **sandboxed) as pool, ThreadPoolExecutor(1) as thread:
        marking = thread.submit(next, pool.mark(tasks))
        until(lambda: len(pool._workers._unfit) == 3)
        pool._wait_s = 1.0
        error = marking.exception()
    absent = f"no worker of the scheduler at {cluster.address} could mark anything for 1 s"
    start = f"`.venv/bin/dask worker {cluster.address} --nworkers -1 --nthreads 1` starts some"
    assert str(error) == f"{absent}: {start}"
    lines = sorted(re.sub(r"tcp://\S+|\b[0-9a-f]{12}\b", "*", capsys.readouterr().err).splitlines())
    assert lines == [
        "The worker * is left out: Marking runs students' code in a sandbox made by bubblewrap, and this "
        "machine has no `bwrap`: install it with `sudo apt install bubblewrap`, or mark with `--unsafe`, "
        "which lets students' code read and change all your files.",
        "The worker * is left out: it can't load the course (ModuleNotFoundError(\"No module named "
        "'grader'\")). Start it in a folder with this course, after `make setup`: "
        "`.venv/bin/dask worker SCHEDULER`.",
        "The worker * is left out: it has course *, here *. Bring both to the same version of the course "
        "with `git pull` and `make setup`, and start it again.",
    ]
    with DaskPool(cluster.address, **REMOTE) as pool:  # without a sandbox, one of them can mark
        assert [result.points for result in pool.mark(tasks[:1])] == [23.0]


@pytest.mark.parametrize(
    ("answer", "why"),
    [
        (liars.nonsense, "ResultError: this is not a result of marking: 'notebooks'"),
        (liars.number, "ResultError: expected text, saw int"),
        (liars.other, "ResultError: this is the result of another submission"),
        (liars.crash, "ValueError: a worker's own mistake"),
        (liars.failed, "OSError: No space left on device"),
    ],
)
def test_an_answer_that_is_no_result_is_reported(shared, tasks, monkeypatch, answer, why):
    shared.with_workers(1)
    monkeypatch.setattr("grader.marking.extras.dask_cluster.dask_pool.mark_task", answer)
    with DaskPool(shared.address, **REMOTE) as pool:
        [result] = pool.mark(tasks[:1])
    assert (result.verdict, result.reason) == ("broken", why)


def test_what_fails_at_one_worker_is_given_to_another(shared, tasks, monkeypatch, tmp_path):
    """The worker that is asked first has a full disk, as it seems."""
    shared.with_workers(2)
    fails = partial(liars.fails_at_first, str(tmp_path / "first"))
    monkeypatch.setattr("grader.marking.extras.dask_cluster.dask_pool.mark_task", fails)
    with DaskPool(shared.address, **REMOTE) as pool:
        [result] = pool.mark(tasks[:1])
    assert result.verdict == "marked"


@pytest.mark.parametrize(
    ("address", "wait_s", "why"),
    [
        ("nonsense", PATIENCE, "missing port number in address 'nonsense'"),
        ("smoke://hill:1", PATIENCE, "unknown address scheme 'smoke'"),
        ("tcp://127.0.0.1:1", 0.1, "Timed out trying to connect to tcp://127.0.0.1:1 after 0.1 s"),
        ("tls://127.0.0.1:1", PATIENCE, "TLS expects a `ssl_context` argument of type ssl.SSLContext"),
    ],
)
def test_a_scheduler_that_cant_be_reached_is_named(address, wait_s, why):
    with pytest.raises(DaskPoolError) as error:
        DaskPool(address, wait_s=wait_s)
    output = str(error.value)
    assert output.startswith(f"no Dask scheduler answers at {address} ({why}")
    assert output.endswith("): `.venv/bin/dask scheduler` starts one")


def test_who_could_not_connect_is_not_in_the_way_of_the_next(monkeypatch):
    """Garbage may be collected in any thread, also in that of the next client's loop."""

    def run(*args: Any, **options: Any) -> None:
        gc.collect()
        asyncio_run(*args, **options)

    monkeypatch.setattr("distributed.utils.asyncio_run", run)
    for _ in range(2):
        with pytest.raises(DaskPoolError, match="missing port number"):
            DaskPool("nonsense", wait_s=PATIENCE)


def test_without_the_library_it_says_how_to_install_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    monkeypatch.delitem(sys.modules, "grader.marking.extras.dask_cluster.connection", raising=False)
    with pytest.raises(DaskPoolError) as error:
        DaskPool("tcp://127.0.0.1:1")
    assert str(error.value) == (
        "--dask needs the library distributed, which is not installed: run `make setup`"
    )
