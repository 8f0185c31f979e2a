"""What a confined process may use, and how one came to its end."""

import resource
from dataclasses import dataclass

MB = 1024 * 1024

# exited: by itself. killed: from outside. crashed: by a signal. memory, cpu, time, threads: a limit was met.
KINDS = ("exited", "killed", "crashed", "memory", "cpu", "time", "threads")


@dataclass(frozen=True)
class Limits:
    """The most that one confined process may use. MB are 1024 * 1024 bytes.

    programs: it may start programs, and computing, threads and memory are those of all of them together.
    """

    memory_mb: int = 2000  # of address space, of which an idle confined process has about 500
    cpu_s: int = 600  # seconds of computing, all threads together
    wall_s: float = 900  # seconds from start to end
    file_mb: int = 64  # in one file
    scratch_mb: int = 128  # in all files: /tmp, /dev/shm and HOME together
    scratch_files: int = 4096
    threads: int = 256
    open_files: int = 256
    programs: bool = False


USUAL = Limits()


@dataclass(frozen=True)
class Ending:
    """How a confined process ended.

    kind: one of KINDS. detail: a sentence that says it. code: its exit status, negative for a signal.
    cpu_s: seconds it computed. peak_mb: most memory it had, None if nobody could tell.
    words: the last it wrote to its stderr. Like the exit status, that is what it says of itself.
    """

    kind: str
    detail: str
    code: int | None = None
    cpu_s: float = 0.0
    peak_mb: float | None = None
    words: str = ""


def apply(limits: Limits, own_users: bool) -> None:
    """Limit this process from now on; `own_users` says that it has a user namespace of its own.

    The supervisor watches the time, for Linux's own limit counts it too roughly to be told from other ends.
    """
    figures = {
        resource.RLIMIT_AS: limits.memory_mb * MB,
        resource.RLIMIT_FSIZE: limits.file_mb * MB,
        resource.RLIMIT_NOFILE: limits.open_files,
        resource.RLIMIT_MSGQUEUE: 0,
        resource.RLIMIT_STACK: 8 * MB,
        # Not 0: programs that collect dumps through a pipe are kept away by 1 only.
        resource.RLIMIT_CORE: 1,
    }
    if own_users:  # elsewhere it would count all processes of the user who marks
        figures[resource.RLIMIT_NPROC] = limits.threads
    for name, figure in figures.items():
        _, hard = resource.getrlimit(name)
        figure = figure if hard == resource.RLIM_INFINITY else min(figure, hard)
        resource.setrlimit(name, (figure, figure))
