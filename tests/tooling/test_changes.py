"""What is new since the last release: a file for each change, of which towncrier makes a section."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from grader.marking.release.make_release import changes
from tests.tooling.test_ci import ROOT

FRAGMENTS = [path for path in sorted((ROOT / ".ci/changes").iterdir()) if path.name != ".gitignore"]


@pytest.mark.parametrize("path", FRAGMENTS, ids=lambda path: path.name)
def test_a_change_is_named_after_whom_it_concerns(path):
    assert re.fullmatch(r"\+[a-z-]+\.(students|instructors|developers)\.md", path.name)


def test_a_release_makes_a_section_of_all_changes(tmp_path):
    shutil.copytree(ROOT / ".ci", tmp_path / ".ci")
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    (tmp_path / ".ci/changes/+robot.students.md").write_text("The robot has a horn.\n")
    before = changes(ROOT, "0.1.0")
    towncrier = Path(sys.executable).with_name("towncrier")
    command = [towncrier, "build", "--keep", "--version", "9.0.0"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    section = changes(tmp_path, "9.0.0")
    students = section.split("### ")[1]
    assert students.startswith("For students\n") and "- The robot has a horn.\n" in students
    assert [path.name for path in FRAGMENTS if path.read_text().strip() not in section] == []
    assert changes(tmp_path, "0.1.0") == before
