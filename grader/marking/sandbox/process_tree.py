"""Measures what a confined process and all its descendants use together."""

from __future__ import annotations

import contextlib
import os
import resource
from dataclasses import dataclass

TICKS = os.sysconf("SC_CLK_TCK")
MB = 1024 * 1024


@dataclass
class TreeUsage:
    """CPU seconds, including those of children that ended; threads and MB of memory of running processes."""

    cpu_s: float = 0.0
    threads: int = 0
    memory_mb: float = 0.0


def tree_usage(process: int, processes: int) -> TreeUsage:
    """Measure a process and its descendants. processes: an open /proc. See proc(5) for `stat`."""
    fields: dict[int, list[bytes]] = {}
    children: dict[int, list[int]] = {}
    for name in os.listdir(processes):
        with contextlib.suppress(OSError, ValueError):  # it may have ended
            stat = _read(f"{int(name)}/stat", processes).rpartition(b")")[2].split()
            fields[int(name)] = stat
            children.setdefault(int(stat[1]), []).append(int(name))
    whole, left = TreeUsage(), [process]
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
