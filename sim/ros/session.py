"""One run that is advanced bit by bit; while it is paused, the user's own code sees nothing of it."""

from __future__ import annotations

import contextlib
import math
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rclpy.node import Node

from sim.evidence import Ended, Recording
from sim.nanoseconds import EPOCH, SECOND, Nanoseconds
from sim.network import Network
from sim.notebook.run_programs import remember_programs
from sim.order import Order
from sim.ros.engine.capture import FileDescriptor2, Screen, student_streams
from sim.ros.engine.engine import Engine, never
from sim.ros.engine.main_loop import MainLoop
from sim.ros.engine.preemption import Preemption
from sim.ros.engine.process_state import ProcessState, SeededRandom
from sim.ros.engine.program import Process, as_process
from sim.ros.engine.running_program import RunningProgram
from sim.ros.fibers.scheduler import active
from sim.ros.ground_truth import GroundTruth
from sim.ros.hooks.install import rebind
from sim.ros.launching.launch_program import as_launch_program
from sim.ros.robots.world_programs import programs_of
from sim.world import World

if TYPE_CHECKING:
    from sim.ros.bags.played import PlayedBag

SECONDS = 10.0  # that a run lasts without a bag
FOREVER: Nanoseconds = 2**63
_turn = threading.RLock()  # a process has one of everything: runs in several threads execute in turns


