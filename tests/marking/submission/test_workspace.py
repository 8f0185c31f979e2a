"""A workspace beside the notebook: taken with it, or left out with the reason."""

import dataclasses

import pytest

from grader.marking.submission.submitted_files import read_folder, submission_key
from grader.marking.submission.submitted_notebooks import read_notebooks
from tests.marking.submission.damage import NODES as RELEASE
from tests.marking.submission.damage import SOLVED, data, submit


@pytest.fixture
def folder(tmp_path):
    return submit(tmp_path, nodes=data(SOLVED))


def test_its_sources_are_taken_and_what_was_built_is_not(folder):
    for path in ("src/a/package.xml", "build/x", "install/y"):
        (folder / "ws" / path).parent.mkdir(parents=True)
        (folder / "ws" / path).write_text("text")
    taken = read_folder(folder, RELEASE)
    assert taken.workspace == {"ws/src/a/package.xml": b"text"}
    assert read_notebooks(taken, RELEASE).repairs == []


def test_another_file_is_another_submission(folder):
    before = read_folder(folder, RELEASE)
    (folder / "ws/src").mkdir(parents=True)
    keys = {submission_key(before, RELEASE, "", "")}
    for text in ("one", "other"):
        (folder / "ws/src/file").write_text(text)
        taken = dataclasses.replace(read_folder(folder, RELEASE), entries=before.entries)
        keys.add(submission_key(taken, RELEASE, "", ""))
    assert len(keys) == 3


@pytest.mark.parametrize(
    ("link", "reason"),
    [
        ("ws", "`ws` is a link. Hand in the folder itself."),
        ("ws/src", "ws/src is not a folder. Put your packages into a folder of this name."),
        ("ws/src/a", "`ws/src/a` is a link. Only files are used: put the file itself there."),
    ],
)
def test_a_link_is_not_followed_and_the_notebook_is_marked_all_the_same(folder, tmp_path, link, reason):
    (folder / link).parent.mkdir(parents=True, exist_ok=True)
    (folder / link).symlink_to(tmp_path)
    taken = read_folder(folder, RELEASE)
    assert taken.workspace == reason
    assert read_notebooks(taken, RELEASE).repairs == [f"No file of your workspace was used. {reason}"]
