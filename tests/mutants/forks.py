"""Functions that run in forks of this process, so that whatever they change is gone afterwards."""

from __future__ import annotations

import contextlib
import os
import pickle
import resource
import signal
import traceback
from collections.abc import Callable
from typing import Any

PROCESSES = 2
MEMORY = 4 << 30  # bytes that a fork may take
WAITING = 5  # times as long a fork may take as it may compute


def result_of(function: Callable[[], Any]) -> Any:
    """What a function returns that runs in a fork. Raises RuntimeError if it raises or ends its process."""
    reading, writing = os.pipe()
    child = os.fork()
    if not child:
        os.close(reading)
        _be_quiet()
        with contextlib.suppress(BaseException):
            _send(writing, function)
        os._exit(0)
    os.close(writing)
    with open(reading, "rb") as pipe:
        data = pipe.read()
    os.waitpid(child, 0)
    found, problem = pickle.loads(data) if data else (None, "Its process ended.")
    if problem:
        raise RuntimeError(problem)
    return found


def _send(writing: int, function: Callable[[], Any]) -> None:
    try:
        found = function(), ""
    except BaseException:
        found = None, traceback.format_exc()
    with open(writing, "wb") as pipe:
        pickle.dump(found, pipe)


def truths(functions: dict[int, Callable[[], bool]], seconds: float) -> dict[int, bool]:
    """Which of these functions return True in forks, two at a time. One that raises or doesn't end doesn't.

    seconds: of computing that each may take.
    """
    found: dict[int, bool] = {}
    running: dict[int, int] = {}
    waiting = list(functions.items())
    while waiting or running:
        while waiting and len(running) < PROCESSES:
            name, function = waiting.pop(0)
            child = os.fork()
            if not child:
                _exit_with(function, round(seconds) + 1)
            running[child] = name
        child, status = os.waitpid(-1, 0)
        if child in running:
            found[running.pop(child)] = status == 0
            with contextlib.suppress(ProcessLookupError):
                os.killpg(child, signal.SIGKILL)  # what it has started and left behind
    return found


def _exit_with(function: Callable[[], bool], seconds: int) -> None:
    status = 1
    with contextlib.suppress(BaseException):
        os.setsid()
        _be_quiet()
        signal.signal(signal.SIGALRM, signal.SIG_DFL)
        signal.alarm(WAITING * seconds)
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
        resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, MEMORY))
        status = 0 if function() else 1
    os._exit(status)


def _be_quiet() -> None:
    nowhere = os.open(os.devnull, os.O_RDWR)
    for number in (0, 1, 2):
        os.dup2(nowhere, number)
