"""The process beside each confined one: makes it, watches its limits and reports how it ended."""

import contextlib
import json
import os
import resource
import select
import signal
import socket
import sys
import tempfile
import time
import traceback
from collections.abc import Callable
from typing import IO, Any, NoReturn

from grader.marking.sandbox import linux, walls
from grader.marking.sandbox.family import used_by
from grader.marking.sandbox.limits import MB, Ending, Limits
from grader.marking.sandbox.walls import Confinement

WATCH_S = 0.25  # between two looks at a confined process
CORES = 1.1  # on which it may compute for long: with hundreds of threads it would have the whole machine
WORDS = 4000  # bytes of stderr that are reported
OUT_OF_MEMORY = 70  # the exit status of a confined process whose MemoryError nobody caught

EntryFunction = Callable[[socket.socket], Any]


def supervise(
    entry: EntryFunction, wire: socket.socket, report: socket.socket, confinement: Confinement
) -> NoReturn:
    """Start a confined process and stay until its end; for a fresh child of the fork server.

    Sends two messages over `report`: {} with its pidfd once it runs, or {"failed": why}; then its Ending.
    """
    try:
        _supervise(entry, wire, report, confinement)
    except Exception as error:
        report.send(json.dumps({"failed": str(error)}).encode())
    finally:
        os._exit(0)


def _supervise(
    entry: EntryFunction, wire: socket.socket, report: socket.socket, confinement: Confinement
) -> None:
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    linux.die_with_parent(signal.SIGKILL)
    with walls.folder(confinement) as home, tempfile.TemporaryFile() as stderr:
        if confinement.sandboxed:
            walls.separate()
        processes = os.open("/proc", os.O_RDONLY)
        ready, answer = os.pipe()
        process = os.fork()
        if not process:
            _become_confined(entry, wire, answer, stderr, confinement, home)
        os.close(answer)
        wire.close()
        pidfd = os.pidfd_open(process)
        if problem := _problem(ready):
            os.waitpid(process, 0)
            raise OSError(problem)
        socket.send_fds(report, [b"{}"], [pidfd])
        reserved = _reserved_mb(process, processes)
        reason = _watch(process, pidfd, processes, confinement.limits)
        _, status, used = os.wait4(process, 0)
        ending = describe(status, used, confinement.limits, reason, reserved)
        words = _last_words(stderr)
    report.send(json.dumps(vars(ending) | {"words": words}).encode())


def _problem(ready: int) -> str:
    """Wait until the confined process is confined; return "" or what went wrong."""
    with os.fdopen(ready, "rb") as pipe:
        said = pipe.read()
    return "" if said == b"ready" else said.decode() or "the process died before it was confined"


def _watch(process: int, pidfd: int, processes: int, limits: Limits) -> str:
    """Return when the confined process has ended; if a limit made us end it, return the kind of its end.

    See proc(5) for the fields of `stat`.
    """
    deadline = time.monotonic() + limits.wall_s
    poll = select.poll()
    poll.register(pidfd, select.POLLIN)
    since, before = time.monotonic(), 0.0
    while not poll.poll(1000 * WATCH_S):
        if limits.programs:
            if reason := _family_exceeded(process, processes, deadline, limits):
                os.kill(process, signal.SIGKILL)  # and with it all in its namespace
                return reason
            continue
        fields = _read(f"{process}/stat", processes).rpartition(b")")[2].split()
        used = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
        if reason := _exceeded(used, int(fields[17]), deadline, limits):
            os.kill(process, signal.SIGKILL)
            return reason
        pause = (used - before) / CORES - (time.monotonic() - since)
        if pause > 0:
            os.kill(process, signal.SIGSTOP)
            poll.poll(1000 * pause)
            os.kill(process, signal.SIGCONT)
        since, before = time.monotonic(), used
    return ""


