"""nbgrader's exchange with two system users, from the released assignment to the fetched feedback."""
import os
import pwd
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import nbformat
import pytest

from grader.marking.command.mark_class import Settings, mark_class
from tests.marking.classroom import ASSIGNMENT
from tests.marking.fake_pool import ReadyPool
from tests.marking.tiny import ROOT

USERS = ("daemon", "games")  # every system has these, and none of them has a process
# Where Python is in root's home, others need this to read it; what they may write is as usual.
READ = ("--inh-caps=+dac_read_search", "--ambient-caps=+dac_read_search")

pytestmark = pytest.mark.skipif(
    os.geteuid() != 0 or not shutil.which("setpriv"), reason="only root can act as other users"
)


def nbgrader(folder: Path, *words: str, user: str = "") -> str:
    """Run a command of nbgrader in a folder, as this user or as root."""
    places = {"HOME": str(folder), "JUPYTER_DATA_DIR": str(folder / "data")}
    environment = {**os.environ, "PYTHONPATH": str(ROOT), **places}
    command = [sys.executable, "-m", "nbgrader", *words]
    if user:
        group = str(pwd.getpwnam(user).pw_gid)
        command = ["setpriv", f"--reuid={user}", f"--regid={group}", "--clear-groups", *READ, *command]
        environment |= {"USER": user, "LOGNAME": user}
    done = subprocess.run(command, cwd=folder, env=environment, text=True, capture_output=True)
    assert done.returncode == 0, done.stderr
    return done.stderr


def submit(home: Path, user: str, exchange: tuple[str, ...], answer: str) -> None:
    path = home / ASSIGNMENT / "nodes.ipynb"
    notebook = nbformat.read(path, 4)
    next(cell for cell in notebook.cells if cell.id == "line").source = answer
    nbformat.write(notebook, path)
    nbgrader(home, "submit", ASSIGNMENT, *exchange, user=user)


@pytest.fixture
def shared():
    """A folder that other users can reach, which those of pytest are not."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder).chmod(0o711)
        yield Path(folder)


@pytest.mark.soak
def test_each_user_fetches_the_feedback_of_each_attempt(course, shared):
    shutil.rmtree(course.root / "class" / "submitted")
    place = shared / "exchange"
    place.mkdir()
    place.chmod(0o777)
    exchange = (f"--Exchange.root={place}", "--CourseDirectory.course_id=ros2")
    nbgrader(course.root, "release_assignment", ASSIGNMENT, *exchange)
    homes = {user: shared / user for user in USERS}
    for user, home in homes.items():
        home.mkdir(mode=0o700)
        os.chown(home, pwd.getpwnam(user).pw_uid, -1)
        nbgrader(home, "fetch_assignment", ASSIGNMENT, *exchange, user=user)
        submit(home, user, exchange, f"Line = '{user}'")
    found: dict[str, list[str]] = {}
    for answer in ("first", "second"):
        nbgrader(course.root, "collect", ASSIGNMENT, "--update", *exchange)
        mark_class(course, ASSIGNMENT, Settings(), ReadyPool(course).open)
        nbgrader(course.root, "release_feedback", ASSIGNMENT, *exchange)
        for user, home in homes.items():
            nbgrader(home, "fetch_feedback", ASSIGNMENT, *exchange, user=user)
            pages = sorted((home / ASSIGNMENT / "feedback").glob("*/nodes.html"))
            found[user] = [page.read_text() for page in pages]
            assert all(user in page and set(USERS) - {user} for page in found[user])
        if answer == "first":
            submit(homes["daemon"], "daemon", exchange, "Line = 'once more'")
    assert {user: len(pages) for user, pages in found.items()} == {"daemon": 2, "games": 1}
    assert ["once more" in page for page in found["daemon"]] == [False, True]
    assert not any("games" in page for page in found["daemon"])
