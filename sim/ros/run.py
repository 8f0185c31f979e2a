"""The door of the engine: run nodes, get a recording."""

from __future__ import annotations

import asyncio
import contextlib
import gc
import random
import sys
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import rosidl_generator_py  # noqa: F401  (rclpy imports it with the first message: 0.1 s that no run should pay)

from sim.recording import Ended, Recording
from sim.ros import hooks
from sim.ros.capture import file_descriptor_2, student_streams
from sim.ros.engine import Engine
from sim.ros.fibers import SECOND, active, outside_student_code
from sim.ros.machines import machines
from sim.ros.processes import Process, as_process
from sim.world import World, simulate

ECHO_LINES = 100  # shown of what nodes log and print; the recording has all of it
ECHO_CHARACTERS = 20_000


def run(
    *nodes: Any,
    world: str | World | None = None,
    seconds: float = 10.0,
    seed: int = 0,
    until: Callable[[Recording], bool] | None = None,
    quiet: bool = False,
) -> Recording:
    """Run ROS 2 nodes in simulated time, and return the evidence of what they did.

    nodes: Node classes, functions that return a Node or a Process, main() functions, or `Process` objects.
        All run side by side, as programs of their own; what one raises or hangs in is in the recording and
        never raised here.
    world: name of a world or a World, with a robot in it that hears /cmd_vel; None for no robot.
    seconds: simulated time at which the run ends at the latest.
    seed: for the sensors' noise, and for `random` and numpy's generators in the nodes.
    until: called with the recording so far whenever time is about to move on; the run ends when it returns
    True.
    quiet: don't show what the nodes log and print.

    Equal nodes, world and seed give equal recordings. Raises TypeError or ValueError for arguments that
    can't be run, WorldError for a bad world, KeyboardInterrupt when the user interrupts.
    """
    specs = [as_process(node) for node in nodes]
    if active() is not None:
        raise RuntimeError("run() is running already: a node can't start another run.")
    if not 0 < seconds < 1e6:
        raise ValueError(f"seconds must be more than 0 and less than a million; it is {seconds!r}.")
    if not isinstance(seed, int) or seed < 0:
        raise ValueError(f"seed must be a whole number, 0 or more; it is {seed!r}.")
    world = World.load(world) if isinstance(world, str) else world
    recording = Recording(world=world, seconds=float(seconds), seed=seed)
    for spec in specs:
        hooks.rebind(_names_around(spec.target))
    with _own_process():
        interrupted = _lockstep(recording, specs, until, quiet)
    if interrupted:
        raise KeyboardInterrupt("The run was interrupted.")
    return recording


def _names_around(target: Any) -> dict[str, Any]:
    """The global names that a class or function sees, as far as that can be asked."""
    try:
        return getattr(target, "__globals__", None) or vars(sys.modules[target.__module__])
    except Exception:  # a student's class may answer such questions in any way
        return {}


def _lockstep(
    recording: Recording, specs: list[Process], until: Callable[[Recording], bool] | None, quiet: bool
) -> bool:
    """Fill the recording; whether the user interrupted."""
    world, engine = recording.world, Engine(recording, recording.seed)
    scene = simulate(world, recording.seed) if world is not None else None
    with _seeded(recording.seed), _watched(engine, quiet):
        for spec in machines(scene, recording) if scene is not None else []:
            engine.start(spec)
        watched = [engine.start(spec) for spec in specs]
        recording.ended = engine.run_until(round(recording.seconds * SECOND), until, watched)
    return engine.guard.interrupted


@contextlib.contextmanager
def _seeded(seed: int) -> Iterator[None]:
    before = random.getstate(), np.random.get_state()
    random.seed(seed)
    np.random.seed(seed % 2**32)
    try:
        yield
    finally:
        random.setstate(before[0])
        np.random.set_state(before[1])


@contextlib.contextmanager
def _own_process() -> Iterator[None]:
    """Hide from the nodes what a program of their own would not find.

    A notebook's kernel runs an event loop, with which asyncio.run() fails. And its heap is large: one full
    look of the garbage collector takes 0.2 s. So the collector looks only at what the run has made; at its
    end in full, for rclpy's nodes are full of cycles.
    """
    loop = asyncio._get_running_loop()
    asyncio._set_running_loop(None)
    gc.freeze()
    try:
        yield
    finally:
        gc.collect()
        gc.unfreeze()
        asyncio._set_running_loop(loop)


@contextlib.contextmanager
def _watched(engine: Engine, quiet: bool) -> Iterator[None]:
    show = _Screen(quiet)
    engine.echo = show

    with (
        file_descriptor_2(engine.recorder.complained),
        student_streams(),
        engine.guard.watch(),
        engine,
    ):
        yield
    show.close()


class _Screen:
    """Shows the first lines of what nodes say, on stdout: nbgrader takes any text on stderr for a failure."""

    def __init__(self, quiet: bool) -> None:
        self.quiet, self.stream = quiet, sys.stdout
        self.lines = self.characters = 0

    def __call__(self, text: str) -> None:
        if not self.quiet and self.lines < ECHO_LINES and self.characters < ECHO_CHARACTERS:
            with outside_student_code():
                self.stream.write(text[:ECHO_CHARACTERS])
        self.lines += text.count("\n")
        self.characters += len(text)

    def close(self) -> None:
        if not self.quiet and self.lines > ECHO_LINES:
            self.stream.write(f"... and {self.lines - ECHO_LINES} more lines, all in the recording\n")


__all__ = ["Ended", "Process", "run"]
