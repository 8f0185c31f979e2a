"""`python -m grader hub`: its command line."""
import argparse
import os
import sys
from pathlib import Path

from grader.marking.errors import CourseError, MarkingError
from grader.marking.extras.hub import accounts, leftovers, machine
from grader.marking.extras.hub.hub_installation import copy_course, install
from grader.marking.extras.hub.hub_settings import FILE, HubSettings, read_settings, write_template
from grader.marking.extras.hub.shared_folders import make_folders

DESCRIPTION = """Start a JupyterHub for a class. The first time this writes class/hub.toml: enter the names of
teachers and students there, and run it again. It installs the course outside the homes, creates missing Unix
users, and runs until Ctrl-C."""


def main(arguments: list[str] | None = None) -> int:
    """Run the command in the course's folder; returns the exit status."""
    parser = argparse.ArgumentParser("python -m grader hub", description=DESCRIPTION)
    parser.add_argument("--check", action="store_true", help="report what this machine lacks, and do nothing "
                                                             "else")
    parser.add_argument("--prepare", action="store_true", help="do everything except start the hub")
    options = parser.parse_args(arguments)
    course = Path.cwd()
    try:
        settings = _settings(course)
        left = _find_leftovers(settings)
        lacking = [*machine.missing(settings), *([] if left else machine.used_ports(settings))]
        for sentence in [*lacking, *machine.weaknesses()]:
            print(f"{sentence[0].upper()}{sentence[1:]}.", file=sys.stderr if lacking else sys.stdout)
        if lacking:
            return 1
        if options.check:
            print("Nothing is missing.")
            return 0
        leftovers.end(settings, left)
        _prepare(course, settings)
        if not options.prepare:
            start(course, settings)
    except MarkingError as error:
        print(f"No hub: {error}.", file=sys.stderr)
        return 1
    return 0


def _settings(course: Path) -> HubSettings:
    file = write_template(course)
    settings = read_settings(file)
    if not (settings.students or settings.teachers):
        raise CourseError(f"{FILE} names no users: enter teachers and students, and run `make hub` again")
    return settings


def _find_leftovers(settings: HubSettings) -> list[int]:
    if process := leftovers.running_hub(settings):
        raise CourseError(
            f"the hub of {settings.folder} is already running, as process {process}: end it with Ctrl-C or "
            f"with `sudo kill {process}`, and run `make hub` again"
        )
    if left := leftovers.find(settings):
        print(f"An earlier hub was killed: `make hub` ends what it left running, {len(left)} processes. "
              "Servers of users, and their kernels, go on.")
    return left


def _prepare(course: Path, settings: HubSettings) -> None:
    settings.folder.mkdir(parents=True, exist_ok=True)
    install(course, settings, machine.find_python())
    created = accounts.create_missing(settings)
    make_folders(settings)
    for name in settings.courses:
        copy_course(course, settings, name)
    if created:
        file = settings.folder / accounts.PASSWORDS
        print(f"Created {len(created)} users; their passwords are in {file}: {', '.join(created)}.")


def start(course: Path, settings: HubSettings) -> None:
    """Run JupyterHub in place of this process."""
    bin_folder = settings.installation / ".venv" / "bin"
    environment = {name: value for name, value in os.environ.items() if name in ("LANG", "LC_ALL", "TZ")}
    environment["PATH"] = os.pathsep.join(
        [str(bin_folder), str(settings.folder / "proxy" / "node_modules" / ".bin"), os.defpath]
    )
    environment["ROS2_HUB_SETTINGS"] = str((course / FILE).absolute())
    os.umask(0o022)
    os.chdir(settings.folder / "hub")
    configuration = settings.installation / "jupyter" / "hub" / "jupyterhub_config.py"
    program = str(bin_folder / "jupyterhub")
    sys.stdout.flush()
    os.execve(program, [program, "--config", str(configuration)], environment)
