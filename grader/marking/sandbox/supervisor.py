"""The parent of each confined process: starts it, watches its limits and reports how it ended."""

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

from grader.marking.sandbox import confinement, linux, mounts, separate_user
from grader.marking.sandbox.confinement import HOME, Confinement, Home
from grader.marking.sandbox.process_tree import TreeUsage, tree_usage
from grader.marking.sandbox.resource_limits import MB, ProcessEnd, ResourceLimits

WATCH_S = 0.25  # between two checks of a confined process
IDLE_CPU_S = 0.1  # of computing: with less, it has done nothing
CORES = 1.1  # that it may use over a longer time: with hundreds of threads it would have the whole machine
STDERR_BYTES = 4000  # of stderr that are reported
OUT_OF_MEMORY = 70  # the exit status of a confined process after an uncaught MemoryError

EntryFunction = Callable[[socket.socket], Any]


def supervise(entry: EntryFunction, wire: socket.socket, report: socket.socket, how: Confinement) -> NoReturn:
    """Start a confined process and watch it until it ends; for a fresh child of the fork server.

    Sends two messages over `report`: {} with its pidfd once it runs, or {"failed": why}; then its ProcessEnd.
    """
    try:
        _supervise(entry, wire, report, how)
    except Exception as error:
        report.send(json.dumps({"failed": str(error)}).encode())
    finally:
        os._exit(0)


def _supervise(entry: EntryFunction, wire: socket.socket, report: socket.socket, how: Confinement) -> None:
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    linux.die_with_parent(signal.SIGKILL)
    with confinement.home_folder(how) as home, tempfile.TemporaryFile() as stderr:
        if how.sandboxed:
            confinement.unshare_namespaces()
        processes = os.open("/proc", os.O_RDONLY)
        ready, answer = os.pipe()
        process = os.fork()
        if not process:
            _become_confined(entry, wire, answer, stderr, how, home)
        os.close(answer)
        wire.close()
        pidfd = os.pidfd_open(process)
        if problem := _problem(ready):
            os.waitpid(process, 0)
            raise OSError(problem)
        socket.send_fds(report, [b"{}"], [pidfd])
        reserved = _reserved_mb(process, processes)
        reason = _watch(process, pidfd, processes, how.limits, home)
        _, status, used = os.wait4(process, 0)
        end = describe(status, used, how.limits, reason, reserved)
        tail = _tail(stderr)
    report.send(json.dumps(vars(end) | {"stderr": tail}).encode())


def _problem(ready: int) -> str:
    """Wait until the new process is confined; return "" or what went wrong."""
    with os.fdopen(ready, "rb") as pipe:
        report = pipe.read()
    return "" if report == b"ready" else report.decode() or "the process died before it was confined"


def _watch(
    process: int, pidfd: int, processes: int, limits: ResourceLimits, home: Home = Home(HOME)  # noqa: B008
) -> str:
    """Return when the confined process has ended: the kind of limit for which it was killed, or "".

    See proc(5) for the fields of `stat`.
    """
    deadline = time.monotonic() + limits.wall_s
    poll = select.poll()
    poll.register(pidfd, select.POLLIN)
    since, before = time.monotonic(), 0.0
    while not poll.poll(1000 * WATCH_S):
        if home.user is not None and separate_user.too_many_files(home.user, home.path, limits):
            os.kill(process, signal.SIGKILL)
            return "disk"
        if limits.programs:
            usage = tree_usage(process, processes)
            if abs(usage.cpu_s - before) > IDLE_CPU_S:
                since, before = time.monotonic(), usage.cpu_s
            idle = "idle" if time.monotonic() - since > limits.idle_s else ""
            if reason := _tree_exceeded(usage, deadline, limits) or idle:
                os.kill(process, signal.SIGKILL)  # and with it all processes in its namespace
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


def _exceeded(cpu_s: float, threads: int, deadline: float, limits: ResourceLimits) -> str:
    """Return which limit is exceeded, or ""."""
    if cpu_s > limits.cpu_s:
        return "cpu"
    if threads > limits.threads:  # RLIMIT_NPROC does not hold for the real root
        return "threads"
    return "time" if time.monotonic() > deadline else ""


def _tree_exceeded(used: TreeUsage, deadline: float, limits: ResourceLimits) -> str:
    """The same for a process with all its descendants."""
    if used.memory_mb > limits.memory_mb:
        return "memory"
    return _exceeded(used.cpu_s, used.threads, deadline, limits)


def _reserved_mb(process: int, processes: int) -> float:
    """Return the size of its address space that has no physical memory."""
    size, resident, *_ = map(int, _read(f"{process}/statm", processes).split())
    return (size - resident) * resource.getpagesize() / MB


def _read(path: str, folder: int) -> bytes:
    with os.fdopen(os.open(path, os.O_RDONLY, dir_fd=folder), "rb") as file:
        return file.read()


def _tail(stderr: IO[bytes]) -> str:
    end = stderr.seek(0, os.SEEK_END)
    stderr.seek(max(0, end - STDERR_BYTES))
    return stderr.read(STDERR_BYTES).decode(errors="replace").strip()


def _become_confined(
    entry: EntryFunction, wire: socket.socket, answer: int, stderr: IO[bytes], how: Confinement, home: Home
) -> NoReturn:
    """Confine this process, then run the entry in it. Never returns."""
    code = 1
    try:
        try:
            if how.sandboxed:
                mounts.mount_all(how)
            wire, answer = confinement.close_other_descriptors(wire, answer, stderr)
            confinement.confine(how, home)
            os.write(answer, b"ready")
        except Exception as error:
            os.write(answer, str(error).encode())
        else:
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
        # Not sys.exit: destructors of C++ libraries wait for threads that a forked process does not have.
        for stream in (sys.stdout, sys.stderr):
            with contextlib.suppress(Exception):
                stream.flush()
        os._exit(code & 0xFF)


def describe(
    status: int, used: resource.struct_rusage, limits: ResourceLimits, reason: str, reserved_mb: float
) -> ProcessEnd:
    """Describe how a confined process ended, from wait4's result and the exceeded limit, `reason`, if any."""
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
        "idle": f"The process did nothing for more than the {limits.idle_s:g} s that are allowed.",
        "time": f"The process ran for more than the {limits.wall_s:g} s that are allowed.",
        "disk": f"The process wrote more than the {limits.scratch_files} files, or {limits.scratch_mb} MB, "
        "that are allowed.",
        "threads": f"The process had more than the {limits.threads} threads that are allowed.",
    }
    return ProcessEnd(kind, details[kind], code, round(cpu_s, 3), round(peak_mb, 1))


def _kind(code: int, space_mb: float, limits: ResourceLimits) -> str:
    if code == OUT_OF_MEMORY:
        return "memory"
    if code >= 0:
        return "exited"
    if code == -signal.SIGKILL:
        return "killed"
    # C++ code aborts when it gets no memory.
    return "memory" if space_mb > 0.9 * limits.memory_mb else "crashed"
