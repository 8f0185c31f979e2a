"""The engine of a run: its programs as fibers, the simulated clock, and the step of its main loop."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator
from typing import Protocol

from sim.evidence import Ended, Recording
from sim.nanoseconds import SECOND, Nanoseconds
from sim.order import Order
from sim.ros.engine.callbacks import Callbacks
from sim.ros.engine.guard import Guard
from sim.ros.engine.limits import RunLimits
from sim.ros.engine.output import ProgramOutput
from sim.ros.engine.process_state import RclpyState, SeededBytes
from sim.ros.engine.program import Process
from sim.ros.engine.program_ends import end_programs
from sim.ros.engine.running_program import RunningProgram, destroy
from sim.ros.engine.simtime import SimulatedTime
from sim.ros.fibers.choices import Choices
from sim.ros.fibers.exceptions import Livelock, RemoteLost, RunOver
from sim.ros.fibers.fiber import Fiber
from sim.ros.fibers.scheduler import Scheduler, activate
from sim.ros.fibers.waiter import NEVER
from sim.ros.recorder.recorder import Recorder
from sim.ros.recorder.tracebacks import student_line
from sim.ros.transport.transport import Transport

MAX_ROUNDS = 200_000  # of a step; a run that needs more will never be quiet


class MovingWorld(Protocol):
    """A world that moves along with time."""

    def move_to(self, moment: Nanoseconds) -> None:
        """Advance it to this moment."""


def never() -> bool:
    """For a step that isn't paused."""
    return False


