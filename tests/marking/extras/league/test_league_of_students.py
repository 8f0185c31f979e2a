"""Of a class's extras, students get the league."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from grader.marking.release.handout import contents, write_folder
from tests.marking.tiny import ROOT


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    place = tmp_path_factory.mktemp("handout")
    write_folder(contents(ROOT), place)
    return place


def test_of_the_extras_and_commands_students_have_the_league(folder):
    extras = {path.name for path in (folder / "grader/marking/extras").iterdir()}
    assert extras == {"__init__.py", "league"}

    def output(*words: str) -> subprocess.CompletedProcess:
        command = [sys.executable, "-m", "grader", *words]
        environment = {**os.environ, "PYTHONPATH": f"{folder}:{folder / 'ros_packages/python'}"}
        return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)

    usage = "usage: python -m grader COMMAND ...\nCommands, each with --help: league\n"
    assert (output("mark", "01_nodes").returncode, output("mark", "01_nodes").stderr) == (2, usage)
    expected = "there is no notebook robot.ipynb"
    assert output("league", "robot.ipynb", "--assignment", "01_nodes").stderr == f"Not played: {expected}.\n"
    expected = "only instructors have a class's submissions: name your notebooks"
    assert output("league").stderr == f"Not played: {expected}.\n"
