"""Runs a command as in a container with Docker's usual settings: root, but no namespaces and no mounts.

    python -m tests.marking.sandbox.docker_like [--without-landlock] COMMAND ...

It has the fourteen capabilities of such a container, and its filter refuses what Docker's default profile
refuses without CAP_SYS_ADMIN. The home of root is empty but for a Python in it, so that every user may read
that, as in a container.
"""
import ctypes
import errno
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from grader.marking.sandbox import linux, seccomp
from grader.marking.sandbox.seccomp import _ALLOW, _CLONE, _CLONE3, _CLONE_NEW, _argument, _rule, _step

CAPABILITIES = (0, 1, 3, 4, 5, 6, 7, 8, 10, 13, 18, 27, 29, 31)  # see capabilities(7), and Docker's list
REFUSED = (
    *("mount", "umount2", "pivot_root", "open_tree", "move_mount", "fsopen", "fsconfig", "fsmount", "fspick"),
    *("mount_setattr", "unshare", "setns", "bpf", "perf_event_open", "userfaultfd", "keyctl", "add_key"),
    *("request_key", "kexec_load", "open_by_handle_at", "io_uring_setup"),
)
WITHOUT = "--without-landlock"
LANDLOCK = 444, 445, 446
PYTHONS = Path("/root/.pyenv/versions")


def filter_program(landlock: bool) -> bytes:
    """What the container refuses. landlock: whether its kernel has that."""
    refuse = _step(0x06, 0x00050000 | errno.EPERM)
    unknown = _step(0x06, 0x00050000 | errno.ENOSYS)
    return b"".join(
        [
            _step(0x20, 0),
            _rule(_CLONE3, unknown),
            _rule(_CLONE, _argument(0), _step(0x45, _CLONE_NEW, 0, 1), refuse, _ALLOW),
            *(_rule(seccomp.DENIED[name], refuse) for name in REFUSED),
            *(_rule(number, unknown) for number in LANDLOCK if not landlock),
            _ALLOW,
        ]
    )


def readable_python() -> None:
    """A mount namespace in which other users can enter /root, where a Python is."""
    linux.unshare(linux.NEW_MOUNT)
    linux.mount("", "/", flags=linux.MS_REC | linux.MS_PRIVATE)
    if not PYTHONS.is_dir():
        return
    aside = Path("/mnt")
    linux.mount(str(PYTHONS), str(aside), flags=linux.MS_BIND | linux.MS_REC)
    linux.mount("home", "/root", "tmpfs", options="mode=755")
    PYTHONS.mkdir(parents=True)
    linux.mount(str(aside), str(PYTHONS), flags=linux.MS_BIND | linux.MS_REC)
    linux.unmount(str(aside))


def enter(landlock: bool) -> None:
    """Become such a process. landlock: whether its kernel has that."""
    readable_python()
    libc = ctypes.CDLL(None, use_errno=True)
    for capability in range(41):
        if capability not in CAPABILITIES:
            libc.prctl(24, capability, 0, 0, 0)  # PR_CAPBSET_DROP
    kept = sum(1 << capability for capability in CAPABILITIES)
    header = (ctypes.c_uint32 * 2)(0x20080522, 0)
    data = (ctypes.c_uint32 * 6)(*(kept & 0xFFFFFFFF,) * 2, 0, kept >> 32, kept >> 32, 0)
    assert libc.capset(header, data) == 0
    program = filter_program(landlock)

    class BpfProgram(ctypes.Structure):
        _fields_ = [("length", ctypes.c_ushort), ("instructions", ctypes.c_char_p)]

    found = BpfProgram(len(program) // 8, program)
    assert libc.prctl(38, 1, 0, 0, 0) == 0  # without CAP_SYS_ADMIN a filter needs PR_SET_NO_NEW_PRIVS
    assert libc.prctl(22, 2, ctypes.byref(found), 0, 0) == 0


def run_in_container(
    *command: str, landlock: bool = True, **settings: Any
) -> subprocess.CompletedProcess[str]:
    """Run a command there."""
    whole = [sys.executable, "-m", __name__, *(() if landlock else (WITHOUT,)), *command]
    return subprocess.run(whole, capture_output=True, text=True, check=False, **settings)


if __name__ == "__main__":
    found = WITHOUT not in sys.argv[1:2]
    enter(found)
    command = sys.argv[1 if found else 2 :]
    os.execvp(command[0], command)
