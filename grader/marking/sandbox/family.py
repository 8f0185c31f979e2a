"""What a confined process and all that it started use together, where it may start programs."""

from __future__ import annotations

import contextlib
import os
import resource
from dataclasses import dataclass

TICKS = os.sysconf("SC_CLK_TCK")
MB = 1024 * 1024


@dataclass
class Used:
    """Seconds of computing, also of children that ended; threads, and MB of memory, of those that live."""

    cpu_s: float = 0.0
    threads: int = 0
    memory_mb: float = 0.0


def used_by(process: int, processes: int) -> Used:
    """What a process and all below it use. processes: an open /proc. See proc(5) for the fields of `stat`."""
    fields, children = {}, {}
    for name in os.listdir(processes):
        with contextlib.suppress(OSError, ValueError):  # it may have ended
            stat = _read(f"{int(name)}/stat", processes).rpartition(b")")[2].split()
            fields[int(name)] = stat
            children.setdefault(int(stat[1]), []).append(int(name))
    whole, left = Used(), [process]
    while left:
        one = left.pop()
        left += children.get(one, [])
        if one in fields:
            stat = fields[one]
            whole.cpu_s += sum(map(int, stat[11:15])) / TICKS  # with that of children it has waited for
            whole.threads += int(stat[17])
            whole.memory_mb += int(stat[21]) * resource.getpagesize() / MB
    return whole


def _read(path: str, folder: int) -> bytes:
    with os.fdopen(os.open(path, os.O_RDONLY, dir_fd=folder), "rb") as file:
        return file.read()
