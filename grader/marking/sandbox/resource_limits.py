"""What a confined process may use, and how one ended."""

import math
import resource
from dataclasses import dataclass

MB = 1024 * 1024

# exited: by itself. killed: from outside. crashed: by a signal. The others: it met a limit.
KINDS = ("exited", "killed", "crashed", "memory", "cpu", "time", "idle", "threads", "disk")


@dataclass(frozen=True)
class ResourceLimits:
    """The most that one confined process may use. MB are 1024 * 1024 bytes.

    programs: it may start programs; CPU time, threads and memory are then limited for all of them together.
    idle_s: for how long these may compute nothing, however busy the machine is.
    """

    memory_mb: int = 2000  # of address space, of which an idle confined process has about 500
    cpu_s: int = 600  # CPU time of all threads together
    wall_s: float = 900  # seconds from start to end
    file_mb: int = 64  # in one file
    scratch_mb: int = 128  # in all files: /tmp, /dev/shm and HOME together
    scratch_files: int = 4096
    threads: int = 256
    open_files: int = 256
    programs: bool = False
    idle_s: float = math.inf


USUAL = ResourceLimits()


@dataclass(frozen=True)
class ProcessEnd:
    """The end of a confined process.

    kind: one of KINDS. detail: the same as a sentence. code: its exit status, negative for a signal.
    cpu_s: its CPU time. peak_mb: its peak memory, None if that is unknown.
    stderr: the end of what it wrote there. Like the exit status, it is under the control of the process.
    """

    kind: str
    detail: str
    code: int | None = None
    cpu_s: float = 0.0
    peak_mb: float | None = None
    stderr: str = ""


def apply(limits: ResourceLimits, own_users: bool) -> None:
    """Limit this process from now on. own_users: whether it has a user namespace of its own.

    The supervisor watches the CPU time: with Linux's own limit, this end would look like any other kill.
    """
    figures = {
        resource.RLIMIT_AS: limits.memory_mb * MB,
        resource.RLIMIT_FSIZE: limits.file_mb * MB,
        resource.RLIMIT_NOFILE: limits.open_files,
        resource.RLIMIT_MSGQUEUE: 0,
        resource.RLIMIT_STACK: 8 * MB,
        # Not 0: the kernel still pipes a dump to a collector at 0, and at 1 it does not.
        resource.RLIMIT_CORE: 1,
    }
    if own_users:  # elsewhere it would count all processes of the user who marks
        figures[resource.RLIMIT_NPROC] = limits.threads
    for name, figure in figures.items():
        _, hard = resource.getrlimit(name)
        figure = figure if hard == resource.RLIM_INFINITY else min(figure, hard)
        resource.setrlimit(name, (figure, figure))
