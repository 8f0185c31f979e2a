"""Kills a program during a run and starts it again, as a launch file with `respawn` does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from sim.nanoseconds import SECOND
from sim.ros.engine.program import Process, program_name
from sim.ros.fibers.exceptions import RunOver
from sim.ros.fibers.scheduler import engine

_GOLDEN = 0.618034  # the fractional parts of its multiples are never close to each other


def respawned(program: Any, earliest: float, latest: float, delay: float) -> Callable[[], None]:
    """This program, killed once between two times (s), and started again after `delay` (s).

    The returned program's remappings apply to both starts. Several programs of a run are killed at different
    times, which are equal in every run.
    """
    spec = program if isinstance(program, Process) else Process(program)

    def body() -> None:
        run = engine()
        process = run.current.process
        restarted = replace(spec, remappings=[*spec.remappings, *process.spec.remappings])
        number = [each for each in run.programs if each.from_course == process.from_course].index(process)
        first = run.start(restarted, from_course=process.from_course)
        _sleep(earliest + (latest - earliest) * ((0.5 + number * _GOLDEN) % 1.0))
        kill(run, first)
        _sleep(delay)
        second = run.start(restarted, from_course=first.from_course)
        while run.lives(second):
            _sleep(0.1)

    body.__name__ = program_name(spec.target)
    return body


def kill(run: Any, process: Any) -> None:
    """End a program of the run immediately, as SIGKILL does."""
    for fiber in run.fibers:
        if fiber.process is process and not fiber.done:
            fiber.thrown = RunOver()


def interrupt(process: Any) -> None:
    """Interrupt a program of the run, as Ctrl-C in its terminal does."""
    process.shut_down()
    process.main.thrown = KeyboardInterrupt()


def _sleep(seconds: float) -> None:
    run = engine()
    run.wait("time", until=run.now + round(seconds * SECOND))
