"""Score tables of 11_packages: a page for each exercise in tests/exercises/packages/."""

import pytest

from grader.checks.packages import package_of
from grader.exercises import packages
from grader.programs import _refuse_to_build
from grader.workspace import building
from grader.workspace.building import Built, CannotBuildHere
from grader.workspace.package import PackageRun
from tests.exercises.assignment import Assignment
from tests.exercises.packages.greeter.students import RIGHT
from tests.exercises.score_tables import executed
from tests.students.workspaces import Workspace, changed


class TestPackages(Assignment):
    folder = "11_packages"
    package = packages

    @pytest.mark.soak
    def test_the_lesson_shows_what_it_speaks_of(self):
        cells = executed("course", f"{self.folder}/lesson") | executed("course", f"{self.folder}/launching")
        assert {name: cell.problems for name, cell in cells.items() if cell.problems} == {}
        assert "0.51 m from the wall, 0 contacts\nmy_interfaces.msg.Obstacle(" in cells["own-run"].text
        assert "1 passed" in cells["launch-test-run"].text
        assert cells["launch-ends"].text == "left: 0.51 m from the wall\nright: 1.51 m from the wall\n"
        assert cells["respawn-run"].text.count("process has died") == 4


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
