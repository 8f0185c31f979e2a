"""Taking submissions out of inboxes, in which students may write whatever they like."""
import os
import socket
import time
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

from grader.marking.extras.hub import inbox_import
from grader.marking.extras.hub.inbox_import import FORM, import_submissions

KEY = "XOy9UE-HofNS"


class Inboxes:
    """A folder with inboxes of a course, and the folder into which submissions are taken."""

    def __init__(self, root: Path) -> None:
        self.root, self.inbound = root / "students", root / "inbound"
        self.inbound.mkdir()
        for student in ("alice", "bob"):
            self.of(student).mkdir(parents=True)

    def of(self, student: str) -> Path:
        return self.root / student / "ros2" / "inbound"

    def submit(self, student: str, author: str = "", key: str = KEY, age: float = 0.0, **files: str) -> Path:
        """Hand in as nbgrader does; age: seconds that the name claims to be older."""
        when = (datetime.now(UTC) - timedelta(seconds=age)).strftime(FORM)
        folder = self.of(student) / f"{author or student}+01_nodes+{when}+{key}"
        folder.mkdir()
        texts = {"nodes.ipynb": "{}", "timestamp.txt": when, "submission_secret.txt": "s3cret"}
        for name, text in (texts | files).items():
            (folder / name).write_text(text)
        return folder

    def take(self) -> list[str]:
        return import_submissions(self.root, "ros2", self.inbound, owner=lambda name: os.getuid())

    def taken(self) -> dict[str, set[str]]:
        return {
            path.name: {file.relative_to(path).as_posix() for file in path.rglob("*") if file.is_file()}
            for path in self.inbound.iterdir()
        }


@pytest.fixture
def inboxes(tmp_path: Path) -> Inboxes:
    return Inboxes(tmp_path)


def test_a_submission_is_copied_once_and_nothing_that_happens_to_it_later_counts(inboxes):
    folder = inboxes.submit("alice")
    (folder / "ws" / "src").mkdir(parents=True)
    (folder / "ws" / "src" / "setup.py").write_text("")
    assert inboxes.take() == []
    files = {"nodes.ipynb", "timestamp.txt", "submission_secret.txt", "ws/src/setup.py"}
    assert inboxes.taken() == {folder.name: files}
    (folder / "nodes.ipynb").write_text("[]")
    assert inboxes.take() == []
    assert (inboxes.inbound / folder.name / "nodes.ipynb").read_text() == "{}"


def test_each_attempt_is_taken(inboxes):
    names = {inboxes.submit("alice", key=f"number-{n}", age=n).name for n in range(3)} | {inboxes.submit("bob").name}
    assert inboxes.take() == []
    assert set(inboxes.taken()) == names


def test_no_one_hands_in_for_another(inboxes):
    folder = inboxes.submit("bob", author="alice")
    assert inboxes.take() == [
        f"bob: `{folder.name}` is left out. It is in the inbox of bob; hand in under your own name."
    ]
    assert inboxes.taken() == {}


def test_a_submission_that_was_changed_later_has_the_later_time(inboxes):
    folder = inboxes.submit("alice", age=3600)
    claimed = folder.name.split("+")[2]
    (notice,) = inboxes.take()
    changed = notice.removeprefix(f"alice: 01_nodes of {claimed} was changed at ").removesuffix(", and that time counts.")
    assert (inboxes.inbound / f"alice+01_nodes+{changed}+{KEY}" / "timestamp.txt").read_text() == changed
    assert changed > claimed
    assert inboxes.take() == []


def test_a_time_cannot_be_forged_with_touch(inboxes):
    folder = inboxes.submit("alice", age=3600)
    for path in [folder, *folder.iterdir()]:
        os.utime(path, (time.time() - 3600,) * 2)
    assert len(inboxes.take()) == 1


def test_files_of_another_user_are_left_out(inboxes):
    folder = inboxes.submit("alice")
    assert import_submissions(inboxes.root, "ros2", inboxes.inbound, owner=lambda name: os.getuid() + 1) == [
        f"alice: `{folder.name}` is left out. `nodes.ipynb` belongs to another user; hand in files of your own."
    ]
    assert inboxes.taken() == {}


