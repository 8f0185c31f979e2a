import os
import select
import subprocess
import sys
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import pytest

from grader.marking.pool import Pool
from grader.marking.result import Result
from grader.marking.sandbox import Sandbox
from grader.marking.task import MarkingTask, TimeLimits
from tests.marking.assignment import hand_in, release, task
from tests.marking.student_processes import USUAL
from tests.marking.tiny import ROOT
from tests.patience import PATIENCE


@pytest.fixture(scope="module")
def tasks(tmp_path_factory) -> list[MarkingTask]:
    """Six submissions: all right, one answer right, none, an error, damaged, stopped."""
    folder = tmp_path_factory.mktemp("class")
    released = release(folder / "02_two")
    made = {
        "right": {},
        "half": {"temperature": "Thermometer = None"},
        "none": {"greeting": "Greeter = None", "temperature": "Thermometer = None"},
        "error": {"greeting": "1 / 0"},
        "stopped": {"temperature": "import os\nos._exit(0)"},
        "broken": {},
    }
    for name, answers in made.items():
        hand_in(folder / name, released, answers)
    (folder / "broken" / "two.ipynb").write_bytes(b"\x00")
    return [task(folder / name, released) for name in made]


@pytest.fixture(scope="module")
def pool() -> Iterator[Pool]:
    with Pool(2, unsafe=True, secret="a secret", time_limits=USUAL) as pool:
        yield pool


@pytest.fixture(scope="module")
def results(pool, tasks) -> list[Result]:
    """What they get."""
    return list(pool.mark(tasks))


def grades(results: Iterable[Result]) -> dict[str, str]:
    return {result.student: result.grade_json() for result in results}


def summary(result: Result) -> tuple[str, str, float]:
    return result.student, result.verdict, result.points


def test_a_class_is_marked(results):
    assert sorted(map(summary, results)) == [
        ("broken", "refused", 0.0),
        ("error", "marked", 15.0),
        ("half", "marked", 8.0),
        ("none", "marked", 0.0),
        ("right", "marked", 23.0),
        ("stopped", "stopped", 8.0),
    ]
    right = next(result for result in results if result.student == "right")
    assert right.timings["memory"] > 20
    assert {"start", "total", "computing", "two/greeting-points"} <= right.timings.keys()
    judged = {result.student: result.timings.get("judged") for result in results}  # simulated seconds
    assert judged == {"broken": None, "error": 10, "half": 5, "none": 0, "right": 15, "stopped": 5}


@pytest.mark.parametrize(("jobs", "unsafe"), [(3, False), pytest.param(1, True, marks=pytest.mark.soak)])
def test_grades_are_the_same_in_any_order_with_any_number_of_jobs_and_in_a_sandbox(
    tasks, results, jobs, unsafe
):
    with Pool(jobs, unsafe=unsafe, secret="a secret", time_limits=USUAL) as other:
        assert grades(other.mark(reversed(tasks))) == grades(results)


def test_no_tasks_give_no_results(pool):
    assert list(pool.mark([])) == []


def test_a_judge_that_is_killed_is_replaced_once(pool, waiting, gate):
    with ThreadPoolExecutor(1) as thread:
        result = thread.submit(lambda: next(pool.mark([waiting])))
        gate.read_text()
        kill_judges(pool)
        gate.read_text()
        assert summary(result.result()) == ("ann", "marked", 23.0)


@pytest.mark.soak
def test_a_judge_that_is_killed_twice_leaves_it_to_the_instructor(pool, waiting, gate):
    with ThreadPoolExecutor(1) as thread:
        result = thread.submit(lambda: next(pool.mark([waiting])))
        for _ in range(2):
            gate.read_text()
            kill_judges(pool)
        why = "The judge's process ended unexpectedly. The process was killed from outside."
        assert result.result() == Result("ann", "02_two", "0" * 64, "broken", why)


def kill_judges(pool: Pool) -> None:
    for process in list(pool._running):
        if process.pid in children(pool._judges):
            process.kill()


def children(sandbox: Sandbox) -> list[int]:
    """The processes that a sandbox's warm process has started."""
    warm = sandbox._warm._process.pid
    parents = Path(f"/proc/{warm}/task/{warm}/children").read_text().split()
    return [int(pid) for parent in parents
            for pid in Path(f"/proc/{parent}/task/{parent}/children").read_text().split()]  # fmt: skip


@pytest.mark.parametrize("which", ["_judges", "_students"])
def test_a_warm_process_that_dies_is_started_again(pool, tasks, which):
    getattr(pool, which)._warm._process.kill()
    assert [summary(result) for result in pool.mark(tasks[:1])] == [("right", "marked", 23.0)]


