"""A program that is killed in the middle of a run and started again, as a launch file with `respawn` does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from sim.nanoseconds import SECOND
from sim.ros.engine.program import Process, program_name
from sim.ros.fibers.exceptions import RunOver
from sim.ros.fibers.scheduler import engine

_GOLDEN = 0.618034  # its multiples, without their whole parts, are never near each other


def respawned(program: Any, earliest: float, latest: float, delay: float) -> Callable[[], None]:
    """This program, killed at a moment (s) between two, and back after `delay` (s).

    The remappings with which it is started hold for the program, both times.
    Of several programs of a run each has a moment of its own, and it is the same in every run.
    """
    spec = program if isinstance(program, Process) else Process(program)

    def lives() -> None:
        run = engine()
        here = run.current.process
        alike = replace(spec, remappings=[*spec.remappings, *here.spec.remappings])
        number = [process for process in run.processes if process.from_course == here.from_course].index(here)
        first = run.start(alike, from_course=here.from_course)
        _pass(earliest + (latest - earliest) * ((0.5 + number * _GOLDEN) % 1.0))
        kill(run, first)
        _pass(delay)
        second = run.start(alike, from_course=first.from_course)
        while run.lives(second):
            _pass(0.1)

    lives.__name__ = program_name(spec.target)
    return lives


def kill(run: Any, process: Any) -> None:
    """End a program of the run at once, as SIGKILL does."""
    for fiber in run.fibers:
        if fiber.process is process and not fiber.done:
            fiber.thrown = RunOver()


def _pass(seconds: float) -> None:
    run = engine()
    run.wait("time", until=run.now + round(seconds * SECOND))