def odd(folder: Path, kind: str) -> None:
    """Put something that is no file into a submission."""
    place = folder / "odd"
    if kind == "a link":
        place.symlink_to("/etc/passwd")
    elif kind == "a pipe":
        os.mkfifo(place)
    else:
        here = os.getcwd()
        os.chdir(folder)
        socket.socket(socket.AF_UNIX).bind("odd")
        os.chdir(here)


@pytest.mark.parametrize("kind", ["a link", "a pipe", "a socket"])
def test_what_is_no_file_is_neither_read_nor_followed(inboxes, kind):
    folder = inboxes.submit("alice")
    odd(folder, kind)
    assert inboxes.take() == [
        f"alice: `{folder.name}` is left out. `odd` is {kind}; hand in files and folders only."
    ]
    assert inboxes.taken() == {}


def test_a_link_in_place_of_a_submission_is_not_followed(inboxes, tmp_path):
    real = inboxes.submit("bob")
    (inboxes.of("alice") / real.name.replace("bob", "alice")).symlink_to(real)
    (notice,) = inboxes.take()
    assert notice.endswith(
        "is left out. Expected a folder with a notebook, saw a link or a file. Hand in the notebook itself."
    )
    assert set(inboxes.taken()) == {real.name}


def test_a_link_in_place_of_an_inbox_leads_to_no_one_elses_submission(inboxes):
    real = inboxes.submit("bob")
    inboxes.of("alice").rmdir()
    inboxes.of("alice").symlink_to(inboxes.of("bob"))
    assert inboxes.take() == [
        f"alice: `{real.name}` is left out. It is in the inbox of alice; hand in under your own name."
    ]


@pytest.mark.parametrize("name", ["alice", "alice+01_nodes", "alice+a+b+c"])
def test_a_name_that_nbgrader_does_not_make_is_left_out(inboxes, name):
    (inboxes.of("alice") / name.replace("/", "_")).mkdir()
    (notice,) = inboxes.take()
    assert "is left out. Expected a name as `nbgrader submit` makes it." in notice


def test_a_time_that_is_none_is_left_out(inboxes):
    (inboxes.of("alice") / f"alice+01_nodes+soon+{KEY}").mkdir()
    (notice,) = inboxes.take()
    assert notice.startswith(f"alice: `alice+01_nodes+soon+{KEY}` is left out. ")


def test_too_much_is_left_out(inboxes, monkeypatch):
    monkeypatch.setattr(inbox_import, "MAX_BYTES", 100)
    folder = inboxes.submit("alice", **{"big.txt": "x" * 200})
    assert inboxes.take() == [
        f"alice: `{folder.name}` is left out. It has 4 files and 0 MB; at most 1000 files and 0 MB can be handed in."
    ]


def test_of_an_inbox_with_very_many_submissions_the_newest_are_taken(inboxes, monkeypatch):
    monkeypatch.setattr(inbox_import, "MAX_WAITING", 2)
    names = [inboxes.submit("alice", key=f"number-{n}", age=60 - n).name for n in range(4)]
    assert inboxes.take() == []
    assert set(inboxes.taken()) == set(names[2:])


def test_a_student_without_a_unix_user_is_named(inboxes):
    (inboxes.root / "alice").rename(inboxes.root / "a-former-student")
    notices = import_submissions(inboxes.root, "ros2", inboxes.inbound)
    assert notices[0] == "a-former-student: there is no Unix user of this name"


@pytest.mark.parametrize("text", ["", None])
def test_a_submission_that_is_still_being_copied_waits_until_it_is_whole(inboxes, text):
    folder = inboxes.submit("alice", **{"submission_secret.txt": text or ""})
    if text is None:
        (folder / "submission_secret.txt").unlink()
    assert inboxes.take() == [
        f"alice: `{folder.name}` is left out. It is incomplete: submission_secret.txt, which nbgrader writes "
        "last, is missing or empty. Either it is still being copied, or the disk was full when the student "
        "submitted."
    ]
    assert inboxes.taken() == {}
    (folder / "submission_secret.txt").write_text("s3cret")
    assert inboxes.take() == []
    assert len(inboxes.taken()) == 1
