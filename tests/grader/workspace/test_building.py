"""Builds by colcon, their results and the explanations of their errors."""

import os
import subprocess
from pathlib import Path

import pytest

from grader.workspace import building, installation, package
from grader.workspace.build_errors import explain_build_error
from grader.workspace.building import CUT, Built, CannotBuildHere, build, parse_built
from grader.workspace.package import make_package
from grader.workspace.sources import InvalidFiles
from tests.exercises.packages.greeter import students as greeter

RIGHT = {path: text.encode() for path, text in greeter.RIGHT.items()}


def test_what_is_built_is_what_was_installed_and_nothing_is_left(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    built = build(RIGHT)
    assert (built.problem, built.programs) == ("", {"lib/greeter/hello"})
    assert "share/ament_index/resource_index/packages/greeter" in built.files
    assert built.files["share/greeter/package.xml"] == RIGHT["greeter/package.xml"]
    assert list(tmp_path.iterdir()) == []


def test_a_build_without_end_is_ended_with_all_that_it_started(monkeypatch):
    started = []

    class Watched(subprocess.Popen):
        def __init__(self, *words, **more):
            super().__init__(*words, **more)
            started.append(self)

    monkeypatch.setattr(subprocess, "Popen", Watched)
    monkeypatch.setattr(building, "SECONDS", 0.2)
    built = build({**RIGHT, "greeter/setup.py": b"while True: pass"})
    assert built.problem == "colcon build did not end within 300 s."
    assert started[0].returncode == -9


def test_a_process_that_can_start_nothing_says_so(monkeypatch):
    def denied(*_, **__):
        raise PermissionError

    monkeypatch.setattr(subprocess, "Popen", denied)
    with pytest.raises(CannotBuildHere):
        build(RIGHT)


@pytest.mark.parametrize(
    ("output", "hint"),
    [
        ("", "Look at the lines above, or run colcon build in ws, and read its first error."),
        ("KeyError: 'a'\n", "The first error is: KeyError: 'a'"),
        ("error: no such thing\n", "setup.py says: no such thing"),
        (
            "error: package directory 'gree' does not exist",
            "setup.py names the package 'gree', but no folder next to it has that name.",
        ),
    ],
)
def test_a_reason_is_put_in_a_beginners_words(output, hint):
    assert explain_build_error(Built(output=output, problem="colcon build failed.")) == ("colcon build failed.", hint)


def test_where_what_was_installed_is_refused_that_says_it_all():
    problem = "The installed files can't be used. It is too much. Leave it out."
    built = Built(output="error: no matter\nFinished <<< greeter [1s]\n", problem=problem)
    assert explain_build_error(built) == (built.problem, "")


def test_without_a_known_reason_the_last_lines_are_reported():
    built = Built(output="one\n\n two\n", problem="colcon build failed.")
    assert explain_build_error(built)[0] == "colcon build failed. Its last output: one / two"


def test_what_another_process_built_is_looked_at():
    built = parse_built({"a": b"1"}, ["a", "b"], "x" * 60_000, 7)
    assert (built.files, built.programs, len(built.output), built.problem) == ({"a": b"1"}, {"a"}, 50_000, "")
    begin, _, end = parse_built({}, [], f"first {'x' * 60_000} last", "").output.partition(CUT)
    assert (begin[:6], end[-5:]) == ("first ", " last")
    assert parse_built({}, "a", None, "\ud800").problem == "?"
    with pytest.raises(InvalidFiles, match=r"^`install/\.\./a`: a name may have"):
        parse_built({"../a": b""}, [], "", "")


@pytest.mark.parametrize(
    ("received", "saw", "hint"),
    [
        ("Give the folder.", "Give the folder.", ""),
        ([1], "ws/src/greeter could not be read.", ""),
        ({"a": "text"}, "ws/src/greeter could not be read.", ""),
        ({}, "There is no ws/src/greeter", "A package is in a folder of its own name in ws/src."),
    ],
)
def test_what_can_not_be_a_package_is_a_fault(received, saw, hint):
    found = make_package("greeter", received, build)
    assert (found.saw, found.hint, found.before_start) == (saw, hint, True)


def test_a_workspace_is_given_as_a_folder(tmp_path):
    assert installation.serialize_sources([7], "greeter") == "Give the folder of the workspace, in quotes."
    assert installation.serialize_sources([], "greeter") == "Give the folder of the workspace, in quotes."
    assert installation.serialize_sources([str(tmp_path)], "greeter") == {}
    assert installation.serialize_sources([None], "greeter") is None


def test_what_was_installed_is_forgotten_again(monkeypatch):
    monkeypatch.setenv("AMENT_PREFIX_PATH", "/somewhere")
    installation.install({"lib/greeter/hello": b"#!python", "share/x": b""}, ["lib/greeter/hello"])
    first, _, _ = os.environ["AMENT_PREFIX_PATH"].partition(os.pathsep)
    assert os.access(Path(first, "lib/greeter/hello"), os.X_OK)
    installation.install({}, [])
    assert not Path(first).exists()
    installation.uninstall()
    assert os.environ["AMENT_PREFIX_PATH"] == "/somewhere"


def test_a_run_of_a_package_is_a_recording_with_the_package():
    from sim.evidence import Recording

    run = package.PackageRun.of(Recording(seed=3), package=None)
    assert (run.seed, run.package) == (3, None)
