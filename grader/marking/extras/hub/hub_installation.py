"""The students' course and its packages, installed once for all, and a course folder for each course."""
import os
import pwd
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from grader.marking.errors import CourseError
from grader.marking.extras.hub.hub_settings import HubSettings, grader_of
from grader.marking.release import handout

PROXY = "configurable-http-proxy"
PROXY_VERSION = "5.3.0"
LOCK = ".ci/hub.lock"
ADDED = ("jupyter/hub", "grader/marking/extras/hub", LOCK)  # to what students get at home
LEFT_OUT = (".git", ".venv*", "class", "work", "dist", "wheels", "build", "test-artifacts", "*.egg-info")
CACHES = ("__pycache__", ".*_cache", ".ipynb_checkpoints", ".secret", ".signing-key")
READABLE = 0o022  # the umask: everyone reads the installation, and only root writes it


def install(course: Path, settings: HubSettings, python: str) -> None:
    """Make or update the installation; a second call is quick. Raises CourseError."""
    os.umask(READABLE)
    folder = settings.installation
    folder.mkdir(parents=True, exist_ok=True)
    handout.write_folder(handout.contents(course) | dict(_added(course)), folder)
    system = os.pathsep.join(["/usr/local/bin", "/usr/bin", "/bin"])
    # Users can't write what Python would keep of a module: without it each server's start compiles thousands.
    kept = {"UV_COMPILE_BYTECODE": "1"}
    environment = {**os.environ, **kept, "PATH": system, "PYTHON": python, "WHEELS": str(course / "wheels")}
    for name in ("VIRTUAL_ENV", "PYTHONPATH", "MAKEFLAGS", "VENV"):
        environment.pop(name, None)
    _run(["make", "--no-print-directory", "setup"], folder, environment)
    _run(["sh", ".ci/setup", ".venv", LOCK], folder, environment)
    packages = ["sim", "grader", "ros_packages/python", "jupyter"]
    _run([".venv/bin/python", "-m", "compileall", "-q", *packages], folder, environment)
    # Some tools leave files that everyone may write.
    _run(["chmod", "--recursive", "go-w", "."], folder, environment)
    proxy = settings.folder / "proxy"
    if not (proxy / "node_modules" / PROXY).is_dir():
        quiet = ("--silent", "--no-fund", "--no-audit")
        package = f"{PROXY}@{PROXY_VERSION}"
        _run(["npm", "install", *quiet, "--prefix", proxy, package], folder, dict(os.environ))


def copy_course(course: Path, settings: HubSettings, name: str) -> None:
    """Copy the course with its solutions for the teachers; a class and its secret there stay as they are."""
    target = settings.course_folder(name)
    shutil.copytree(course, target, dirs_exist_ok=True, ignore=shutil.ignore_patterns(*LEFT_OUT, *CACHES))
    (target / "class").mkdir(exist_ok=True)
    (target / "class" / "hub_config.py").write_text(_exchange_settings(settings, name), encoding="utf-8")
    grader = pwd.getpwnam(grader_of(name))
    for path in [target, *_everything(target)]:
        os.chown(path, grader.pw_uid, grader.pw_gid, follow_symlinks=False)
    if not (target / "class" / "gradebook.db").exists():
        python = str(settings.installation / ".venv" / "bin" / "python")
        done = subprocess.run(
            [python, "-m", "grader.marking.release.make_exercises"],
            cwd=target, user=grader.pw_uid, group=grader.pw_gid, extra_groups=[],
            env={"PATH": os.defpath, "HOME": str(settings.home(name)), "PYTHONPATH": str(target)},
        )
        if done.returncode:
            raise CourseError(f"the gradebook of {name} could not be made: the reason is above")


def _added(course: Path) -> Iterator[tuple[str, bytes]]:
    for part in ADDED:
        path = course / part
        for file in path.rglob("*") if path.is_dir() else [path]:
            if file.is_file() and "__pycache__" not in file.parts:
                yield file.relative_to(course).as_posix(), file.read_bytes()


def _everything(folder: Path) -> Iterator[Path]:
    for place, folders, files in os.walk(folder):
        yield from (Path(place, name) for name in (*folders, *files))


def _exchange_settings(settings: HubSettings, name: str) -> str:
    package = "grader.marking.extras.hub.hub_exchange"
    return f'''"""Written by `make hub`; nbgrader_config.py reads it."""
c = get_config()
c.CourseDirectory.course_id = {name!r}
c.Exchange.root = {str(settings.exchange(name))!r}
c.ExchangeFactory.release_assignment = "{package}.ReleaseAssignment"
c.ExchangeCollect.check_owner = False  # it was checked when they were taken out of the inboxes
c.ExchangeFactory.collect = "{package}.CollectFromInboxes"
c.ExchangeFactory.release_feedback = "{package}.ReleaseFeedbackToInboxes"
c.Inboxes.folder = {str(settings.inboxes(name))!r}
'''


def _run(command: list[str | Path], folder: Path, environment: dict[str, str]) -> None:
    sys.stdout.flush()
    if subprocess.run(command, cwd=folder, env=environment).returncode:
        raise CourseError(f"`{' '.join(map(str, command))}` failed in {folder}: the reason is above")
