"""The record of soak tests: which files enter it, and which ones `make lint` names."""
import datetime
import subprocess
import sys
from pathlib import Path

import pytest

from tests import soak_record

TODAY = datetime.date(2026, 11, 28)
TESTS = """
import pytest

@pytest.mark.{mark}
def test_rare(): pass

@pytest.mark.{mark}
def test_rarer(): assert {outcome}

def test_common(): assert False
"""


@pytest.fixture
def course(tmp_path: Path) -> Path:
    """A folder with two files of soak tests, of which one has a test that fails, and a file without any."""
    (tmp_path / "tests").mkdir()
    for name, outcome in (("good", True), ("bad", False)):
        (tmp_path / "tests" / f"test_{name}.py").write_text(TESTS.format(mark="soak", outcome=outcome))
    (tmp_path / "tests" / "test_quick.py").write_text("def test_common(): pass\n")
    (tmp_path / "tests" / "helper.py").write_text(TESTS.format(mark="soak", outcome=True))
    (tmp_path / "pytest.ini").write_text("[pytest]\nmarkers = soak\n")
    subprocess.run(["git", "init", "--quiet"], cwd=tmp_path, check=True)
    return tmp_path


@pytest.mark.parametrize("workers", ["0", "2"])
def test_a_run_adds_the_files_whose_soak_tests_all_passed(course, workers):
    soak_record.add_to_record(course, {"tests/test_gone.py": (TODAY, 1.0), "tests/test_bad.py": (TODAY, 2.0)})
    options = ["-p", "tests.soak_record", "-n", workers, "--rootdir", course, course / "tests"]
    subprocess.run([sys.executable, "-m", "pytest", *options], cwd=soak_record.ROOT, capture_output=True)
    record = soak_record.read_record(course)
    assert record.keys() == {"tests/test_good.py", "tests/test_bad.py"}
    assert record["tests/test_good.py"][0] == datetime.date.today()
    assert record["tests/test_bad.py"] == (TODAY, 2.0)


def test_files_that_have_not_passed_in_a_fortnight_are_named(course):
    days = {"tests/test_good.py": TODAY - datetime.timedelta(days=15)}
    soak_record.add_to_record(course, {path: (day, 0.1) for path, day in days.items()})
    assert soak_record.overdue(course, TODAY) == [
        "tests/test_bad.py: tests/soak.txt has no run of its soak tests",
        "tests/test_good.py: its soak tests passed last on 2026-11-13",
    ]
    assert soak_record.overdue(course, TODAY - datetime.timedelta(days=1))[1:] == []


def test_the_soak_tests_that_an_assignment_inherits_count(course):
    (course / "tests/exercises").mkdir()
    (course / "tests/exercises/test_topics.py").write_text(f"class TestTopics({'Assignment'}):\n    pass\n")
    assert "tests/exercises/test_topics.py: tests/soak.txt has no run of its soak tests" in (
        soak_record.overdue(course, TODAY)
    )
