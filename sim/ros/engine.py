"""The engine of a run: student processes as fibers, the simulated clock, and what ends it."""

from __future__ import annotations

import contextlib
from collections import Counter
from collections.abc import Callable, Generator, Iterable, Iterator
from typing import Any

from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.exceptions import InvalidHandle
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy

from sim.recording import Ended, Recording
from sim.ros.callbacks import MAX_CALLBACKS_PER_INSTANT, Running
from sim.ros.endings import conclusion
from sim.ros.fibers import SECOND, Fiber, Livelock, Nanoseconds, RemoteLost, RunOver, Scheduler, activate
from sim.ros.guard import Guard
from sim.ros.own import ChanceBytes, OwnRclpy
from sim.ros.processes import Process, StudentProcess
from sim.ros.recorder import Recorder, destroy
from sim.ros.simtime import SimulatedTime

REPLAY_WAIT = Duration(seconds=2)  # wall time; measured at 0.1 s
MAX_WORK_PER_SECOND = 200_000  # callbacks and switches in a simulated second
INTERRUPTED = "The user interrupted the run."
AFTER_LAST_PROCESS: Nanoseconds = SECOND  # lets a robot roll out when every program has ended


class Engine(Scheduler):
    """One run on the real rclpy. Between open() and close(), it can be awake again and again."""

    def __init__(self, recording: Recording, echo: Callable[[str], None]) -> None:
        super().__init__()
        self.recording = recording
        self.recorder = Recorder(self, recording)
        self.guard = Guard(self)
        self.chance = ChanceBytes(recording.seed)
        self.context = Context()
        self.rclpy = OwnRclpy()
        self.executors: list[Any] = []
        self.has_clients = self.rosout_wanted = False
        self.topology = 0
        self.sent: dict[str, int] = {}  # messages published on each topic
        self.asked: Counter[str] = Counter()  # requests sent to each service
        self.processes: list[StudentProcess] = []
        self.echo = echo
        self._callbacks = self._callbacks_before = 0
        self.suspended: list[Running] = []  # coroutine callbacks that wait for something
        self.held = (0.0, 0.0)  # what a user at the keys drives by hand: forward and left, each in [-1, 1]
        self._second = (0, 0)  # when the second under way began, and the work done by then
        self._fault: Ended | None = None
        self.link: Any = None  # to another process, in which some of the run's nodes live
        self.blocked_elsewhere = ""  # a sentence on what these wait for in vain

    # -- set-up and tear-down ----------------------------------------------------------------------

    @contextlib.contextmanager
    def awake(self) -> Iterator[None]:
        """Let rclpy be the run's for a while, and its student code be seen by the hooks."""
        with self.rclpy.lent():
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
            self._wind_down()
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

    def _wind_down(self) -> None:
        """Do what Ctrl-C does to every program, so that its `except` and `finally` run; then insist."""
        self.guard.impatient = True
        for stop in (KeyboardInterrupt, RunOver, RunOver):
            for fiber in self.fibers:
                if fiber.started:
                    fiber.thrown = stop()
                else:
                    fiber.done = True
            self.fibers = [fiber for fiber in self.fibers if not fiber.done]
            if not self.fibers:
                return
            with contextlib.suppress(Livelock):
                self.settle()

    def _free(self, process: StudentProcess) -> None:
        for node in process.nodes:
            destroy(node)
        process.nodes.clear()

    def start(self, spec: Process) -> StudentProcess:
        """Add a program; it runs when the engine does."""
        process = StudentProcess(self, spec)
        self.processes.append(process)
        process.main = self.spawn(process.run, process.name, process)
        return process

    # -- time --------------------------------------------------------------------------------------

    def moments(
        self, end: Nanoseconds, goal: Callable[[Recording], bool] | None, watched: Iterable[StudentProcess]
    ) -> Generator[Nanoseconds, None, Ended]:
        """Yield each moment before time moves on to it; return why there are no more.

        That is `end`, the goal, a fault, or that all watched programs have ended. Whoever iterates may rest
        between two moments: nothing in here depends on it.
        """
        watched, over = list(watched), None
        try:
            self.settle()
            while self.fault is None and self.now < end:
                self.recording.stamp = now = self.recorder.now
                if self.guard.interrupted:
                    return Ended("interrupted", now, INTERRUPTED)
                if goal is not None and goal(self.recording):
                    return Ended("goal", now, f"The goal was reached at t = {now:g} s.")
                if over is None and watched and not any(self.lives(process) for process in watched):
                    over = self.now
                    end = min(end, self.now + AFTER_LAST_PROCESS)
                self.check_pace()
                moment = self.time.next_moment(end)
                yield moment
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
        self._callbacks_before = self._callbacks

    def check_pace(self) -> None:
        """Raise Livelock when time moves, but in steps so small that the run would never end."""
        began, work = self._second
        if self.now - began >= SECOND:
            self._second = self.now, self.stretch
        elif self.stretch - work > MAX_WORK_PER_SECOND:
            self.refuse_to_go_on(
                f"callbacks and waits came more than {MAX_WORK_PER_SECOND} times in one second, near "
                f"t = {self.recorder.now:g} s; a timer's period or a sleep is far too short"
            )

    def lives(self, process: StudentProcess) -> bool:
        """Whether a program still has something to run."""
        return any(fiber.process is process and not fiber.done for fiber in self.fibers)

    # -- what student code reports through the hooks -----------------------------------------------

    @property
    def stretch(self) -> int:
        """Changes whenever control passes on: the guard sees by it that student code isn't stuck."""
        return self.switches + self._callbacks

    def count_callback(self) -> None:
        """A callback is about to run. Raises Livelock when too many ran without time moving."""
        if self._callbacks - self._callbacks_before >= MAX_CALLBACKS_PER_INSTANT:
            self.refuse_to_go_on(
                f"{MAX_CALLBACKS_PER_INSTANT} callbacks ran at t = {self.recorder.now:g} s"
                " without letting time move on"
            )
        self._callbacks += 1  # not before: the guard must see that code which swallows the Livelock is stuck

    def endpoints_changed(self) -> None:
        """Entities came or went: executors plan anew."""
        self.topology += 1
        self.activity += 1

    def subscribed(self, topic: str, subscription: Any) -> None:
        """A subscription was made. Waits, in wall time, for what a late joiner of a latched topic gets."""
        self.endpoints_changed()
        self.rosout_wanted |= topic == "/rosout"
        if subscription.qos_profile.durability is not DurabilityPolicy.TRANSIENT_LOCAL:
            return
        for publisher in self._publishers(topic):
            profile = publisher.qos_profile
            latched = profile.durability is DurabilityPolicy.TRANSIENT_LOCAL
            if latched and profile.reliability is ReliabilityPolicy.RELIABLE:
                publisher.wait_for_all_acked(REPLAY_WAIT)

    def _publishers(self, topic: str) -> Iterator[Any]:
        for process in self.processes:
            for node in process.nodes:
                yield from (publisher for publisher in node.publishers if publisher.topic_name == topic)
        if self.link is not None:
            yield from self.link.puppets.publishers.get(topic, ())

    def published(self, topic: str, type_: str, sender: str, raw: bytes) -> None:
        """A message was sent: its subscriptions have something to take."""
        self.sent[topic] = self.sent.get(topic, 0) + 1
        self.activity += 1
        self.recorder.message(topic, type_, sender, raw)

    def printed(self, text: str) -> None:
        """Student code wrote to stdout."""
        self.echo(text)
        self.recorder.printed(text)

    def complained(self, text: str) -> None:
        """Student code wrote to stderr."""
        self.echo(text)
        self.recorder.complained(text)

    def logged(self, severity: Any, logger: str, text: str) -> None:
        """A node wrote a log line."""
        line = self.recorder.log(severity, logger, text)
        if line is not None:
            self.echo(f"[{line.level}] [{line.stamp:.3f}] [{line.node}]: {line.text}\n")

    def describe(self, fiber: Fiber) -> str:
        """Which callback of which node a fiber is in, for a message."""
        if fiber.callbacks:
            running = fiber.callbacks[-1]
            return f"{running.name} of node {running.node} at t = {self.recorder.now:g} s"
        return f"{fiber.name}() at t = {self.recorder.now:g} s"

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
            self.recorder.error(error, fiber.name)
            self.current = None
        if fiber is process.main or (process.main.done and not self.lives(process)):
            threads = [f for f in self.fibers if f.process is process and not f.done]
            for daemon in threads:
                if daemon.daemon:
                    daemon.thrown = RunOver()
            if all(f.daemon for f in threads):
                self._free(process)
