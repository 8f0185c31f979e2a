"""Score tables of 11c_testing: a page for each exercise in tests/exercises/testing/."""

import pytest

from grader.exercises import testing
from tests.exercises.assignment import Assignment


class TestTesting(Assignment):
    folder = "11c_testing"
    package = testing


def test_what_is_moved_is_written_anew_each_time(tmp_path):
    def rearrange(move, fix):
        move("scripts/odometer.py", "odometer/deep/node.py")
        fix("odometer/deep/node.py", "import sys\n", "")

    for _ in range(2):
        assert testing.rearranged(tmp_path, rearrange) == tmp_path
    folder = tmp_path / "src/odometer"
    assert not (folder / "scripts/odometer.py").exists()
    assert "import sys\n" not in (folder / "odometer/deep/node.py").read_text()
    testing.rearranged(tmp_path, lambda move, fix: None)
    assert sorted(path.name for path in folder.rglob("*.py")) == [
        "__init__.py", "encoder.py", "odometer.py", "setup.py"
    ]  # fmt: skip


def test_a_file_that_is_not_there_or_is_in_the_way_is_not_moved(tmp_path):
    with pytest.raises(
        FileNotFoundError, match=r"^There is no file scripts in odometer: its files are helpers/encoder.py, "
    ):
        testing.rearranged(tmp_path, lambda move, fix: move("scripts", "odometer/x.py"))
    with pytest.raises(
        FileExistsError, match=r"^There is already setup.cfg in odometer: move setup.py to another path.$"
    ):
        testing.rearranged(tmp_path, lambda move, fix: move("setup.py", "setup.cfg"))
