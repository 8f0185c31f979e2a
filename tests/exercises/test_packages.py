"""Score tables of 11_packages: a page for each exercise in tests/exercises/packages/."""

import pytest

from grader.checks.packages import package_of
from grader.companions.patrol_package import FILES as BROKEN
from grader.exercises import packages
from grader.marking.judge.patrol_faults import FAULTS, FILES, GIVEN
from grader.programs import _refuse_to_build
from grader.workspace import building
from grader.workspace.building import Built, CannotBuildHere
from grader.workspace.package import PackageRun
from tests.exercises.assignment import Assignment
from tests.exercises.score_tables import executed
from tests.students.packages.greeter import RIGHT
from tests.students.workspaces import Workspace, changed


class TestPackages(Assignment):
    folder = "11_packages"
    package = packages

    @pytest.mark.soak
    def test_the_lesson_shows_what_it_speaks_of(self):
        cells = executed("course", f"{self.folder}/lesson") | executed("course", f"{self.folder}/launching")
        assert {name: cell.problems for name, cell in cells.items() if cell.problems} == {}
        assert "0.51 m before the wall, 0 touches\nmy_interfaces.msg.Obstacle(" in cells["own-run"].text
        assert "1 passed" in cells["launch-test-run"].text
        assert cells["launch-ends"].text == "left: 0.51 m before the wall\nright: 1.51 m before the wall\n"
        assert cells["launch-one-run"].text.endswith("1.01 m before the wall, 0 touches\n")
        assert cells["respawn-run"].text.count("process has died") == 4


def test_the_broken_package_has_six_faults_and_no_right_text():
    there = [number for number, (path, right, _) in enumerate(FAULTS) if right not in BROKEN[path]]
    assert tuple(there) == GIVEN
    right = {path: text for path, text in FILES.items() if text != BROKEN[path]}
    assert sorted(right) == sorted({FAULTS[number][0] for number in GIVEN})


def test_what_is_fixed_is_written_anew_each_time(tmp_path):
    for _ in range(2):
        workspace = packages.repaired(tmp_path, lambda fix: fix("setup.py", ":mian", ":main"))
    assert workspace == tmp_path
    text = (tmp_path / "src/patrol/setup.py").read_text()
    assert text == BROKEN["patrol/setup.py"].replace(":mian", ":main")


@pytest.mark.parametrize(("old", "times"), [("nowhere", 0), ("package_name", 5)])
def test_a_text_that_a_file_does_not_have_once_can_not_be_fixed(tmp_path, old, times):
    with pytest.raises(
        ValueError, match=rf"^setup.py has {times} times '{old}': give a text that it has once"
    ):
        packages.repaired(tmp_path, lambda fix: fix("setup.py", old, ""))


def test_what_is_moved_is_written_anew_each_time(tmp_path):
    def rearrange(move, fix):
        move("scripts/odometer.py", "odometer/deep/node.py")
        fix("odometer/deep/node.py", "import sys\n", "")

    for _ in range(2):
        assert packages.rearranged(tmp_path, rearrange) == tmp_path
    folder = tmp_path / "src/odometer"
    assert not (folder / "scripts/odometer.py").exists()
    assert "import sys\n" not in (folder / "odometer/deep/node.py").read_text()
    packages.rearranged(tmp_path, lambda move, fix: None)
    assert sorted(path.name for path in folder.rglob("*.py")) == [
        "__init__.py", "encoder.py", "odometer.py", "setup.py"
    ]  # fmt: skip


def test_a_file_that_is_not_there_or_is_in_the_way_is_not_moved(tmp_path):
    with pytest.raises(
        FileNotFoundError, match=r"^There is no file scripts in odometer: its files are helpers/encoder.py, "
    ):
        packages.rearranged(tmp_path, lambda move, fix: move("scripts", "odometer/x.py"))
    with pytest.raises(
        FileExistsError, match=r"^There is already setup.cfg in odometer: move setup.py to another path.$"
    ):
        packages.rearranged(tmp_path, lambda move, fix: move("setup.py", "setup.cfg"))


def test_nothing_is_handed_over_before_anything_is_fixed(tmp_path):
    def repair(fix):
        raise NotImplementedError

    score = packages.patrol.grade(packages.repaired(tmp_path, repair))
    assert score == 0
    assert [verdict.saw for verdict in score.verdicts if verdict.status == "failed"] == [
        "This exercise is not started yet: that line is still in the cell above, about patrol"
    ]


def test_warnings_of_a_build_are_printed_beside_the_notebook(monkeypatch, capsys):
    output = "x.py:1: UserWarning: Unknown distribution option: 'title'\n"
    monkeypatch.setattr(building, "build", lambda _: Built(output=output))
    packages.see(packages.greeter, Workspace(__name__, RIGHT))
    assert capsys.readouterr().out.startswith("The build warns: Unknown distribution option: 'title'\n")


def test_the_look_at_a_package_has_the_hints_of_the_check(capsys):
    files = changed(RIGHT, "greeter/setup.py", "greeter.hello:main", "greeter.hello")
    packages.see(packages.greeter, Workspace(__name__, files))
    assert "Is it an entry point without a function in setup.py?" in capsys.readouterr().out


def test_what_can_not_be_built_is_reported_beside_the_notebook(tmp_path, capsys):
    assert packages.see(packages.greeter, tmp_path).seconds == 0
    assert capsys.readouterr().out == (
        "There is no ws/src/greeter\nHint: A package is in a folder of its own name in ws/src.\n"
    )


def test_where_nothing_can_be_built_the_notebook_says_who_does(monkeypatch, capsys):
    def refuse(_):
        raise CannotBuildHere

    monkeypatch.setattr(building, "build", refuse)
    assert packages.see(packages.greeter, Workspace(__name__, RIGHT)).seconds == 0
    words = "Nothing can be built here: when a class is marked, the test cell below does it.\n"
    assert capsys.readouterr().out == words


def test_a_look_at_a_package_needs_one():
    with pytest.raises(ValueError, match=r"^this exercise has no package: give it one$"):
        package_of(PackageRun())
    message = r"^RemotePrograms needs its `build` for an exercise with a package$"
    with pytest.raises(ValueError, match=message):
        _refuse_to_build({})
