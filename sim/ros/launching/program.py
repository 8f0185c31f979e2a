"""What carries out a launch file in a run: a program of it, which starts the others at their times.

All programs of a run share one environment and one folder, and no output is hidden: `output` counts for
nothing. Modules that a program imports from its own package or folder are its own.
"""

from __future__ import annotations

import asyncio
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
from sim.ros.launching.programs import SimProcessStarter


def launched(target: Any) -> Any:
    """A program that carries out a launch file, where `target` is one, or a Process of one; else `target`.

    A text is what stands after `ros2 launch`, if a file of such a kind is in it: a path, or a package and a
    file; then NAME:=VALUE. A LaunchDescription is one, too. The arguments of a Process are further words.
    """
    spec = target if isinstance(target, Process) else Process(target)
    inner = spec.target
    if isinstance(inner, Path):
        return replace(spec, target=_launch(_included, [str(inner)]))
    if isinstance(inner, str):
        words = [inner] if os.path.isfile(inner) else shlex.split(inner)
        if any(Path(word).suffix in files.KINDS for word in words[:2]):
            return replace(spec, target=_launch(_included, words))
    if _is_description(inner):
        return replace(spec, target=_launch(lambda said: inner, []))
    return target


def _is_description(target: Any) -> bool:
    kind = getattr(sys.modules.get("launch"), "LaunchDescription", None)
    return kind is not None and isinstance(target, kind)


def _included(words: Sequence[str]) -> Any:
    path, rest = files.found(words)
    return files.description(path, rest)


def _launch(described: Callable[[Sequence[str]], Any], words: list[str]) -> Callable[[], None]:
    def launch() -> None:
        _check_whose()
        _carry_out(described([*words, *sys.argv[1:]]))

    return launch


def _check_whose() -> None:
    """Raise RuntimeError where the installed launch can't be led through a run."""
    import launch  # here, for it takes a while, and most runs do without

    try:
        from launch.processes import ProcessStarter  # noqa: F401  (only the course's launch has it)
    except ImportError:
        raise RuntimeError(
            f"`launch` is that of a ROS installation ({launch.__file__}), which starts real processes: "
            "use `ros2 launch`, or run this where no installation is sourced."
        ) from None


def _carry_out(description: Any) -> None:
    """Carry it out until all its programs have ended. Raises what it fails with."""
    from launch import LaunchService
    from launch.logging import redirect_log

    run = engine()
    path = list(sys.path)
    with redirect_log(run.logged):
        service = LaunchService(noninteractive=True)
        programs = service.context.process_starter = SimProcessStarter(run)
        service.include_launch_description(description)
        try:
            asyncio.run(service.run_async())
        finally:
            sys.path[:] = path
    failure = programs.refused or service.failure
    if failure is not None:
        raise failure