def test_others_go_on_when_a_warm_process_dies(pool, waiting, gate, tasks):
    with ThreadPoolExecutor(1) as thread:
        results = thread.submit(lambda: list(pool.mark([waiting, *tasks])))
        gate.read_text()
        pool._judges._warm._process.kill()
        gate.read_text()
        assert len(results.result()) == len(tasks) + 1
        assert all(result.verdict != "broken" for result in results.result())


@pytest.fixture(scope="module")
def odd_judges() -> Iterator[Sandbox]:
    with Sandbox("judges:main", preload=(), unsafe=True, imports=[Path(__file__).parent]) as judges:
        yield judges


@pytest.mark.parametrize(
    ("student", "why"),
    [
        ("nonsense", "The judge returned no result: this is not a result of marking: 'notebooks'"),
        ("refusal", "The test cell `x` can't be marked here."),
        ("crash", "The judge's process ended unexpectedly. The process crashed: Aborted."),
    ],
)
def test_a_judge_that_gives_no_result_is_reported(pool, tasks, odd_judges, student, why, monkeypatch):
    monkeypatch.setattr("grader.marking.pool.END_S", PATIENCE)
    monkeypatch.setattr(pool, "_judges", odd_judges)
    [result] = pool.mark([replace(tasks[0], student=student)])
    assert (result.verdict, result.reason, result.notebooks) == ("broken", why, [])


def test_a_judge_that_says_nothing_is_given_up(pool, tasks, odd_judges, monkeypatch):
    monkeypatch.setattr("grader.marking.pool.SPARE_S", 0.0)
    monkeypatch.setattr(pool, "_time_limits", TimeLimits(start=0.1, notebook=0.1))
    monkeypatch.setattr(pool, "_judges", odd_judges)
    [result] = pool.mark([replace(tasks[0], student="silent")])
    why = "It took more than 0.2 s."
    assert (result.verdict, result.reason, result.notebooks) == ("broken", why, [])


def test_a_release_that_cant_be_marked_is_named(pool, tmp_path, tasks):
    released = release(tmp_path / "02_two")
    text = (released / "two.ipynb").read_text()
    (released / "two.ipynb").write_text(text.replace("topics.greeting.grade", "unknown.greeting.grade"))
    [result] = pool.mark([hand_in(tmp_path / "ann", released)])
    assert result.reason.startswith("The test cell `greeting-points` can't be marked here: expected")


def test_a_pool_that_is_closed_leaves_no_process(waiting, tasks):
    pool = Pool(2, unsafe=True, time_limits=USUAL)
    results = pool.mark([waiting, tasks[0]])
    assert summary(next(results)) == ("right", "marked", 23.0)
    left = [os.pidfd_open(process.pid) for process in pool._running]
    left += [os.pidfd_open(box._warm._process.pid) for box in (pool._judges, pool._students)]
    pool.close()
    assert all(gone(pidfd) for pidfd in left)
    assert pool._running == set()
    pool.close()


KILLED = """\
import sys
from pathlib import Path
from grader.marking.pool import Pool
from concurrent.futures import ThreadPoolExecutor
from tests.marking.assignment import task
from tests.marking.test_pool import children

folder = Path(sys.argv[1])
with Pool(1, unsafe=True) as pool, ThreadPoolExecutor(1) as thread:
    result = thread.submit(lambda: next(pool.mark([task(folder / "ann", folder / "02_two")])))
    input()
    boxes = (pool._judges, pool._students)
    print(*(pid for box in boxes for pid in (box._warm._process.pid, *children(box))), flush=True)
    result.result()
"""


@pytest.mark.soak
def test_a_marker_that_is_killed_leaves_no_process(staying, gate, tmp_path):
    command = [sys.executable, "-c", KILLED, str(tmp_path)]
    pipe = subprocess.PIPE
    place = {**os.environ, "TMPDIR": str(tmp_path)}
    with subprocess.Popen(command, stdin=pipe, stdout=pipe, text=True, cwd=ROOT, env=place) as marker:
        gate.read_text()
        print(file=marker.stdin, flush=True)
        left = [os.pidfd_open(int(pid)) for pid in marker.stdout.readline().split()]
        marker.kill()
    assert len(left) == 4
    assert all(gone(pidfd) for pidfd in left)


def gone(pidfd: int) -> bool:
    """Whether a process ends."""
    ended = bool(select.select([pidfd], [], [], PATIENCE)[0])
    os.close(pidfd)
    return ended
