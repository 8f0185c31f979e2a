"""Executes a launch file in a run: a program of the run, which starts the others in simulated time.

All programs of a run share one environment and one working directory, and `output` has no effect: all output
is shown. Each program imports its own copies of the modules in its package or folder.
"""

from __future__ import annotations

import asyncio
import functools
import os
import shlex
import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from sim.ros.engine.program import Process
from sim.ros.fibers.scheduler import engine
from sim.ros.launching import files
from sim.ros.launching.sim_processes import SimProcessStarter


def as_launch_program(target: Any) -> Any:
    """A program that executes `target`, if that is a launch file or a Process of one; else `target` itself.

    A launch file is a Path, a text with the arguments of `ros2 launch` (a path, or a package and a file; then
    NAME:=VALUE), or a LaunchDescription. The arguments of a Process are further launch arguments.
    """
    _provide_starter()
    spec = target if isinstance(target, Process) else Process(target)
    inner = spec.target
    if isinstance(inner, Path):
        return replace(spec, target=_launch_main(_load, [str(inner)]))
    if isinstance(inner, str):
        arguments = [inner] if os.path.isfile(inner) else shlex.split(inner)
        if any(Path(argument).suffix in files.SUFFIXES for argument in arguments[:2]):
            return replace(spec, target=_launch_main(_load, arguments))
    if _is_description(inner):
        return replace(spec, target=_launch_main(lambda arguments: inner, []))
    return target


def _is_description(target: Any) -> bool:
    kind = getattr(sys.modules.get("launch"), "LaunchDescription", None)
    return kind is not None and isinstance(target, kind)


def _load(arguments: Sequence[str]) -> Any:
    path, rest = files.find_launch_file(arguments)
    return files.load_description(path, rest)


def _launch_main(load: Callable[[Sequence[str]], Any], arguments: list[str]) -> Callable[[], None]:
    def launch() -> None:
        _check_launch_package()
        _execute(load([*arguments, *sys.argv[1:]]))

    return launch


def _check_launch_package() -> None:
    """Raise RuntimeError if `launch` is that of a ROS installation, which can't use simulated time."""
    import launch  # imported late, because it is slow and few runs need it

    try:
        from launch.processes import ProcessStarter  # noqa: F401  (only the course's launch has it)
    except ImportError:
        raise RuntimeError(
            f"`launch` is that of a ROS installation ({launch.__file__}), which starts real processes: "
            "use `ros2 launch`, or run this where no installation is sourced."
        ) from None


def _execute(description: Any) -> None:
    """Execute a launch description until all its programs have exited. Raises its first error."""
    from launch import LaunchService

    path = list(sys.path)
    service = LaunchService(noninteractive=True)
    starter = service.context.process_starter
    service.include_launch_description(description)
    try:
        asyncio.run(service.run_async())
    finally:
        sys.path[:] = path
    failure = starter.error or service.failure
    if failure is not None:
        raise failure


def _starter_in_a_run() -> SimProcessStarter | None:
    """The process starter of a launch context that a program of a run creates; None outside a run."""
    run = engine()
    return None if run is None else SimProcessStarter(run)


@functools.cache
def _provide_starter() -> None:
    """Let new launch contexts in any program of a run start simulated programs."""
    from launch_process_starters import providers  # imported late: `sim` can be imported without it

    providers.append(_starter_in_a_run)
