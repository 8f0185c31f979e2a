"""Confined processes as users of their own, for machines on which root can't make namespaces.

That is so in a container with Docker's usual settings. Each process is a user that nothing else belongs to,
without any group; it opens no socket, and where the kernel has Landlock, it reaches no file but those that a
process in the other sandbox would see.
"""

from __future__ import annotations

import contextlib
import fcntl
import os
import secrets
import shutil
import subprocess
import sys
from collections.abc import Collection, Iterator, Sequence
from pathlib import Path
from typing import IO, Any

from grader.marking.sandbox import landlock, linux
from grader.marking.sandbox.resource_limits import MB, ResourceLimits

USERS = range(61184, 65520)  # that systemd, too, gives to processes for a time
LOCKS = Path("/run/ros2-course-users")  # a file for each of them, locked while it is in use
SHARED = ("/dev/shm", "/tmp", "/var/tmp", "/run/lock")  # folders where every user may write
SHARED_MEMORY = "/dev/shm"  # for Fast DDS, whose files are readable by their owner alone
READABLE = ("/usr", "/bin", "/sbin", "/lib", "/lib32", "/lib64")
BLOCK = 512  # bytes: the unit of st_blocks
SETTINGS = ("ld.so.cache", "ld.so.conf", "ld.so.conf.d", "alternatives", "fonts", "localtime")
DEVICES = ("/dev/null", "/dev/zero", "/dev/full", "/dev/random", "/dev/urandom")
# Looks at files as another user; the first number is how many must be readable, the others must be closed.
LOOK = """
import os, sys
count, *paths = sys.argv[1:]
for path in paths[: int(count)]:
    if not os.access(path, os.R_OK):
        sys.exit(print(f"other users can't read {path}"))
for path in paths[int(count) :]:
    if os.access(path, os.R_OK | os.X_OK):
        close = f"run `chmod 700 {path}`"
        sys.exit(print(f"this kernel has no Landlock, and other users can enter {path}: {close}"))
"""
# Without sockets, its own nodes receive each other in shared memory. The judge's Fast DDS doesn't use that.
ENVIRONMENT = {"FASTDDS_BUILTIN_TRANSPORTS": "SHM"}


def why_not(visible: Sequence[str], hidden: Sequence[str]) -> str:
    """Return why students' processes can't be users of their own here, as a sentence; "" if they can.

    It needs root. visible: paths that they need. hidden: folders that must be closed to them.
    """
    problem = _try_as_user(visible, hidden)
    return f"Separate users don't work either: {problem}." if problem else ""


def _try_as_user(visible: Sequence[str], hidden: Sequence[str]) -> str:
    """Look at the files as such a user; returns a problem, or ""."""
    wanted = [sys.executable, os.__file__, *visible]
    closed = [] if landlock.version() else [*hidden]
    try:
        with claim_user() as user:
            words = [sys.executable, "-ISc", LOOK, str(len(wanted)), *wanted, *closed]
            done = _run_as(user, words, capture_output=True, text=True)
    except PermissionError:
        return f"other users can't read {sys.executable}"
    except OSError as error:
        return str(error)
    return (done.stdout or done.stderr).strip()


def _run_as(user: int, words: Sequence[str], **options: Any) -> subprocess.CompletedProcess[str]:
    return subprocess.run(words, user=user, group=user, extra_groups=[], cwd="/", check=False, **options)


@contextlib.contextmanager
def claim_user() -> Iterator[int]:
    """A user to whom nothing belongs; in the end its processes and files are removed. Raises OSError.

    The first one that is tried is drawn: the kernel counts the threads of a user in all containers together.
    """
    LOCKS.mkdir(mode=0o700, exist_ok=True)
    first = secrets.randbelow(len(USERS))
    for user in (*USERS[first:], *USERS[:first]):
        path = LOCKS / str(user)
        with open(path, "w") as lock:
            if not _is_locked(lock, path):
                continue
            clear(user)  # what a killed supervisor may have left
            try:
                yield user
            finally:
                clear(user)
                path.unlink()
            return
    raise OSError(f"all users from {USERS[0]} to {USERS[-1]} are in use")


def clear_unused() -> None:
    """Remove the processes and files of all users whose supervisors were killed."""
    for path in LOCKS.glob("*"):
        with contextlib.suppress(FileNotFoundError), open(path) as lock:
            if _is_locked(lock, path):
                clear(int(path.name))
                path.unlink()


def _is_locked(lock: IO[str], path: Path) -> bool:
    """Lock a file; return whether that worked, and it is still the one at this path."""
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return os.path.samestat(os.fstat(lock.fileno()), os.stat(path))
    except (BlockingIOError, FileNotFoundError):
        return False


def clear(user: int) -> None:
    """Kill all processes of a user, and remove its files where every user may write."""
    quiet = subprocess.DEVNULL  # kill complains if there is none
    _run_as(user, ["/bin/sh", "-c", "kill -s KILL -- -1"], stdin=quiet, stdout=quiet, stderr=quiet)
    for folder in SHARED:
        with contextlib.suppress(OSError):
            for entry in list(os.scandir(folder)):
                if entry.stat(follow_symlinks=False).st_uid == user:
                    _remove(entry)


def _remove(entry: os.DirEntry[str]) -> None:
    if entry.is_dir(follow_symlinks=False):
        shutil.rmtree(entry.path, ignore_errors=True)
    else:
        with contextlib.suppress(OSError):
            os.unlink(entry.path)


def become(user: int) -> None:
    """Make this process the user's, for good: no groups, no capabilities, nothing to regain them by."""
    os.setgroups([])
    os.setresgid(user, user, user)
    os.setresuid(user, user, user)
    linux.drop_capabilities()
    linux.forbid_privileges()
    linux.set_dumpable(True)  # else its own /proc/self would be root's


def close_files(visible: Sequence[str], hidden: Collection[str], home: str) -> None:
    """Close all files to this process but those it needs, where the kernel has Landlock. Raises OSError."""
    if not landlock.version():
        return
    rules = [(path, landlock.READ) for path in (*READABLE, *(f"/etc/{name}" for name in SETTINGS))]
    for path in visible:
        rules += _rules(path, hidden)
    rules += [(path, landlock.USE) for path in DEVICES]
    writable = home, SHARED_MEMORY
    landlock.restrict([*rules, *((path, landlock.WRITE) for path in writable), ("/proc/self", landlock.READ)])


def _rules(path: str, hidden: Collection[str]) -> Iterator[tuple[str, int]]:
    """The rules that open a path without the hidden folders in it. Their names can be listed."""
    if path in hidden:
        return
    if not any(Path(other).is_relative_to(path) for other in hidden):
        yield path, landlock.READ
        return
    yield path, landlock.LIST
    for entry in os.scandir(path):
        yield from _rules(entry.path, hidden)


def too_many_files(user: int, home: str, limits: ResourceLimits) -> bool:
    """Return whether the files in a process's home, and of its user in shared memory, exceed its limits."""
    blocks = count = 0
    most = limits.scratch_mb * MB // BLOCK
    for about in _own_files(user, home):
        blocks, count = blocks + about.st_blocks, count + 1
        if blocks > most or count > limits.scratch_files:
            return True
    return False


def _own_files(user: int, home: str) -> Iterator[os.stat_result]:
    for folder, _, names in os.walk(home):
        for name in names:
            with contextlib.suppress(OSError):
                yield os.lstat(os.path.join(folder, name))
    for entry in os.scandir(SHARED_MEMORY):
        with contextlib.suppress(OSError):
            about = entry.stat(follow_symlinks=False)
            if about.st_uid == user:
                yield about
