"""The engine of a run: student processes as fibers, the simulated clock, and what ends it."""

from __future__ import annotations

import contextlib
import sys
from collections import Counter
from collections.abc import Callable, Generator, Iterator, Sequence
from typing import Any

from rclpy.context import Context
from rclpy.exceptions import InvalidHandle

from sim.evidence import Ended, Recording
from sim.nanoseconds import SECOND, Nanoseconds
from sim.ros.engine.endings import conclusion
from sim.ros.engine.guard import Guard
from sim.ros.engine.limits import RunLimits
from sim.ros.engine.peer import Peer
from sim.ros.engine.process_state import RclpyState, SeededBytes
from sim.ros.engine.processes import StudentProcess, destroy
from sim.ros.engine.program import Process
from sim.ros.engine.simtime import SimulatedTime
from sim.ros.fibers.exceptions import Livelock, RemoteLost, RunOver
from sim.ros.fibers.fiber import Fiber
from sim.ros.fibers.scheduler import Scheduler, activate
from sim.ros.recorder.recorder import Recorder
from sim.ros.recorder.running import RunningCallback
from sim.ros.recorder.tracebacks import student_line
from sim.ros.transport.channels import HostLinks
from sim.ros.transport.event_queue import EventQueue
from sim.ros.transport.service_transport import ServiceTransport
from sim.ros.transport.topics import Topics

INTERRUPTED = "The user interrupted the run."
AFTER_LAST_PROCESS: Nanoseconds = SECOND  # lets a robot roll out when every program has ended


