"""Before a class is marked, the machine shows that it marks."""
from dataclasses import replace

import pytest

from grader.marking import self_check
from grader.marking.errors import SandboxFailed
from grader.marking.pool import Pool
from grader.marking.result import Result
from grader.marking.sandbox import bubblewrap
from tests.marking.student_processes import USUAL

REPAIR = "No submission was marked: repair the installation, or use another machine."
GREETING = "to the exercise greeting got"


def words(pool) -> str:
    with pytest.raises(SandboxFailed) as caught:
        self_check.check_marking(pool)
    return str(caught.value)


def test_a_machine_that_marks_passes_with_private_worlds_too():
    with Pool(2, unsafe=True, secret="a secret", time_limits=USUAL) as pool:
        self_check.check_marking(pool)


def test_a_sandbox_that_lacks_a_module_of_the_course_is_found_out(monkeypatch, tmp_path):
    monkeypatch.setattr(bubblewrap, "MODULES", tmp_path)
    with Pool(1, time_limits=USUAL) as pool:
        assert words(pool) == (
            f"This machine doesn't mark correctly: a right answer {GREETING} 0 of 8 points (The test cell "
            "`test`: not graded, and worth a look. The nodes could not be run: ModuleNotFoundError: "
            f"No module named 'launch_process_starters'). {REPAIR}"
        )


class Confused:
    """A pool that gives each answer the result of the other."""

    def __init__(self, pool: Pool) -> None:
        self.pool = pool

    def mark(self, tasks) -> list[Result]:
        first, second = self.pool.mark(tasks)
        return [replace(first, student=second.student), replace(second, student=first.student)]


def test_wrong_verdicts_are_found_out():
    with Pool(1, unsafe=True, time_limits=USUAL) as pool:
        assert words(Confused(pool)) == (
            f"This machine doesn't mark correctly: a wrong answer {GREETING} 8 of 8 points "
            f"(all checks passed). {REPAIR}"
        )