class Session:
    """A run in progress. Where it is paused changes nothing in its recording.

    The arguments are those of `run`; caller: the name of the function that the user called, for messages.
    Raises TypeError or ValueError for arguments that can't be run, WorldError for a bad world.
    """

    def __init__(
        self,
        nodes: tuple[Any, ...],
        world: str | World | None,
        seconds: float | None,
        seed: int,
        until: Callable[[Recording], bool] | None,
        quiet: bool,
        caller: str = "run",
        companions: Sequence[Any] = (),
        network: Network | None = None,
        order: int | str = 0,
        bag: str | Path | None = None,
    ) -> None:
        self._companions = [as_process(node, caller) for node in companions]
        self._specs = [as_process(as_launch_program(node), caller) for node in nodes]
        working = active()
        if working is not None and working.thread == threading.get_ident():
            raise RuntimeError(
                f"{caller}() can't start another run here: this is a node of a run in progress."
            )
        played = self._played(bag, world, caller)
        if seconds is None:
            seconds = SECONDS if played is None else played.seconds
        if not 0 < seconds < 1e6:
            raise ValueError(f"seconds must be more than 0 and less than a million; it is {seconds!r}.")
        if not isinstance(seed, int) or seed < 0:
            raise ValueError(f"seed must be a whole number, 0 or more; it is {seed!r}.")
        if not isinstance(network, Network | None):
            raise TypeError(f"network must be a Network, such as Network(loss=0.2); it is {network!r}.")
        world = World.load(world) if isinstance(world, str) else world
        epoch = EPOCH if played is None else played.epoch
        chosen = str(Order.parse(order) or "")
        self.recording = Recording(world, float(seconds), seed, network=network, order=chosen, epoch=epoch)
        remember_programs(self.recording, [spec.target for spec in self._specs])
        self.truth: GroundTruth | None = None  # while the run lasts, if it has a world
        self.engine: Engine | None = None
        self.warning = ""  # what the live picture has to tell the user
        self.over = self._interrupted = False
        self._until = until
        self._loop: MainLoop | None = None
        self._preemption: Preemption | None = None  # in another order than the usual one
        if Preemption.is_needed(chosen):
            self._preemption = Preemption([spec.target for spec in self._specs])
        self._reached: Nanoseconds = 0  # up to which all is done
        self._process, self._random, self._stderr = ProcessState(), SeededRandom(seed), FileDescriptor2()
        self._screen = Screen(quiet)
        self._thread = threading.get_ident()  # greenlets can't move to another

    @property
    def stamp(self) -> float:
        """Simulated seconds of the last step."""
        return self.recording.stamp if self.engine is None else self.engine.recorder.now

    @property
    def interrupted(self) -> bool:
        """Return whether the user has interrupted the run while it executed."""
        return self._interrupted or (self.engine is not None and self.engine.guard.interrupted)

    @property
    def elsewhere(self) -> bool:
        """Return whether it belongs to another thread than the caller's."""
        return self._thread != threading.get_ident()

    @property
    def nodes(self) -> list[Node]:
        """The nodes that exist now."""
        return [node for program in self.engine.programs for node in program.nodes] if self.engine else []

    def _played(self, bag: str | Path | None, world: Any, caller: str) -> PlayedBag | None:
        """The bag that takes the place of a world; its player is the first of the companions."""
        if bag is None:
            return None
        if world is not None:
            raise ValueError(f"{caller}() takes a world or a bag: what the robot does is in the bag already.")
        if not isinstance(bag, str | Path):
            raise TypeError(f'bag must be the path of a bag, such as "my_drive"; it is {bag!r}.')
        from sim.ros.bags.played import PlayedBag  # imported here because its libraries take a while

        played = PlayedBag.read(bag)
        self._companions.insert(0, played.program())
        return played

    def advance(self, limit: float = math.inf, enough: Callable[[], bool] | None = None) -> float:
        """Do all that is due up to `limit`, or until `enough()`, which is called between steps.

        Returns up to when all is done, in simulated seconds. Raises what `until` raises; then, too, the run
        is over.
        """
        if self.over:
            return self.stamp
        last = FOREVER if limit == math.inf else round(limit * SECOND)
        with self._executing():
            try:
                if self._loop is None:
                    self._open()
                ended = self._loop.run(last, enough or never)
            except BaseException:
                self._close(self.recording.ended)
                raise
            if ended is not None:
                self._close(ended)
        if self.over or self._loop.due <= last:
            return self.stamp
        self._reached = max(last, self._reached)
        if self.truth is not None:
            self.truth.scene.advance(limit)  # for the picture; the next step finds it no farther
        return limit

    def start(self, spec: Process, *, from_course: bool = False) -> None:
        """Add a program; it runs as soon as the run continues. from_course: it is not the student's."""
        with self._executing():
            self.engine.start(spec, from_course=from_course)
        self._loop.due = min(self._loop.due, max(self._reached, self.engine.now))

    def end(self, ended: Ended) -> None:
        """End the run before its time."""
        if self.over:
            return
        with self._executing():
            self._close(ended)

    def give_up(self) -> None:
        """End the run because it can't be executed: not even to end its programs."""
        with _turn:
            if not self.over:
                self.over = True
                self._process.collect()

    @contextlib.contextmanager
    def _executing(self) -> Iterator[None]:
        """In this block, the state of the process is the run's."""
        with _turn, self._process.borrowed():
            # Created in here, because at the end the garbage collector sees only what was created in here.
            self.engine = self.engine or Engine(self.recording, self._screen)
            try:
                with (
                    self._random.borrowed(),
                    self._stderr.captured(),
                    student_streams(),
                    self.engine.guard.watch(),
                    self.engine.awake(),
                ):
                    yield
            finally:
                if self.over:
                    self._clean_up()

    def _open(self) -> None:
        """Start all programs: the world's own, then the user's."""
        for spec in (*self._companions, *self._specs):
            rebind(_names_around(spec.target))
        if self.recording.world is not None:
            self.truth = GroundTruth(self.recording)
        if self._preemption is not None:
            self._preemption.begin()
            self.engine.preemption = self._preemption
        self.engine.open(self.truth)
        for spec in programs_of(self.truth.scene) if self.truth is not None else []:
            self.engine.start(spec, from_course=True)
        watched = [self.engine.start(spec, from_course=True) for spec in self._companions]
        watched += [self.engine.start(spec) for spec in self._specs]
        self._loop = self._main_loop(round(self.recording.seconds * SECOND), watched)

    def _main_loop(self, end: Nanoseconds, watched: list[RunningProgram]) -> MainLoop:
        return MainLoop(self.engine, end, self._until, watched)

    def _close(self, ended: Ended) -> None:
        self.over, self.recording.ended = True, ended
        vars(self.recording).pop("digest", None)  # `until` may have computed it
        if self._preemption is not None:
            self._preemption.end(self.engine)
        if self._loop is not None:
            self._loop = None
            self.engine.close()

    def _clean_up(self) -> None:
        self.engine.recorder.add_stderr(self._stderr.close())
        self._screen.close()
        self._interrupted = self.engine.guard.interrupted
        self.engine = self.truth = None  # they and rclpy's nodes are full of cycles
        self._process.collect()


def _names_around(target: Any) -> dict[str, Any]:
    """The global names that a class or function sees, as far as they can be found."""
    try:
        return getattr(target, "__globals__", None) or vars(sys.modules[target.__module__])
    except Exception:  # a student's class may answer such questions in any way
        return {}
