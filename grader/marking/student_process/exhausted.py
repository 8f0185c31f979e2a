"""Whether this process has used up what later cells need. Its own claim: it only starts the process again."""

import errno
import os
import resource
from collections.abc import Iterator

SHARE = 0.75  # of a limit, from which on it counts as used up
USUAL_STACK = 8 << 20  # bytes of memory that a thread has for itself, where the limit is not lower
SCRATCH_BYTES = 1 << 30  # a larger file system is the machine's own, of processes without a sandbox


def used_up() -> str:
    """Return what is nearly used up: "memory", "threads", "open files" or "disk space"; "" for nothing."""
    try:
        return next((name for name, share in _shares() if share > SHARE), "")
    except (MemoryError, OSError) as error:  # not even this can be read any more
        return "open files" if getattr(error, "errno", 0) == errno.EMFILE else "memory"


def _shares() -> Iterator[tuple[str, float]]:
    memory, threads = _pages() * resource.getpagesize(), len(os.listdir("/proc/self/task"))
    stacks = threads * min(_limit(resource.RLIMIT_STACK), USUAL_STACK)
    yield "threads" if stacks > memory / 2 else "memory", memory / _limit(resource.RLIMIT_AS)
    yield "threads", threads / _limit(resource.RLIMIT_NPROC)
    yield "open files", len(os.listdir("/proc/self/fd")) / _limit(resource.RLIMIT_NOFILE)
    disk = os.statvfs(".")
    if 0 < disk.f_blocks * disk.f_frsize < SCRATCH_BYTES:
        yield "disk space", 1 - disk.f_bavail / disk.f_blocks
        yield "disk space", 1 - disk.f_favail / max(disk.f_files, 1)


def _pages() -> int:
    with open("/proc/self/statm") as file:
        return int(file.read().split()[0])


def _limit(kind: int) -> float:
    soft, _ = resource.getrlimit(kind)
    return float("inf") if soft == resource.RLIM_INFINITY else soft
