"""Confines a process to its own home, limits and system calls, before it runs anything of a student's."""

import contextlib
import fcntl
import os
import shutil
import signal
import socket
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO

from grader.marking.sandbox import linux, resource_limits, seccomp, separate_user
from grader.marking.sandbox.resource_limits import ResourceLimits

BUBBLEWRAP, USER, NONE = "bubblewrap", "separate user", "none"
HOME = "/student"  # of a confined process in the sandbox, and its first working directory


@dataclass(frozen=True)
class Confinement:
    """The confinement of a process.

    kind: BUBBLEWRAP, USER or NONE, which is a plain process. visible: folders that were bound from outside,
    or that it needs; those in folders that are private to each process, such as /tmp, are bound there again.
    hidden: folders among these that are empty for the process, or closed to it.
    """

    limits: ResourceLimits
    kind: str
    visible: list[str]
    hidden: list[str] = field(default_factory=list)

    @property
    def sandboxed(self) -> bool:
        """Return whether it has namespaces of its own, inside bubblewrap's."""
        return self.kind == BUBBLEWRAP


@dataclass(frozen=True)
class Home:
    """A confined process's home folder, and the user who it becomes; None if it doesn't."""

    path: str
    user: int | None = None


@contextlib.contextmanager
def home_folder(confinement: Confinement) -> Iterator[Home]:
    """Make the process's home folder, and remove it in the end; in a sandbox it is a mount of its own."""
    if confinement.sandboxed:
        yield Home(HOME)
        return
    with contextlib.ExitStack() as stack:
        path = tempfile.mkdtemp(prefix="confined-")
        stack.callback(shutil.rmtree, path, ignore_errors=True)
        user = stack.enter_context(separate_user.claim_user()) if confinement.kind == USER else None
        if user is not None:
            os.chown(path, user, user)
        yield Home(path, user)


def unshare_namespaces() -> None:
    """Give the children of this process user, PID, IPC and network namespaces of their own.

    The network has nothing but a loopback interface that is down. Fast DDS works with that.
    """
    user, group = os.getuid(), os.getgid()
    linux.unshare(linux.NEW_USER | linux.NEW_PID | linux.NEW_IPC | linux.NEW_NET)
    linux.set_dumpable(True)  # else these files would belong to root
    Path("/proc/self/setgroups").write_text("deny")
    Path("/proc/self/uid_map").write_text(f"{user} {user} 1")
    Path("/proc/self/gid_map").write_text(f"{group} {group} 1")
    linux.set_dumpable(False)


def close_other_descriptors(wire: socket.socket, answer: int, stderr: IO[bytes]) -> tuple[socket.socket, int]:
    """Close all other descriptors, and open /dev/null as stdin and stdout; return wire and answer."""
    nothing = os.open(os.devnull, os.O_RDWR)
    kept = (nothing, nothing, stderr.fileno(), wire.detach(), answer)
    above = [fcntl.fcntl(descriptor, fcntl.F_DUPFD, 100) for descriptor in kept]
    for target, descriptor in enumerate(above):
        os.dup2(descriptor, target)
    os.closerange(len(kept), os.sysconf("SC_OPEN_MAX"))
    return socket.socket(fileno=3), 4


def confine(confinement: Confinement, home: Home) -> None:
    """Apply the limits to this process, drop its capabilities and filter its system calls."""
    linux.run_like_others()
    os.setsid()  # else os.kill(0, ...) would reach the fork server and all confined processes
    os.chdir(home.path)
    os.umask(0o077)
    if not confinement.sandboxed:
        own = {"HOME": home.path, "TMPDIR": home.path, "ROS_LOG_DIR": os.path.join(home.path, ".ros")}
        os.environ |= own
    tempfile.tempdir = None
    resource_limits.apply(confinement.limits, own_users=confinement.kind != NONE)
    if confinement.sandboxed:
        linux.drop_capabilities()
    else:
        linux.be_killed_first()
    if home.user is not None:
        os.environ |= separate_user.ENVIRONMENT
        separate_user.become(home.user)
        if not os.access(home.path, os.R_OK | os.W_OK):
            raise PermissionError(f"other users can't enter {home.path}: set TMPDIR to another folder")
    linux.die_with_parent(signal.SIGKILL)  # after it has become the user, which would undo this
    if home.user is not None:
        separate_user.close_files(confinement.visible, confinement.hidden, home.path)
    linux.filter_calls(seccomp.program(confinement.limits.programs, sockets=home.user is None))