def _exceeded(cpu_s: float, threads: int, deadline: float, limits: Limits) -> str:
    """Return which limit does not hold any more, or ""."""
    if cpu_s > limits.cpu_s:
        return "cpu"
    if threads > limits.threads:  # RLIMIT_NPROC does not bind the real root
        return "threads"
    return "time" if time.monotonic() > deadline else ""


def _family_exceeded(process: int, processes: int, deadline: float, limits: Limits) -> str:
    """The same for a process with all that it started."""
    used = used_by(process, processes)
    if used.memory_mb > limits.memory_mb:
        return "memory"
    return _exceeded(used.cpu_s, used.threads, deadline, limits)


def _reserved_mb(process: int, processes: int) -> float:
    """Return how much address space it has without memory behind it."""
    size, resident, *_ = map(int, _read(f"{process}/statm", processes).split())
    return (size - resident) * resource.getpagesize() / MB


def _read(path: str, folder: int) -> bytes:
    with os.fdopen(os.open(path, os.O_RDONLY, dir_fd=folder), "rb") as file:
        return file.read()


def _last_words(stderr: IO[bytes]) -> str:
    end = stderr.seek(0, os.SEEK_END)
    stderr.seek(max(0, end - WORDS))
    return stderr.read(WORDS).decode(errors="replace").strip()


def _become_confined(
    entry: EntryFunction,
    wire: socket.socket,
    answer: int,
    stderr: IO[bytes],
    confinement: Confinement,
    home: str,
) -> NoReturn:
    """Become the confined process: be confined, then run the entry. Never returns."""
    code = 1
    try:
        try:
            if confinement.sandboxed:
                walls.furnish(confinement)
            wire, answer = walls.keep_only(wire, answer, stderr)
            walls.confine(confinement, home)
            os.write(answer, b"ready")
        except Exception as error:
            os.write(answer, str(error).encode())
            return  # the `finally` below ends the process
        os.close(answer)
        entry(wire)
        code = 0
    except SystemExit as error:
        code = error.code if isinstance(error.code, int) else int(error.code is not None)
    except MemoryError:
        code = OUT_OF_MEMORY
    except BaseException:
        traceback.print_exc()
    finally:
        # Not sys.exit: destructors of C++ libraries wait for threads that are not in a forked process.
        for stream in (sys.stdout, sys.stderr):
            with contextlib.suppress(Exception):
                stream.flush()
        os._exit(code & 0xFF)


def describe(
    status: int, used: resource.struct_rusage, limits: Limits, reason: str, reserved_mb: float
) -> Ending:
    """Tell how a confined process ended, from what wait4 says and the limit that was the `reason`, if any."""
    code = os.waitstatus_to_exitcode(status)
    cpu_s = used.ru_utime + used.ru_stime
    peak_mb = used.ru_maxrss * 1024 / MB
    kind = reason or _kind(code, peak_mb + reserved_mb, limits)
    details = {
        "exited": "The process ended by itself" + (f", with exit status {code}." if code else "."),
        "killed": "The process was killed from outside.",
        "crashed": f"The process crashed: {signal.strsignal(-code) if code < 0 else ''}.",
        "memory": f"The process needed more than the {limits.memory_mb} MB of memory that are allowed.",
        "cpu": f"The process computed for more than the {limits.cpu_s} s that are allowed.",
        "time": f"The process ran for more than the {limits.wall_s:g} s that are allowed.",
        "threads": f"The process had more than the {limits.threads} threads that are allowed.",
    }
    return Ending(kind, details[kind], code, round(cpu_s, 3), round(peak_mb, 1))


def _kind(code: int, space_mb: float, limits: Limits) -> str:
    if code == OUT_OF_MEMORY:
        return "memory"
    if code >= 0:
        return "exited"
    if code == -signal.SIGKILL:
        return "killed"
    # C++ code that gets no memory aborts.
    return "memory" if space_mb > 0.9 * limits.memory_mb else "crashed"