class Engine(Scheduler):
    """One run on the real rclpy. Between open() and close(), it can be awake again and again.

    screen: shows text of the programs to the user.
    """

    def __init__(self, recording: Recording, screen: Callable[[str], None]) -> None:
        super().__init__()
        self.recording, self.epoch = recording, recording.epoch
        order = Order.parse(recording.order or None)
        self.choices = order and Choices(order, recording.departures, lambda: self.now)
        self.recorder = Recorder(self, recording)
        self.output = ProgramOutput(self, self.recorder, screen)
        self.limits = RunLimits(self)
        self.guard = Guard(self, self.recorder, self.limits)
        self.callbacks = Callbacks(self, self.recorder, self.limits)
        self.transport = Transport(self, self.recorder, lambda wall: self.time.moment_at(wall))
        self.random = SeededBytes(recording.seed)
        self.rclpy = RclpyState()
        self.programs: list[RunningProgram] = []
        self.held = (0.0, 0.0)  # the user's keys: forward and left, each in [-1, 1]; a Teleop node reads them
        self.pointed: tuple[float, float] | None = None  # (m) the last click, for a Pointer node
        self._fault: Ended | None = None

    # -- the main loop -----------------------------------------------------------------------------

    def step(self, moment: Nanoseconds, pause: Callable[[], bool] = never) -> bool:
        """One step of the main loop: advance time, do what is due, let programs run until none can go on.

        pause: called after each round of turns; when it returns true the step ends, and the next one may have
        the same moment. Returns whether a program could still go on. A livelock ends the step, too, and is in
        `fault`.
        """
        try:
            self.advance_time(moment)
            self.transport.events.run_arrivals(self.now)
            return self.run_programs(pause)
        except Livelock:
            return False

    def advance_time(self, moment: Nanoseconds) -> None:
        """Move the world, and all clocks if they are not there yet, to `moment`."""
        later = moment > self.now
        if later:
            self.limits.check_pace()
        if self._world is not None:
            self._world.move_to(moment)
        if later:
            self.time.move_to(moment)
            self.limits.begin_moment()
            self.waiters.wake_polled()

    def run_programs(self, pause: Callable[[], bool] = never) -> bool:
        """Let programs run in rounds until none can go on, or until `pause()`; whether one still can."""
        for _ in range(MAX_ROUNDS):
            if not self.run_round() and not self.transport.collect() and not self.run_deadlines():
                return False
            if pause():
                return self.can_go_on()
        self.raise_livelock(
            f"the nodes keep each other busy at t = {self.now / SECOND:g} s and time cannot advance"
        )

    def run_deadlines(self) -> bool:
        """Once no program can go on, the deadlines of this moment have passed; whether there were any."""
        return self.transport.events.run_deadlines(self.now)

    def others_due(self, within: Nanoseconds) -> bool:
        """Work like `Scheduler`; messages arrive, too."""
        return super().others_due(within) or self.transport.events.next_due(NEVER) <= self.now + within

    def can_go_on(self) -> bool:
        """Return whether there is still something to do at this moment."""
        runnable = any(not fiber.done and fiber.runnable() for fiber in self.fibers)
        return runnable or self.transport.events.next_due(NEVER) <= self.now

    def next_moment(self, end: Nanoseconds) -> Nanoseconds:
        """The next time at which a fiber, an executor's timer or an event is due; `end` at the latest.

        To stop at every due time matters: a timer that is passed over drops its ticks.
        """
        now, moment = self.now, self.transport.events.next_due(end)
        moment = moment if moment > now else end
        for fiber in self.fibers:
            if fiber.wake_at is not None and now < fiber.wake_at < moment:
                moment = fiber.wake_at
            if fiber.waiter is not None:
                fiber.timer_due = due = fiber.waiter.next_due()
                moment = min(moment, due)
        return moment

    # -- set-up and tear-down ----------------------------------------------------------------------

    @contextlib.contextmanager
    def awake(self) -> Iterator[None]:
        """In this block rclpy's state is the run's, and the hooks see its student code."""
        with self.rclpy.borrowed():
            activate(self)
            try:
                yield
            finally:
                activate(None)
                if RunningProgram.loaded is not None:
                    RunningProgram.loaded.unload()

    def open(self, world: MovingWorld | None) -> None:
        """Begin. Call it, and everything that runs student code, while the engine is awake.

        world: moves along with time; None for no robot.
        """
        self._world = world
        self.rclpy.context.init(args=["run"])
        self.time = SimulatedTime(self)

    def close(self) -> None:
        """End all programs, and free everything of the run."""
        self.choices = None
        self.recorder.close()
        try:
            self.guard.impatient = True
            end_programs(self)
        finally:
            for program in self.programs:
                self._free(program)
            if self.transport.peer is not None:
                self.transport.peer.close()
            for waiter in self.waiters.all:
                waiter.close()
            self.rclpy.forget_contexts(but=1)
            self.rclpy.context.try_shutdown()
            self.rclpy.context.destroy()
            del self.time
            self.waiters.clear()

    def note_unfinished(self) -> None:
        """Record what programs wait for as the run ends."""
        self.callbacks.note_unfinished(node for program in self.programs for node in program.nodes)

    def finish(self) -> None:
        """Let programs run on that have to end now."""
        with contextlib.suppress(Livelock):
            self.run_programs()

    def _free(self, program: RunningProgram) -> None:
        for node in program.nodes:
            destroy(node)
        program.nodes.clear()
        self.waiters.endpoints_changed()

    # -- programs ----------------------------------------------------------------------------------

    def start(self, spec: Process, *, from_course: bool = False) -> RunningProgram:
        """Add a program; it runs when the engine does. from_course: it is not the student's."""
        number = sum(program.from_course == from_course for program in self.programs)
        program = RunningProgram(self, self.rclpy, spec, from_course, number)
        self.programs.append(program)
        program.main = self.spawn(program.run, program.name, program)
        return program

    def lives(self, program: RunningProgram) -> bool:
        """Return whether a program still has something to run."""
        return any(fiber.process is program and not fiber.done for fiber in self.fibers)

    def busy_loop_found(self) -> None:
        """Work like `Scheduler`; it is recorded."""
        self.recorder.busy_loop(self.current, student_line(sys._getframe()))

    def fiber_ended(self, fiber: Fiber) -> None:
        """Record how a fiber ended, and end its program with its main()."""
        error, program = fiber.error, fiber.process
        if isinstance(error, RemoteLost):
            raise error
        if self.guard.hang is not None and self.recorder.open:
            self._fault = Ended("hang", self.recorder.now, str(self.guard.hang))
        elif error is not None:
            if self.preemption is not None and self.preemption.log is not None:
                self.preemption.log.finish(self)
            self.current = fiber  # for the names of its program
            if isinstance(error, SystemExit) and fiber is program.main:
                self.recorder.program_exited(error, fiber.name)
            else:
                self.recorder.error(error, fiber.name)
            if fiber is program.main and not (program.from_course or program.bundled):
                self.recorder.end_error(error, fiber.name, has_main=not isinstance(program.target, type))
            self.current = None
        if fiber is program.main or (program.main.done and not self.lives(program)):
            threads = [f for f in self.fibers if f.process is program and not f.done]
            for daemon in threads:
                if daemon.daemon:
                    daemon.thrown = RunOver()
            if all(f.daemon for f in threads):
                self._free(program)

    # -- faults ------------------------------------------------------------------------------------

    @property
    def fault(self) -> Ended | None:
        """Return what stops the run as soon as no program can go on at this moment, or None."""
        if self._fault is None and self.livelock is not None:
            return Ended("livelock", self.recorder.now, f"{self.livelock}.")
        return self._fault

    def stop(self, fault: Ended) -> None:
        """End the run with this, unless it has a fault already."""
        self._fault = self.fault or fault
