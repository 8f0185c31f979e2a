"""The installed wheel runs the lessons without JupyterLab, nbgrader and colcon, as on a notebook service."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from sim.ros2.absent_colcon import SENTENCE
from tests.tooling.test_ci import ROOT, load

pytestmark = pytest.mark.soak
wheels = load("wheels")
UV = Path(sys.executable).with_name("uv")
IPYKERNEL = "ipykernel==6.17.1"  # the oldest that is supported: Colab's
ABSENT = ("jupyterlab", "nbgrader", "colcon_core", "cmake")
NOTEBOOKS = sorted(path.relative_to(ROOT) for path in ROOT.glob("course/[01]*/*.ipynb"))
NOTEBOOKS += [Path("exercises/01_nodes/nodes.ipynb")]
NEED_COLCON = {Path("course/11_packages", name) for name in ("lesson.ipynb", "launching.ipynb")}
KEPT = re.compile("HOME|TMPDIR|(UV|PIP|SSL)_.*")  # what an install needs: its index and certificates
NOT_THERE = ("No module named", "command not found", "No such file")


class Core:
    """The wheel in an environment of this machine's newest Python, and a student's copies of the course."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.bin = folder, folder / "venv" / "bin"
        wheels.build(folder / "wheels")
        newest = max(wheels.pythons().items(), key=lambda found: int(found[0][2:]))[1]
        self.call([UV, "venv", "--quiet", "--python", newest, folder / "venv"])
        package = [folder / "wheels", "ros2-notebook-course", IPYKERNEL]
        self.call(
            [UV, "pip", "install", "--quiet", "--python", self.bin / "python", "--find-links", *package]
        )
        self.call([self.bin / "ros2-course", "copy", folder / "copies"])

    def call(self, command: list) -> str:
        """Run a command outside the repository, as on a machine of its own; what it printed."""
        kept = {name: value for name, value in os.environ.items() if KEPT.fullmatch(name)}
        environment = {**kept, "PATH": "/usr/bin:/bin", "LANG": "C.UTF-8"}
        done = subprocess.run(command, cwd=self.folder, env=environment, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout

    def run(self, notebook: Path) -> dict:
        """Run a student's copy; its errors and its text."""
        program = Path(__file__).with_name("run_notebook.py")
        return json.loads(self.call([self.bin / "python", program, self.folder / "copies" / notebook]))


@pytest.fixture(scope="module")
def core(tmp_path_factory) -> Core:
    return Core(tmp_path_factory.mktemp("core"))


def test_the_core_lacks_what_it_is_said_to_lack(core):
    program = f"import importlib.util; print(*(importlib.util.find_spec(name) for name in {ABSENT}))"
    assert core.call([core.bin / "python", "-c", program]).split() == ["None"] * len(ABSENT)


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=str)
def test_every_lesson_and_an_assignment_run_from_top_to_bottom(core, notebook):
    shown = core.run(notebook)
    if notebook in NEED_COLCON:
        assert SENTENCE in shown["text"]
    else:
        assert shown["errors"] == []
        assert [words for words in NOT_THERE if words in shown["text"]] == []


def test_the_commands_of_the_course_are_there(core):
    assert "--world" in core.call([core.bin / "python", "-m", "sim", "--help"])
    assert "league" in core.call([core.bin / "python", "-m", "grader", "--help"])
    assert "std_msgs/msg/String" in core.call([core.bin / "ros2", "interface", "list"])
