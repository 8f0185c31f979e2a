"""Processes that a killed hub left running: its proxy, its services, and the servers of its users.

The servers of students and teachers go on, and the next hub finds them. The others hold the hub's ports, so
they are ended before the next hub starts.
"""
import os
import pwd
import select
import signal
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from grader.marking.extras.hub.hub_settings import HubSettings, grader_of

HUB = "jupyterhub"
OWN = ("configurable-http-proxy", "jupyterhub_idle_culler", "jupyterhub-singleuser")
PROXY_PID = "jupyterhub-proxy.pid"
SECONDS = 10.0  # for a process to end by itself


def running_hub(settings: HubSettings) -> int:
    """The process of the hub that runs in this folder; 0 if there is none."""
    return next(_processes(settings, (HUB,)), 0)


def find(settings: HubSettings) -> list[int]:
    """The processes of an earlier hub itself, without the servers of students and teachers."""
    return list(_processes(settings, OWN))


def end(settings: HubSettings, processes: list[int]) -> None:
    """End these processes, and remove the file with the number of the proxy's.

    After a reboot another program may have that number, and JupyterHub would end that one.
    """
    for process in processes:
        with suppress(ProcessLookupError):
            _end(os.pidfd_open(process))
    (settings.folder / "hub" / PROXY_PID).unlink(missing_ok=True)


def _end(descriptor: int) -> None:
    try:
        for number in (signal.SIGTERM, signal.SIGKILL):
            signal.pidfd_send_signal(descriptor, number)
            if select.select([descriptor], [], [], SECONDS)[0]:
                return
    finally:
        os.close(descriptor)


def is_process_of(process: int, name: str) -> bool:
    """Return whether the process belongs to this user; numbers of ended ones are used again."""
    return _owner(process) == pwd.getpwnam(name).pw_uid


def _processes(settings: HubSettings, programs: tuple[str, ...]) -> Iterator[int]:
    """Those that root or a grader started from this hub's installation."""
    names = {"root", *map(grader_of, settings.courses)}
    owners = {user.pw_uid for user in pwd.getpwall() if user.pw_name in names}
    for process in [int(path.name) for path in Path("/proc").glob("[0-9]*")]:
        words = _words(process)[:3]
        inside = any(word.startswith(f"{settings.folder}/") for word in words[:2])
        if inside and _owner(process) in owners and any(Path(word).name in programs for word in words):
            yield process


def _words(process: int) -> list[str]:
    """The command line; empty for a process that has ended."""
    try:
        return Path(f"/proc/{process}/cmdline").read_bytes().decode(errors="replace").split("\0")[:-1]
    except OSError:
        return []


def _owner(process: int) -> int:
    try:
        return os.stat(f"/proc/{process}").st_uid
    except OSError:
        return -1
