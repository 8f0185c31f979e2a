"""The walls around a confined process, which builds them itself before it runs anything of a student's."""

import contextlib
import fcntl
import os
import shutil
import signal
import socket
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from grader.marking.sandbox import limits, linux, seccomp
from grader.marking.sandbox.limits import MB, Limits

HOME = "/student"  # of a confined process in the sandbox, and where it starts
STAGE = "/scratch"  # where its file system is put together
READ_ONLY = linux.MS_RDONLY | linux.MS_NOSUID | linux.MS_NODEV | linux.MS_NOEXEC  # as /proc is mounted
DEVICES = ("/dev/null", "/dev/zero", "/dev/full", "/dev/random", "/dev/urandom", "/dev/tty")


@dataclass(frozen=True)
class Confinement:
    """How a process is confined.

    sandboxed: in the sandbox; otherwise as a plain process. visible: folders that were bound from outside;
    those in places that are private to each process, such as /tmp, are shown there again.
    """

    limits: Limits
    sandboxed: bool
    visible: list[str]


@contextlib.contextmanager
def folder(confinement: Confinement) -> Iterator[str]:
    """Make the folder that is HOME, and remove it in the end. In a sandbox it is a file system of its own."""
    if confinement.sandboxed:
        yield HOME
        return
    path = tempfile.mkdtemp(prefix="confined-")
    try:
        yield path
    finally:
        shutil.rmtree(path, ignore_errors=True)


def separate() -> None:
    """Give the children of this process users, processes, messages and a network of their own.

    The network has nothing but a loopback interface that is down. Fast DDS is content with it.
    """
    user, group = os.getuid(), os.getgid()
    linux.unshare(linux.NEW_USER | linux.NEW_PID | linux.NEW_IPC | linux.NEW_NET)
    linux.set_dumpable(True)  # else these files would belong to root
    Path("/proc/self/setgroups").write_text("deny")
    Path("/proc/self/uid_map").write_text(f"{user} {user} 1")
    Path("/proc/self/gid_map").write_text(f"{group} {group} 1")
    linux.set_dumpable(False)


def furnish(confinement: Confinement) -> None:
    """Give this process files of its own: one small file system behind all places that can be written.

    What was opened before leads to the files of others still; `keep_only` closes it.
    """
    linux.unshare(linux.NEW_MOUNT)
    linux.mount("", "/", flags=linux.MS_REC | linux.MS_PRIVATE)
    most = confinement.limits
    options = f"mode=755,size={most.scratch_mb * MB},nr_inodes={most.scratch_files}"
    linux.mount("scratch", STAGE, "tmpfs", linux.MS_NOSUID | linux.MS_NODEV, options)
    scratch = Path(STAGE)
    places = {"tmp": "/tmp", "shm": "/dev/shm", "terminals": "/dev/pts", "processes": "/proc", "home": HOME}
    for name in places:
        (scratch / name).mkdir()
    # Of the processes it sees itself only.
    itself = scratch / "processes/self"
    itself.mkdir()
    linux.set_dumpable(True)  # else its own /proc/self would be closed to it
    _go_first()
    _bind("/proc/self", itself)
    # Nothing in it can be changed: else where memory runs out, the one who took it could let others go.
    linux.mount("", str(itself), flags=linux.MS_REMOUNT | linux.MS_BIND | READ_ONLY)
    for place in confinement.visible:
        for name, private in places.items():
            if Path(place).is_relative_to(private):
                _bind(place, scratch / name / Path(place).relative_to(private))
    for name, place in places.items():
        _bind(scratch / name, place)
    linux.unmount(STAGE)
    for device in DEVICES:  # the machine's own: where root marks, a confined process could change their mode
        linux.mount("", device, flags=linux.MS_REMOUNT | linux.MS_BIND | linux.MS_RDONLY | linux.MS_NOSUID)


def keep_only(wire: socket.socket, answer: int, stderr: IO[bytes]) -> tuple[socket.socket, int]:
    """Close every descriptor but these, let stdin and stdout lead nowhere; return the wire and the answer."""
    nothing = os.open(os.devnull, os.O_RDWR)
    kept = (nothing, nothing, stderr.fileno(), wire.detach(), answer)
    above = [fcntl.fcntl(descriptor, fcntl.F_DUPFD, 100) for descriptor in kept]
    for target, descriptor in enumerate(above):
        os.dup2(descriptor, target)
    os.closerange(len(kept), os.sysconf("SC_OPEN_MAX"))
    return socket.socket(fileno=3), 4


def confine(confinement: Confinement, home: str) -> None:
    """Shut this process in: its limits, its rights and its system calls."""
    linux.die_with_parent(signal.SIGKILL)
    os.setsid()  # else os.kill(0, ...) would reach the fork server and all confined processes
    os.chdir(home)
    os.umask(0o077)
    if not confinement.sandboxed:
        os.environ |= {"HOME": home, "TMPDIR": home, "ROS_LOG_DIR": os.path.join(home, ".ros")}
    tempfile.tempdir = None
    limits.apply(confinement.limits, own_users=confinement.sandboxed)
    if confinement.sandboxed:
        linux.drop_capabilities()
    else:
        _go_first()
    linux.filter_calls(seccomp.program(confinement.limits.programs))


def _go_first() -> None:
    """Where memory runs out, this process is the first to be killed."""
    Path("/proc/self/oom_score_adj").write_text("1000")


def _bind(source: str | Path, target: str | Path) -> None:
    target = Path(target)
    if Path(source).is_dir():
        target.mkdir(parents=True, exist_ok=True)
    elif not target.exists():
        target.parent.mkdir(parents=True, exist_ok=True)
        target.touch()
    linux.mount(str(source), str(target), flags=linux.MS_BIND | linux.MS_REC)
