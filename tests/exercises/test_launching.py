"""Score tables of 11b_launching: a page for each exercise in tests/exercises/launching/."""

import pytest

from grader.exercises import launching
from grader.exercises.launching.patrol.answers import FAULTS, FILES, GIVEN
from grader.exercises.launching.patrol.patrol_package import FILES as BROKEN
from tests.exercises.assignment import Assignment


class TestLaunching(Assignment):
    folder = "11b_launching"
    package = launching


def test_the_broken_package_has_six_faults_and_no_right_text():
    there = [number for number, (path, right, _) in enumerate(FAULTS) if right not in BROKEN[path]]
    assert tuple(there) == GIVEN
    right = {path: text for path, text in FILES.items() if text != BROKEN[path]}
    assert sorted(right) == sorted({FAULTS[number][0] for number in GIVEN})


def test_what_is_fixed_is_written_anew_each_time(tmp_path):
    for _ in range(2):
        workspace = launching.repaired(tmp_path, lambda fix: fix("setup.py", ":mian", ":main"))
    assert workspace == tmp_path
    text = (tmp_path / "src/patrol/setup.py").read_text()
    assert text == BROKEN["patrol/setup.py"].replace(":mian", ":main")


@pytest.mark.parametrize(("old", "times"), [("nowhere", 0), ("package_name", 5)])
def test_a_text_that_a_file_does_not_have_once_can_not_be_fixed(tmp_path, old, times):
    with pytest.raises(
        ValueError, match=rf"^setup.py has {times} times '{old}': give a text that it has once"
    ):
        launching.repaired(tmp_path, lambda fix: fix("setup.py", old, ""))


def test_nothing_is_handed_over_before_anything_is_fixed(tmp_path):
    def repair(fix):
        raise NotImplementedError

    score = launching.patrol.grade(launching.repaired(tmp_path, repair))
    assert score == 0
    assert [verdict.saw for verdict in score.verdicts if verdict.status == "failed"] == [
        "This exercise is not started yet: that line is still in the cell above, about patrol"
    ]
