"""The process beside each inmate: it makes the inmate, watches its limits and reports how it ended."""

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

from grader.marking.sandbox import cell, linux
from grader.marking.sandbox.cell import Plan
from grader.marking.sandbox.limits import MB, Ending, Limits

WATCH_S = 0.25  # between two looks at an inmate
CORES = 1.1  # on which it may compute for long: with hundreds of threads it would have the whole machine
WORDS = 4000  # bytes of stderr that are reported
OUT_OF_MEMORY = 70  # the exit status of an inmate whose MemoryError nobody caught

Entry = Callable[[socket.socket], Any]


def keep(entry: Entry, wire: socket.socket, report: socket.socket, plan: Plan) -> NoReturn:
    """Be the keeper of one inmate from its start to its end; for a fresh child of the warden.

    Sends two messages over `report`: {} with a pidfd of the inmate once it runs, or {"failed": why}; then
    its Ending.
    """
    try:
        _keep(entry, wire, report, plan)
    except Exception as error:
        report.send(json.dumps({"failed": str(error)}).encode())
    finally:
        os._exit(0)


def _keep(entry: Entry, wire: socket.socket, report: socket.socket, plan: Plan) -> None:
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    linux.die_with_parent(signal.SIGKILL)
    with cell.folder(plan) as home, tempfile.TemporaryFile() as stderr:
        if plan.caged:
            cell.separate()
        processes = os.open("/proc", os.O_RDONLY)
        ready, answer = os.pipe()
        inmate = os.fork()
        if not inmate:
            _live(entry, wire, answer, stderr, plan, home)
        os.close(answer)
        wire.close()
        pidfd = os.pidfd_open(inmate)
        if problem := _problem(ready):
            os.waitpid(inmate, 0)
            raise OSError(problem)
        socket.send_fds(report, [b"{}"], [pidfd])
        reserved = _reserved_mb(inmate, processes)
        reason = _watch(inmate, pidfd, processes, plan.limits)
        _, status, used = os.wait4(inmate, 0)
        ending = describe(status, used, plan.limits, reason, reserved)
        words = _last_words(stderr)
    report.send(json.dumps(vars(ending) | {"words": words}).encode())


def _problem(ready: int) -> str:
    """Wait until the inmate is confined; return "" or what went wrong."""
    with os.fdopen(ready, "rb") as pipe:
        said = pipe.read()
    return "" if said == b"ready" else said.decode() or "the process died before it was confined"


def _watch(inmate: int, pidfd: int, processes: int, limits: Limits) -> str:
    """Return when the inmate has ended; if a limit made us end it, return the kind of its end.

    See proc(5) for the fields of `stat`.
    """
    deadline = time.monotonic() + limits.wall_s
    poll = select.poll()
    poll.register(pidfd, select.POLLIN)
    since, before = time.monotonic(), 0.0
    while not poll.poll(1000 * WATCH_S):
        fields = _read(f"{inmate}/stat", processes).rpartition(b")")[2].split()
        used = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
        if reason := _exceeded(used, int(fields[17]), deadline, limits):
            os.kill(inmate, signal.SIGKILL)
            return reason
        pause = (used - before) / CORES - (time.monotonic() - since)
        if pause > 0:
            os.kill(inmate, signal.SIGSTOP)
            poll.poll(1000 * pause)
            os.kill(inmate, signal.SIGCONT)
        since, before = time.monotonic(), used
    return ""


def _exceeded(cpu_s: float, threads: int, deadline: float, limits: Limits) -> str:
    """Return which limit does not hold any more, or ""."""
    if cpu_s > limits.cpu_s:
        return "cpu"
    if threads > limits.threads:  # RLIMIT_NPROC does not bind the real root
        return "threads"
    return "time" if time.monotonic() > deadline else ""


def _reserved_mb(inmate: int, processes: int) -> float:
    """Return how much address space it has without memory behind it."""
    size, resident, *_ = map(int, _read(f"{inmate}/statm", processes).split())
    return (size - resident) * resource.getpagesize() / MB


def _read(path: str, folder: int) -> bytes:
    with os.fdopen(os.open(path, os.O_RDONLY, dir_fd=folder), "rb") as file:
        return file.read()


def _last_words(stderr: IO[bytes]) -> str:
    end = stderr.seek(0, os.SEEK_END)
    stderr.seek(max(0, end - WORDS))
    return stderr.read(WORDS).decode(errors="replace").strip()


def _live(
    entry: Entry, wire: socket.socket, answer: int, stderr: IO[bytes], plan: Plan, home: str
) -> NoReturn:
    """Become the inmate: be confined, then run the entry. Never returns."""
    code = 1
    try:
        try:
            if plan.caged:
                cell.furnish(plan)
            wire, answer = cell.keep_only(wire, answer, stderr)
            cell.confine(plan, home)
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
    """Tell how an inmate ended, from what wait4 says and the limit that was the `reason`, if any."""
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
