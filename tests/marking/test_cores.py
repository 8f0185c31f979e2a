"""On which cores submissions are marked."""

import contextlib
import os
import threading
from collections import defaultdict

import pytest

from grader.marking import cores
from grader.marking.cores import Cores
from grader.marking.pool import Pool
from grader.marking.sandbox import ConfinedProcess
from tests.marking.assignment import hand_in, release
from tests.marking.sandbox.commanded import Commanded, sandbox


@pytest.fixture
def three(monkeypatch):
    """A machine of three cores, of which none is number 1."""
    monkeypatch.setattr(cores, "usable_cores", lambda: [0, 2, 3])


def taken(jobs: int) -> list[int | None]:
    """The cores of so many jobs at a time."""
    free = Cores(jobs)
    with contextlib.ExitStack() as at_work:
        return [at_work.enter_context(free.one()) for _ in range(jobs)]


@pytest.mark.parametrize(
    ("jobs", "expected"),
    [(1, {None: 1}), (2, {None: 2}), (3, {0: 1, 2: 1, 3: 1}), (6, {0: 2, 2: 2, 3: 2})],
)
def test_each_job_keeps_to_a_core_where_there_are_as_many_jobs(three, jobs, expected):
    found = taken(jobs)
    assert {core: found.count(core) for core in found} == expected


def test_a_core_is_free_again_after_the_job_also_after_an_error(three):
    free = Cores(3)
    with free.one() as first, free.one() as second:
        with pytest.raises(ZeroDivisionError), free.one() as third:
            raise ZeroDivisionError
        with free.one() as fourth:
            assert third == fourth
        assert {first, second, third} == {0, 2, 3}


def test_judge_and_student_take_turns_on_one_core(tmp_path, monkeypatch):
    released = release(tmp_path / "02_two")
    tasks = [hand_in(tmp_path / name, released) for name in ("anna", "bert", "carl")]
    kept = defaultdict(list)  # by the thread that marks
    keep_to = ConfinedProcess.keep_to

    def keep(process: ConfinedProcess, core: int) -> None:
        keep_to(process, core)
        kept[threading.get_ident()].append(os.sched_getaffinity(process.pid))

    monkeypatch.setattr(ConfinedProcess, "keep_to", keep)
    with Pool(len(cores.usable_cores()), unsafe=True) as pool:
        assert [result.points for result in pool.mark(tasks)] == [23.0] * 3
    pairs = [pair for places in kept.values() for pair in turns(places)]
    assert len(pairs) == 3
    assert all(judge == student and len(judge) == 1 for judge, student in pairs)


def turns(places: list[set[int]]) -> list[tuple[set[int], set[int]]]:
    """Judges' places, each with that of its student."""
    return list(zip(places[::2], places[1::2], strict=True))


def test_a_process_that_has_ended_is_kept_nowhere():
    here = os.sched_getaffinity(0)
    with sandbox(unsafe=True) as box:
        commanded = Commanded(box)
        commanded.leave()
        commanded.process.keep_to(cores.usable_cores()[0])
    assert os.sched_getaffinity(0) == here
