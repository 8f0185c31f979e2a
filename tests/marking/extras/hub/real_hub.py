"""A real hub for tests: installed in a temporary folder, with Unix users of its own, and removed afterwards."""
import atexit
import csv
import functools
import os
import pwd
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from grader.marking.extras.hub import accounts, leftovers, machine, user_limits
from grader.marking.extras.hub.hub_settings import (
    FILE,
    HubCourse,
    HubSettings,
    ServerSettings,
    UserLimits,
    grader_of,
    read_settings,
)
from tests.marking.extras.hub.hub_client import HubClient
from tests.marking.tiny import ROOT
from tests.patience import PATIENCE, until
from tests.ports import free_port

COURSE = "hubtest"


class RealHub:
    """A hub that runs, its settings, and the passwords of its users.

    course: a second folder of the course, with settings of its own, in which the hub is started.
    """

    def __init__(self, settings: HubSettings, course: Path) -> None:
        self.settings, self.course = settings, course
        self.address = f"http://127.0.0.1:{settings.server.port}"
        self.log = settings.folder / "log.txt"
        self.process: subprocess.Popen | None = None

    @property
    def passwords(self) -> dict[str, str]:
        """Each user's password."""
        with (self.settings.folder / accounts.PASSWORDS).open() as file:
            return dict(csv.reader(file))

    def start(self) -> str:
        """Start the hub as `make hub` does, and wait until it runs; returns what was printed and logged."""
        self.log = self.log.with_stem(f"{self.log.stem}-again")  # servers of an earlier start still write
        with self.log.open("w") as stream:
            self.process = subprocess.Popen(
                [sys.executable, "-m", "grader", "hub"], cwd=self.course, stdout=stream, stderr=stream,
                start_new_session=True,
            )
        ended, installed = self.process.poll, self.settings.installation / ".venv" / ".hub"
        until(lambda: ended() is not None or installed.exists(), "the installation")
        until(lambda: ended() is not None or "JupyterHub is now running" in self.log.read_text(), "the hub")
        assert self.process.poll() is None, self.log.read_text()[-3000:]
        return self.log.read_text()

    def stop(self, number: int = signal.SIGTERM) -> str:
        """Send the hub a signal and wait until it ends; returns what it logged until then."""
        self.process.send_signal(number)
        self.process.wait(PATIENCE)
        return self.log.read_text()

    def client(self, user: str) -> HubClient:
        """The user, logged in, with a server that runs."""
        client = HubClient(self.address, user, self.passwords[user])
        client.start_server()
        return client

    def as_grader(self, *words: str) -> str:
        """Run a command as the user who marks, in the course's folder."""
        home, folder = self.settings.home(COURSE), self.settings.course_folder(COURSE)
        places = {"HOME": str(home), "PYTHONPATH": str(folder), "PYTHONHASHSEED": "0", "OPENBLAS_NUM_THREADS": "1"}
        places["PATH"] = f"{self.settings.installation / '.venv' / 'bin'}:/usr/bin:/bin"
        user = pwd.getpwnam(grader_of(COURSE))
        done = subprocess.run(
            words, cwd=folder, env=places, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            user=user.pw_uid, group=user.pw_gid, extra_groups=[], umask=0o077,
        )
        assert done.returncode == 0, done.stdout
        return done.stdout


@contextmanager
def real_hub(students: int, limits: UserLimits | None = None) -> Iterator[RealHub]:
    """Install a hub with this many students and two teachers, and run it until the end of the block."""
    folder = _folder()
    course = Path(tempfile.mkdtemp(prefix="ros2-hub-course-"))
    people = HubCourse(("hubtest-ines", "hubtest-tom"), tuple(f"hubtest-{number:02d}" for number in range(students)))
    settings = HubSettings(
        ServerSettings(folder=str(folder), port=free_port(4)), limits or UserLimits(), {COURSE: people}
    )
    for name in {*os.listdir(ROOT)} - {".git", "class", "work"}:
        (course / name).symlink_to(ROOT / name)
    (course / FILE).parent.mkdir()
    (course / FILE).write_text(_toml(settings))
    assert read_settings(course / FILE) == replace(settings, courses=dict(settings.courses))
    hub = RealHub(settings, course)
    try:
        hub.start()
        yield hub
    finally:
        _remove(hub)
        shutil.rmtree(course, ignore_errors=True)


@functools.cache
def _folder() -> Path:
    """The folder of all hubs of this process: the installation takes minutes, and the next hub finds it there."""
    folder = Path(tempfile.mkdtemp(prefix="ros2-hub-", dir="/srv"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def _toml(settings: HubSettings) -> str:
    server, limits, people = settings.server, settings.limits, settings.courses[COURSE]
    return (
        f"[server]\nfolder = {server.folder!r}\nport = {server.port}\n[limits]\nmemory_gb = {limits.memory_gb}\n"
        f"processes = {limits.processes}\ncpus = {limits.cpus}\n[courses.{COURSE}]\n"
        f"teachers = {list(people.teachers)}\nstudents = {list(people.students)}\n"
    )


def _remove(hub: RealHub) -> None:
    settings = hub.settings
    if hub.process and hub.process.poll() is None:
        hub.stop()
    leftovers.end(settings, leftovers.find(settings))
    for name in (*settings.students, *settings.teachers, *map(grader_of, settings.courses)):
        user_limits.end_group(name)
        with_home = subprocess.run(["userdel", "--force", "--remove", name], capture_output=True, check=False)
        assert with_home.returncode in (0, 6, 12), with_home.stderr  # 6: no such user, 12: no home
    for path in settings.folder.iterdir():
        if path.name not in ("installation", "proxy"):
            shutil.rmtree(path) if path.is_dir() else path.unlink()


def reason_to_skip() -> str:
    """Why no hub can run here; "" if one can."""
    if os.geteuid():
        return "only root can start servers of other users"
    return "; ".join(machine.lacking_programs())
