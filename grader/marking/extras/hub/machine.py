"""What a machine lacks for a hub."""
import os
import shutil
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

from grader.marking.extras.hub import accounts, become_user, user_limits
from grader.marking.extras.hub.hub_settings import HubSettings

PYTHONS = ("python3.12", "python3.13", "python3.14", "python3.11", "python3")
FOLDERS = ("/usr/local/bin", "/usr/bin")
PAM = Path("/etc/pam.d/login")
INSTALL_MB, START_MB = 2000, 100
COMMANDS = {  # and the Debian package that has it
    "npm": "npm",
    "node": "nodejs",
    "make": "make",
    "gcc": "build-essential",
    "g++": "build-essential",
    "useradd": "passwd",
    "chpasswd": "passwd",
    "bwrap": "bubblewrap",
}


def missing(settings: HubSettings) -> list[str]:
    """A sentence for each thing without which the hub can't work here: what, and how to get it."""
    not_root = ["a hub starts servers of other users, and only root can do that: run it with sudo"]
    found = [*lacking_programs(), *_server(settings), *_disk(settings), *accounts.problems(settings)]
    return [*not_root, *found] if os.geteuid() else found


def used_ports(settings: HubSettings) -> list[str]:
    """A sentence for each port of the hub that another program uses."""
    server = settings.server
    first = server.port + 1  # its other ports follow its own
    others = [_used("127.0.0.1", port) for port in range(first, first + 2 + len(settings.courses))]
    return list(filter(None, [_used(server.address, server.port), *others]))


def weaknesses() -> list[str]:
    """A sentence for each thing without which it works less well."""
    found = []
    if lacking := user_limits.missing_controllers():
        found.append(
            f"this machine doesn't let users limit {', '.join(lacking)} (control groups in "
            f"{user_limits.ROOT}): one user can take all of it; on a server use a system with systemd"
        )
    if not _can_hide_users():
        found.append(
            "root may not mount file systems here: users see the names of other users' processes, and of "
            "their files in /tmp; a container needs the capability SYS_ADMIN for that"
        )
    return found


def find_python() -> str:
    """A Python that every user can run; "" if there is none. One below /root is for root only."""
    for name in PYTHONS:
        for folder in FOLDERS:
            path = Path(folder, name)
            if path.exists() and _can_be_run_by_all(path.resolve()) and _is_supported(path):
                return str(path)
    return ""


def lacking_programs() -> Iterator[str]:
    """A sentence for each program that is missing, and how to get it."""
    for command, package in COMMANDS.items():
        if not shutil.which(command):
            yield f"there is no {command}: install it with `apt install {package}`"
    if not find_python():
        yield (
            "no Python 3.11 to 3.14 is in /usr/bin or /usr/local/bin, and users can't run one of root's: "
            "install it with `apt install python3 python3-venv python3-dev`"
        )
    if not PAM.exists():
        yield f"there is no {PAM}, with which passwords are checked: install it with `apt install login`"


def _server(settings: HubSettings) -> Iterator[str]:
    server = settings.server
    for name in ("certificate", "key"):
        path = getattr(server, name)
        if path and not os.access(path, os.R_OK):
            yield f"server.{name} can't be read: {path}"
    if server.address not in ("127.0.0.1", "localhost", "::1") and not server.certificate:
        yield (
            f"with the address {server.address!r} passwords would cross the network unencrypted: "
            "write server.certificate and server.key, or keep 127.0.0.1 and put a proxy with https before it"
        )


def _disk(settings: HubSettings) -> Iterator[str]:
    needed = START_MB if (settings.installation / ".venv").exists() else INSTALL_MB
    for folder in (settings.folder, settings.folder / "hub"):  # the second one has the hub's database
        existing = next(place for place in (folder, *folder.parents) if place.exists())
        free = shutil.disk_usage(existing).free / 1e6
        if free < needed:
            yield (
                f"the disk of {folder} is full: {free:.0f} MB are free, and the hub needs {needed} MB; make "
                "room, and run `make hub` again"
            )
            return


def _used(address: str, port: int) -> str:
    with closing(socket.socket(socket.AF_INET6 if ":" in address else socket.AF_INET)) as trial:
        trial.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            trial.bind((address, port))
        except (OSError, OverflowError) as error:
            reason = error.strerror if isinstance(error, OSError) else "there is no such port"
            return f"port {port} of {address!r} can't be used ({reason}): change server.port"
    return ""


def _can_hide_users() -> bool:
    trial = [sys.executable, "-c", f"from {become_user.__name__} import hide_others; hide_others()"]
    return os.geteuid() != 0 or subprocess.run(trial, capture_output=True).returncode == 0


def _can_be_run_by_all(path: Path) -> bool:
    return all(place.stat().st_mode & 0o001 for place in (path, *path.parents))


def _is_supported(python: Path) -> bool:
    code = "import sys, venv, ensurepip; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 14))"
    return subprocess.run([python, "-c", code], capture_output=True).returncode == 0
