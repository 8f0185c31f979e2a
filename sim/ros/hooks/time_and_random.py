"""Python's clocks, its random generators, and the few calls that would end or block the whole process."""

from __future__ import annotations

import builtins
import os
import sched
import signal
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy.random

from sim.nanoseconds import SECOND, UPTIME, nanoseconds
from sim.ros.fibers.scheduler import engine
from sim.ros.hooks.table import hook

# Python's numbers of clocks that show the time of day, and computing time; the others count from the start of
# the machine.
OF_DAY = time.CLOCK_REALTIME, time.CLOCK_TAI
COMPUTING = time.CLOCK_PROCESS_CPUTIME_ID, time.CLOCK_THREAD_CPUTIME_ID


@hook(time, "sleep", "sleeping takes simulated time")
def sleep(original: Callable) -> Callable:
    def sleep(seconds: float) -> None:
        run = engine()
        if run is None:
            return original(seconds)
        if seconds < 0:
            raise ValueError("sleep length must be non-negative")
        if seconds == 0:
            run.count_call("looks at a clock")
        run.wait(f"time.sleep({seconds:g})", until=run.now + nanoseconds(seconds))
        return None

    return sleep


def _clock(name: str, of_day: bool, convert: Callable[[int], Any]) -> None:
    @hook(time, name, "Python's clocks show simulated time")
    def clock(original: Callable) -> Callable:
        def read() -> Any:
            run = engine()
            if run is None:
                return original()
            run.count_call("looks at a clock")
            return convert((run.epoch if of_day else UPTIME) + run.now)

        return read


for _name in ("time", "monotonic", "perf_counter"):
    _clock(_name, _name == "time", lambda nanoseconds: nanoseconds / SECOND)
    _clock(f"{_name}_ns", _name == "time", int)


def _clock_by_number(name: str, convert: Callable[[int], Any]) -> None:
    @hook(time, name, "Python's clocks show simulated time")
    def clock(original: Callable) -> Callable:
        def read(number: int, /) -> Any:
            run = engine()
            if run is None:
                return original(number)
            run.count_call("looks at a clock")
            start = run.epoch if number in OF_DAY else 0 if number in COMPUTING else UPTIME
            return convert(run.now + start)

        return read


_clock_by_number("clock_gettime", lambda nanoseconds: nanoseconds / SECOND)
_clock_by_number("clock_gettime_ns", int)


def _computing_time(name: str) -> None:
    @hook(time, name, "computing time differs from run to run")
    def clock(original: Callable) -> Callable:
        def read() -> float:
            run = engine()
            return original() if run is None else run.now / SECOND

        return read


def _calendar(name: str) -> None:
    @hook(time, name, "without an argument it means now")
    def convert(original: Callable) -> Callable:
        def at(seconds: float | None = None) -> Any:
            run = engine()
            if seconds is None and run is not None:
                seconds = (run.epoch + run.now) / SECOND
            return original(seconds)

        return at


for _name in ("process_time", "thread_time"):
    _computing_time(_name)
for _name in ("gmtime", "localtime", "ctime"):
    _calendar(_name)


@hook(time, "strftime", "without a time it means now")
def strftime(original: Callable) -> Callable:
    def strftime(form: str, *moment: Any) -> str:
        run = engine()
        if run is not None and not moment:
            moment = (time.localtime(),)
        return original(form, *moment)

    return strftime


@hook(os, "urandom", "uuid4(), and with it every action goal's id, must be the same in every run")
def urandom(original: Callable) -> Callable:
    def urandom(size: int) -> bytes:
        run = engine()
        return original(size) if run is None else run.random.bytes(size)

    return urandom


@hook(numpy.random, "default_rng", "a generator without a seed takes the run's")
def default_rng(original: Callable) -> Callable:
    def default_rng(seed: Any = None) -> numpy.random.Generator:
        run = engine()
        if seed is None and run is not None:
            seed = int.from_bytes(run.random.bytes(8), "little")
        return original(seed)

    return default_rng


@hook(builtins, "input", "the lines are those that the program was given, not the user's keyboard")
def read_input(original: Callable) -> Callable:
    def input(*prompt: Any) -> str:
        if engine() is None:
            return original(*prompt)
        line = sys.stdin.readline()
        print(*prompt, end="", flush=True)
        if not line:
            raise EOFError("EOF when reading a line")
        return line.removesuffix("\n")

    return input


@hook(os, "_exit", "it would end the notebook's kernel, not the node")
def exit_now(original: Callable) -> Callable:
    def _exit(status: int) -> None:
        if engine() is None:
            original(status)
        raise SystemExit(status)

    return _exit


@hook(sched.scheduler, "__init__", "it bound its clock and its sleep before there were hooks")
def scheduler_init(original: Callable) -> Callable:
    def __init__(
        self: sched.scheduler, timefunc: Callable | None = None, delayfunc: Callable | None = None
    ) -> None:
        original(self, timefunc or time.monotonic, delayfunc or time.sleep)  # noqa: TID251 (the hook)

    return __init__


def _ignored(name: str, reason: str, result: Any) -> None:
    @hook(signal, name, reason)
    def ignore(original: Callable) -> Callable:
        def replacement(*arguments: Any, **keywords: Any) -> Any:
            return original(*arguments, **keywords) if engine() is None else result

        return replacement


_ignored("signal", "signal handlers belong to the kernel, and the run needs its own", signal.SIG_DFL)
_ignored("alarm", "the run's own guard uses this timer", 0)
_ignored("setitimer", "the run's own guard uses this timer", (0.0, 0.0))
