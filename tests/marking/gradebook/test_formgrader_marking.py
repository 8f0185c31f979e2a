"""The formgrader's Autograde button."""
import subprocess
import sys
from types import SimpleNamespace

import pytest
from nbgrader.apps.api import NbGraderAPI

from grader.marking.gradebook import formgrader_marking

API = SimpleNamespace(coursedir=SimpleNamespace(root="/course"))
MARK = [sys.executable, "-m", "grader", "mark", "01_nodes", "--student", "anna"]


@pytest.mark.parametrize(
    ("status", "force", "answer"),
    [
        (0, True, {"success": True, "log": "1 marked"}),
        (1, False, {"success": False, "error": "1 marked", "log": "1 marked"}),
    ],
)
def test_it_marks_in_a_process_of_its_own_with_the_sandbox(monkeypatch, status, force, answer):
    calls = []

    def run(command, cwd, **options):
        calls.append((command, cwd))
        return subprocess.CompletedProcess(command, status, "1 marked")

    monkeypatch.setattr(formgrader_marking.subprocess, "run", run)
    monkeypatch.setattr(NbGraderAPI, "autograde", None)
    formgrader_marking.install()
    assert NbGraderAPI.autograde(API, "01_nodes", "anna", force=force) == answer
    assert calls == [(MARK + ["--force"] * force, "/course")]
