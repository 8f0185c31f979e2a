"""The system calls that Python has no function for. Each raises OSError with the name of the call."""

import contextlib
import ctypes
import os
from collections.abc import Iterator
from pathlib import Path

NEW_USER = 0x10000000
NEW_PID = 0x20000000
NEW_IPC = 0x08000000
NEW_NET = 0x40000000
NEW_MOUNT = 0x00020000

MS_RDONLY, MS_NOSUID, MS_NODEV, MS_NOEXEC, MS_REMOUNT = 1, 2, 4, 8, 32
MS_BIND, MS_REC, MS_PRIVATE, MS_SLAVE = 4096, 16384, 1 << 18, 1 << 19

_MNT_DETACH = 2
_PR_SET_PDEATHSIG = 1
_PR_SET_DUMPABLE = 4
_PR_SET_SECCOMP = 22
_PR_SET_NO_NEW_PRIVS = 38
_SECCOMP_MODE_FILTER = 2
_CAPABILITY_VERSION_3 = 0x20080522
_ADDR_NO_RANDOMIZE = 0x0040000

_libc = ctypes.CDLL(None, use_errno=True)


def _call(name: str, *arguments: object) -> None:
    if getattr(_libc, name)(*arguments) == -1:
        number = ctypes.get_errno()
        raise OSError(number, f"{name}: {os.strerror(number)}")


def _prctl(option: int, *values: object) -> None:
    numbers = [ctypes.c_ulong(value) if isinstance(value, int) else value for value in values]
    _call("prctl", option, *numbers, *[ctypes.c_ulong(0)] * (4 - len(numbers)))


def unshare(flags: int) -> None:
    """Give this process namespaces of its own."""
    _call("unshare", flags)


def mount(source: str, target: str, kind: str = "", flags: int = 0, options: str = "") -> None:
    """Mount `source` on `target`, as mount(2) says."""
    words = [word.encode() if word else None for word in (source, target, kind)]
    _call("mount", *words, ctypes.c_ulong(flags), options.encode() if options else None)


def unmount(target: str) -> None:
    """Unmount `target` lazily; what was bound from it to other paths stays mounted there."""
    _call("umount2", target.encode(), _MNT_DETACH)


def die_with_parent(signal: int) -> None:
    """Get `signal` when the parent dies."""
    _prctl(_PR_SET_PDEATHSIG, signal)


def run_first(pidfd: int) -> None:
    """Have a process run before others, with all that it forks from now on; where that is allowed.

    Linux doesn't limit how many processes root has. A fork bomb has thousands before a supervisor that
    competes with them looks a second time, and then the whole machine stops for minutes.
    """
    about = Path(f"/proc/self/fdinfo/{pidfd}").read_text(encoding="utf-8")
    process = int(about.partition("\nPid:")[2].split()[0])
    with contextlib.suppress(OSError):
        os.sched_setscheduler(process, os.SCHED_RR, os.sched_param(1))


def run_like_others() -> None:
    """Undo `run_first` for this process."""
    os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))


@contextlib.contextmanager
def same_addresses() -> Iterator[None]:
    """Turn off address space randomisation for programs that this thread starts meanwhile: personality(2).

    Where a system forbids it, as containers may, it stays on.
    """
    usual = _libc.personality(ctypes.c_ulong(0xFFFFFFFF))
    _libc.personality(ctypes.c_ulong(usual | _ADDR_NO_RANDOMIZE))
    try:
        yield
    finally:
        _libc.personality(ctypes.c_ulong(usual))


def set_dumpable(dumpable: bool) -> None:
    """Set whether processes of the same user may read and trace this one."""
    _prctl(_PR_SET_DUMPABLE, int(dumpable))


def be_killed_first() -> None:
    """Make this process the first that the kernel kills when memory runs out."""
    Path("/proc/self/oom_score_adj").write_text("1000")


def forbid_privileges() -> None:
    """No program that this process starts gains privileges, such as those of setuid programs."""
    _prctl(_PR_SET_NO_NEW_PRIVS, 1)


def drop_capabilities() -> None:
    """Drop every capability, for good: `filter_calls` sets that no program regains privileges."""
    header = (ctypes.c_uint32 * 2)(_CAPABILITY_VERSION_3, 0)
    _call("capset", header, (ctypes.c_uint32 * 6)())


def filter_calls(program: bytes) -> None:
    """Filter every system call from now on with the BPF `program`, see seccomp(2)."""

    class BpfProgram(ctypes.Structure):
        _fields_ = [("length", ctypes.c_ushort), ("instructions", ctypes.c_char_p)]

    forbid_privileges()
    _prctl(_PR_SET_SECCOMP, _SECCOMP_MODE_FILTER, ctypes.byref(BpfProgram(len(program) // 8, program)))