class Engine(Scheduler):
    """One run on the real rclpy. Between open() and close(), it can be awake again and again."""

    def __init__(self, recording: Recording, echo: Callable[[str], None]) -> None:
        super().__init__()
        self.recording = recording
        self.recorder = Recorder(self, recording)
        self.guard = Guard(self)
        self.chance = SeededBytes(recording.seed)
        self.context = Context()
        self.rclpy = RclpyState()
        self.executors: list[Any] = []
        self.has_clients = self.rosout_wanted = False
        self.topology = 0
        self.destroyed = 0  # so many of rclpy's handles were
        self.exchanged = 0  # so often something was sent that an end of an action may have to take
        self.links = None if recording.network is None else HostLinks(recording.network, recording.seed)
        self.post = None if recording.network is None else ServiceTransport(self)
        self.agenda, self.topics = EventQueue(), Topics(self)
        self.asked: Counter[str] = Counter()  # requests sent to each service
        self.names: dict[int, tuple[Callable, str]] = {}  # of callbacks, by the id of what they belong to
        self.processes: list[StudentProcess] = []
        self.echo = echo
        self.limits = RunLimits(self)
        self.suspended: list[RunningCallback] = []  # coroutine callbacks that wait for something
        self.held = (0.0, 0.0)  # what a user at the keys drives by hand: forward and left, each in [-1, 1]
        self._fault: Ended | None = None
        self._unheard = False  # nobody hears what is said while the last threads are ended by force
        self.link: Peer | None = None
        self.blocked_elsewhere = ""  # a sentence on what these wait for in vain

    # -- set-up and tear-down ----------------------------------------------------------------------

    @contextlib.contextmanager
    def awake(self) -> Iterator[None]:
        """Let rclpy be the run's for a while, and its student code be seen by the hooks."""
        with self.rclpy.borrowed():
            activate(self)
            try:
                yield
            finally:
                activate(None)
                if StudentProcess.loaded is not None:
                    StudentProcess.loaded.unload()

    def open(self) -> None:
        """Begin. Call it, and everything that runs student code, while the engine is awake."""
        self.context.init(args=["run"])
        self.time = SimulatedTime(self)

    def close(self) -> None:
        """Leave nothing of the run."""
        self.recorder.close()
        try:
            self.guard.impatient = True
            self.interrupt_all()
            self._unheard = True
            for executor in self.executors:
                executor._sim.end_coroutines()
            self.end_all()
        finally:
            for process in self.processes:
                self._free(process)
            if self.link is not None:
                self.link.close()
            for executor in self.executors:
                with contextlib.suppress(InvalidHandle):
                    executor.shutdown()
            self.rclpy.forget_contexts(but=1)
            self.context.try_shutdown()
            self.context.destroy()
            del self.time
            self.executors.clear()

    def _free(self, process: StudentProcess) -> None:
        for node in process.nodes:
            destroy(node)
        process.nodes.clear()
        self.endpoints_changed()

    def start(self, spec: Process, *, from_course: bool = False) -> StudentProcess:
        """Add a program; it runs when the engine does. ours: it is not the student's."""
        process = StudentProcess(self, spec, from_course)
        self.processes.append(process)
        process.main = self.spawn(process.run, process.name, process)
        return process

    # -- time --------------------------------------------------------------------------------------

    def moments(
        self, end: Nanoseconds, goal: Callable[[Recording], bool] | None, watched: Sequence[StudentProcess]
    ) -> Generator[Nanoseconds, Nanoseconds, Ended]:
        """Yield each moment before time moves to it, and take it or an earlier one; return why none is left.

        That is `end`, the goal, a fault, or that all watched programs have ended. One may rest in between.
        """
        over, theirs = None, [process for process in watched if not process.from_course]
        try:
            self.settle()
            while self.fault is None and self.now < end:
                self.recording.stamp = now = self.recorder.now
                if self.guard.interrupted:
                    return Ended("interrupted", now, INTERRUPTED)
                if goal is not None and goal(self.recording):
                    return Ended("goal", now, f"The goal was reached at t = {now:g} s.")
                if self.recording.all_exited_at is None and theirs and not any(map(self.lives, theirs)):
                    self.recording.all_exited_at = now
                if over is None and watched and not any(self.lives(process) for process in watched):
                    over = self.now
                    end = min(end, self.now + AFTER_LAST_PROCESS)
                self.limits.check_pace()
                moment = self.time.next_moment(self.agenda.next(end))
                moment = yield moment
                self.time.move_to(moment)
                self.begin_moment()
                self.settle()
        except Livelock:
            pass  # its reason is kept
        self.recording.stamp = self.recorder.now
        return self.fault or conclusion(self, over)

    def begin_moment(self) -> None:
        """Time was moved: whoever spins looks again, and callbacks are counted anew."""
        self.activity += 1
        self.limits.begin_moment()
        self.agenda.run_arrivals(self.now)

    def round(self) -> bool:
        """As `Scheduler`; when no program can go on any more, what this moment was the limit for is over."""
        sends = super().round() or (self.post is not None and self.post.collect())
        return sends or self.agenda.run_deadlines(self.now)

    def lives(self, process: StudentProcess) -> bool:
        """Whether a program still has something to run."""
        return any(fiber.process is process and not fiber.done for fiber in self.fibers)

    # -- what student code reports through the hooks -----------------------------------------------

    def endpoints_changed(self) -> None:
        """Entities came or went: executors plan anew."""
        self.topology += 1
        self.activity += 1

    def printed(self, text: str) -> None:
        """Student code wrote to stdout."""
        self._wrote("stdout", text, self.recorder.printed)

    def complained(self, text: str) -> None:
        """Student code wrote to stderr."""
        self._wrote("stderr", text, self.recorder.complained)

    def _wrote(self, stream: str, text: str, keep: Callable[[str], None]) -> None:
        if not self._unheard:
            self.current.process.show(stream, text)
            keep(text)
            if lines := text.count("\n"):
                self.called("lines", lines)

    def logged(self, severity: Any, logger: str, text: str) -> None:
        """A node wrote a log line."""
        line = self.recorder.log(severity, logger, text)
        if line is not None:
            shown = f"[{line.level}] [{line.stamp:.3f}] [{line.node}]: {line.text}\n"
            self.current.process.show("stderr", shown)
        self.called("lines")

    def loops_busily(self) -> None:
        """As `Scheduler`; it is written down."""
        self.recorder.busy_loop(self.current, student_line(sys._getframe()))

    # -- endings -----------------------------------------------------------------------------------

    @property
    def fault(self) -> Ended | None:
        """What stops the run as soon as nothing can go on at this moment, or None."""
        if self._fault is None and self.livelock is not None:
            return Ended("livelock", self.recorder.now, f"{self.livelock}.")
        return self._fault

    def stop(self, fault: Ended) -> None:
        """Let the run end with this; what was first stands."""
        self._fault = self.fault or fault

    def fiber_ended(self, fiber: Fiber) -> None:
        """Judge how a fiber ended, and end its process with its main()."""
        error, process = fiber.error, fiber.process
        if isinstance(error, RemoteLost):
            raise error
        if self.guard.hang is not None and self.recorder.open:
            self._fault = Ended("hang", self.recorder.now, str(self.guard.hang))
        elif error is not None:
            self.current = fiber  # for the names of its process
            if isinstance(error, SystemExit) and fiber is process.main:
                self.recorder.exited(error, fiber.name)
            else:
                self.recorder.error(error, fiber.name)
            self.current = None
        if fiber is process.main or (process.main.done and not self.lives(process)):
            threads = [f for f in self.fibers if f.process is process and not f.done]
            for daemon in threads:
                if daemon.daemon:
                    daemon.thrown = RunOver()
            if all(f.daemon for f in threads):
                self._free(process)
