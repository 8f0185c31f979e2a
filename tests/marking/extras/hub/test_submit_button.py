"""What a student reads who submits too early, from nbgrader's own list of assignments."""
import os
import subprocess

import pytest
from nbgrader.server_extensions.assignment_list.handlers import AssignmentList
from traitlets.config import Config

from grader.marking.extras.hub.submit_button import _load_jupyter_server_extension, _submit


@pytest.fixture
def assignments(tmp_path, monkeypatch):
    """The list of a student whose exchange has no release."""
    for folder in ("exchange/ros2/outbound", "exchange/ros2/inbound", "home/01_nodes"):
        (tmp_path / folder).mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "home")
    config = Config()
    config.Exchange.root = str(tmp_path / "exchange")
    monkeypatch.setattr(AssignmentList, "submit_assignment", _submit)
    monkeypatch.setattr(AssignmentList, "load_config", lambda self: config)
    _load_jupyter_server_extension(None)
    found = AssignmentList(config=config)
    found.root_dir = str(tmp_path / "home")
    return found


def test_a_submission_before_the_release_is_one_sentence(assignments):
    answer = assignments.submit_assignment("ros2", "01_nodes")
    assert answer == {
        "success": False,
        "value": "01_nodes is not released yet: submit it when your teacher has released it. Your work is kept.",
    }


def test_of_another_error_the_last_line_is_left(assignments, tmp_path):
    (tmp_path / "exchange/ros2/outbound/02_topics").mkdir()
    answer = assignments.submit_assignment("ros2", "02_topics")
    assert answer == {"success": False, "value": f"Assignment not found at: {tmp_path}/home/02_topics"}


@pytest.fixture
def small_disk(tmp_path):
    """A folder on a disk of its own, of 64 kB."""
    folder = tmp_path / "exchange/ros2/inbound"
    if os.geteuid() or subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", folder]).returncode:
        pytest.skip("no disk can be mounted here")
    yield folder
    subprocess.run(["umount", folder], check=True)


def test_a_full_disk_is_named_and_what_was_submitted_before_still_counts(assignments, tmp_path, small_disk):
    for folder in (tmp_path / "exchange/ros2/outbound/01_nodes", tmp_path / "home/01_nodes"):
        folder.mkdir(exist_ok=True)
        (folder / "nodes.ipynb").write_text("{}")
    assert assignments.submit_assignment("ros2", "01_nodes") == {"success": True}
    (tmp_path / "home/01_nodes/nodes.ipynb").write_text("x" * 100_000)
    assert assignments.submit_assignment("ros2", "01_nodes") == {
        "success": False,
        "value": "01_nodes was not submitted: the disk is full. Tell your teacher; if it is your own quota, "
        "delete what you don't need. Then submit again. What you submitted before still counts.",
    }
    whole = [path for path in small_disk.glob("*/submission_secret.txt") if path.stat().st_size]
    assert len(whole) == 1
