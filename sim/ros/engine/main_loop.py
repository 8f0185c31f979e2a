"""The main loop of a run: step by step until its end, a goal, a fault, or its last program's exit."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from sim.evidence import Ended, Recording
from sim.nanoseconds import SECOND, Nanoseconds
from sim.ros.engine.endings import conclusion
from sim.ros.engine.engine import Engine, never
from sim.ros.engine.running_program import RunningProgram

INTERRUPTED = "The user interrupted the run."
AFTER_LAST_PROGRAM: Nanoseconds = SECOND  # lets a robot roll out when every program has exited


class MainLoop:
    """The main loop of one run. It can be paused between any two steps.

    end: when the run ends at the latest. goal: ends it when it returns true. watched: the programs after
    whose exit the run ends, too. due: the moment of the next step.
    """

    def __init__(
        self,
        engine: Engine,
        end: Nanoseconds,
        goal: Callable[[Recording], bool] | None,
        watched: Sequence[RunningProgram],
    ) -> None:
        self.due: Nanoseconds = 0
        self._engine, self._end, self._goal = engine, end, goal
        self._watched = watched
        self._students = [program for program in watched if not program.from_course]
        self._all_exited: Nanoseconds | None = None

    def run(self, last: Nanoseconds, enough: Callable[[], bool] = never) -> Ended | None:
        """Do all that is due up to `last`, or until `enough()`; returns why the run has ended, if it has.

        `enough` is called between steps: one that is true from the start still lets the first step happen, so
        that a play makes progress on any machine.
        """
        while self.due <= last:
            self._engine.step(self.due)
            ended = self._ended()
            if ended is not None:
                self._engine.note_unfinished()
                return ended
            self.due = self._engine.next_moment(self._end)
            if enough():
                break
        return None

    def _ended(self) -> Ended | None:
        engine, recording = self._engine, self._engine.recording
        recording.stamp = now = engine.recorder.now
        if engine.fault is not None or engine.now >= self._end:
            return engine.fault or conclusion(engine, self._all_exited)
        if engine.guard.interrupted:
            return Ended("interrupted", now, INTERRUPTED)
        if self._goal is not None and self._goal(recording):
            return Ended("goal", now, f"The goal was reached at t = {now:g} s.")
        self._note_exits(now)
        return None

    def _note_exits(self, now: float) -> None:
        engine, recording = self._engine, self._engine.recording
        if recording.all_exited_at is None and self._students and not any(map(engine.lives, self._students)):
            recording.all_exited_at = now
        if self._all_exited is None and self._watched and not any(map(engine.lives, self._watched)):
            self._all_exited = engine.now
            self._end = min(self._end, engine.now + AFTER_LAST_PROGRAM)
