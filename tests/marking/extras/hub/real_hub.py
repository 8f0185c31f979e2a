"""A real hub for tests: installed in a temporary folder, with Unix users of its own, and removed afterwards."""
import csv
import os
import pwd
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from grader.marking.extras.hub import accounts, user_limits
from grader.marking.extras.hub.cli import start
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
from tests.patience import PATIENCE
from tests.ports import free_port

COURSE = "hubtest"


class RealHub:
    """A hub that runs, its settings, and the passwords of its users."""

    def __init__(self, settings: HubSettings, log: Path) -> None:
        self.settings, self.log = settings, log
        self.address = f"http://127.0.0.1:{settings.server.port}"
        with (settings.folder / accounts.PASSWORDS).open() as file:
            self.passwords = dict(csv.reader(file))

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
    folder = Path(tempfile.mkdtemp(prefix="ros2-hub-"))
    folder.chmod(0o711)
    place = Path(tempfile.mkdtemp(prefix="ros2-hub-settings-"))
    people = HubCourse(("hubtest-ines", "hubtest-tom"), tuple(f"hubtest-{number:02d}" for number in range(students)))
    settings = HubSettings(
        ServerSettings(folder=str(folder), port=free_port(4)), limits or UserLimits(), {COURSE: people}
    )
    (place / FILE).parent.mkdir()
    (place / FILE).write_text(_toml(settings))
    assert read_settings(place / FILE) == replace(settings, courses=dict(settings.courses))
    log = folder / "log.txt"
    process = None
    try:
        code = "from pathlib import Path; from grader.marking.extras.hub import cli; cli._prepare("
        code += f"Path({str(ROOT)!r}), cli.read_settings(Path({str(place / FILE)!r})))"
        subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        with log.open("w") as stream:
            process = subprocess.Popen(
                [sys.executable, "-c", f"from tests.marking.extras.hub import real_hub; real_hub._run({str(place)!r})"],
                cwd=ROOT, stdout=stream, stderr=stream, start_new_session=True,
            )
        _wait_for(log, "JupyterHub is now running", process)
        yield RealHub(settings, log)
    finally:
        _remove(settings, process)
        shutil.rmtree(folder, ignore_errors=True)
        shutil.rmtree(place, ignore_errors=True)


def _run(place: str) -> None:
    signal.signal(signal.SIGINT, signal.default_int_handler)  # which a shell's background job ignores
    start(Path(place), read_settings(Path(place) / FILE))


def _toml(settings: HubSettings) -> str:
    server, limits, people = settings.server, settings.limits, settings.courses[COURSE]
    return (
        f"[server]\nfolder = {server.folder!r}\nport = {server.port}\n[limits]\nmemory_gb = {limits.memory_gb}\n"
        f"processes = {limits.processes}\ncpus = {limits.cpus}\n[courses.{COURSE}]\n"
        f"teachers = {list(people.teachers)}\nstudents = {list(people.students)}\n"
    )


def _wait_for(log: Path, text: str, process: subprocess.Popen) -> None:
    end = time.monotonic() + PATIENCE
    while text not in log.read_text():
        assert process.poll() is None, log.read_text()[-3000:]
        assert time.monotonic() < end, log.read_text()[-3000:]
        time.sleep(0.2)


def _remove(settings: HubSettings, process: subprocess.Popen | None) -> None:
    if process and process.poll() is None:
        process.send_signal(signal.SIGTERM)
        process.wait(PATIENCE)
    for name in (*settings.students, *settings.teachers, *map(grader_of, settings.courses)):
        user_limits.end_group(name)
        with_home = subprocess.run(["userdel", "--force", "--remove", name], capture_output=True, check=False)
        assert with_home.returncode in (0, 6, 12), with_home.stderr  # 6: no such user, 12: no home


def reason_to_skip() -> str:
    """Why no hub can run here; "" if one can."""
    if os.geteuid():
        return "only root can start servers of other users"
    lacking = [name for name in ("npm", "node", "useradd", "chpasswd", "make", "gcc") if not shutil.which(name)]
    return f"a hub needs {', '.join(lacking)}" if lacking else ""
