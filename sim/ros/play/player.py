"""Plays a run at the pace of the wall clock; it can be watched, paused, driven manually and stopped."""

from __future__ import annotations

import asyncio
import atexit
import contextlib
import contextvars
import math
from collections import deque
from collections.abc import Callable, Generator
from typing import Any

from sim.evidence import Ended, Recording
from sim.notebook import interrupt_error
from sim.ros.engine import interrupts
from sim.ros.engine.main_loop import INTERRUPTED
from sim.ros.engine.program import Process
from sim.ros.latest import latest
from sim.ros.play.keyboard_driver import KeyboardDriver
from sim.ros.play.pacing import Pace
from sim.ros.play.picture import Picture, PictureUpdater
from sim.ros.session import Session

FRAME = 1 / 30  # s of wall time
WORK_PER_FRAME = 0.8 * FRAME  # the rest of a frame is for the kernel's messages and other cells
STEP = 0.05  # s, one period of the robot's sensors


class Player:
    """A run that is played. `recording` grows meanwhile, and at the end equals that of `run`.

    Created by `play`. It works frame by frame, as a task of the event loop, so that other cells and the
    picture's buttons are handled in between.
    """

    def __init__(self, session: Session, pace: Pace) -> None:
        """Open the session, and stop the previous player. Raises WorldError for an invalid world."""
        if latest.player is not None:  # only one at a time
            latest.player.stop("Another play has begun.")
        self.recording: Recording = session.recording
        self.paused = False
        self._session, self._pace = session, pace
        self._updater = PictureUpdater(None, pace.clock)
        self.stamp = 0.0  # simulated time (s) until which everything has run
        self._commands: deque[dict[str, Any]] = deque()
        self._keyboard_driver = KeyboardDriver(session, pace.clock)
        self._advancing = self._released = False
        self._stop_reason: str | None = None  # set when the run is to end
        self._error: Exception | None = None
        self._context = contextvars.copy_context()  # notebook output goes to the cell that this context names
        self._context.run(session.advance, -1.0)  # opens the session
        latest.player, latest.recording = self, session.recording
        atexit.register(self._stop_at_exit)

    @property
    def over(self) -> bool:
        """Return whether the run has ended; `recording.ended` says why."""
        return self._session.over

    @property
    def speed(self) -> float:
        """Simulated seconds per second; can be set. math.inf: as fast as possible."""
        return self._pace.speed

    @speed.setter
    def speed(self, speed: float) -> None:
        self._pace.speed = speed

    @property
    def nodes(self) -> list[str]:
        """Full names of the current nodes."""
        return [node.get_fully_qualified_name() for node in self._session.nodes]

    def add(self, program: Process) -> None:
        """Start a further program of the course, such as a tool."""
        self._context.run(self._session.start, program, from_course=True)

    def pause(self) -> None:
        """Stop simulated time."""
        self.paused = True
        self._pace.restart()

    def resume(self) -> None:
        """Continue simulated time."""
        self.paused = False
        self._pace.restart()

    def step(self) -> None:
        """Pause, then advance by 0.05 s, the period of the robot's scans. Only in the thread of `play`."""
        self.pause()
        self._advance(self.stamp + STEP)
        self._update()

    def stop(self, why: str = "The user stopped it.") -> None:
        """End the run now or, in another thread, at the next frame."""
        self._stop_reason = why
        if not self._advancing and not self.over and not self._session.elsewhere:
            self._end()

    def result(self) -> Recording:
        """Run the rest as fast as possible, and return the recording. Only in the thread of `play`.

        Raises KeyboardInterrupt if the user interrupts that, and any exception of `until`.
        """
        if not self.over:
            self._advance(math.inf)
            self._update()
            if self._session.interrupted:
                raise interrupt_error()
        if self._error is not None:
            raise self._error
        return self.recording

    def __await__(self) -> Generator[Any, None, Recording]:
        return self._wait().__await__()

    async def _wait(self) -> Recording:
        try:
            while not self.over:
                await asyncio.sleep(FRAME)
        except asyncio.CancelledError:
            self.stop(INTERRUPTED)
            raise
        return self.result()

    def __repr__(self) -> str:
        how = "paused" if self.paused else f"playing at speed {self.speed:g}"
        how = f"ended: {self.recording.ended.reason}" if self.over else how
        return f"<Player at {self.stamp:.2f} s of {self.recording.seconds:g} s, {how}>"

    def _ipython_display_(self) -> None:
        """Nothing: the picture is there already."""

    def show(self, picture: Picture) -> None:
        """Show the run in a picture, and execute the picture's commands."""
        self._updater = PictureUpdater(picture, self._pace.clock)
        picture.on_command = self._commands.append

    def begin(self) -> None:
        """Play on the running event loop; without one, play to the end before returning."""
        try:
            loop = asyncio.get_running_loop()
        except RuntimeError:
            try:
                asyncio.run(self._play())
            except KeyboardInterrupt:
                raise interrupt_error() from None
            self.result()
        else:
            self._task = loop.create_task(self._play())  # the loop keeps only a weak reference

    async def _play(self) -> None:
        clock = self._pace.clock
        try:
            while not self.over:
                began = clock()
                interrupts.listen(self._interrupt)
                self.play_frame()
                await asyncio.sleep(max(began + FRAME - clock(), FRAME - WORK_PER_FRAME))
        except asyncio.CancelledError:
            self.stop(INTERRUPTED)
            raise
        await interrupts.leave(self._interrupt)

    def _interrupt(self) -> None:
        self._stop_reason = INTERRUPTED

    def play_frame(self, limit: float = math.inf, enough: Callable[[], bool] = lambda: False) -> None:
        """Play one frame: execute commands, advance to the due time, update the picture.

        limit: latest simulated time (s) to advance to. enough: checked between time steps; True stops there.
        """
        while self._commands and not self.over:
            with contextlib.suppress(ValueError):  # a page may send anything
                self._execute(self._commands.popleft())
        clock = self._pace.clock
        self._keyboard_driver.release_if_stale()
        if self._stop_reason is not None and not self.over:
            self._end()
        if not self.over and not self.paused:
            due, pause_at = min(self._pace.due(self.stamp), limit), clock() + WORK_PER_FRAME
            self._advance(due, lambda: clock() >= pause_at or enough())
            if self.stamp < due:
                self._pace.fell_behind()
        self._update()
        if self._session.interrupted:
            interrupts.pass_on()

    def _advance(self, limit: float, enough: Callable[[], bool] | None = None) -> None:
        """Advance to `limit`; if the run ends there, clean up."""
        if self._session.elsewhere:
            raise RuntimeError("A player continues only in the thread that called play(); here, stop it.")
        if self._advancing:
            raise RuntimeError("A player can't be advanced from inside its own run; let `until` return True.")
        self._advancing = True
        try:
            self.stamp = max(self.stamp, self._context.run(self._session.advance, limit, enough))
        except Exception as error:
            self._error = error
            self._session.give_up()
            detail = f"`until` raised {type(error).__name__}: {error}"
            self.recording.ended = Ended("interrupted", self._session.stamp, detail)
        finally:
            self._advancing = False
        if self._session.interrupted and not self.over:
            self._stop_reason = INTERRUPTED
        if self._stop_reason is not None and not self.over:
            self._end()

    def _end(self) -> None:
        self.recording.stamp = max(self.recording.stamp, self.stamp)
        ended = Ended("interrupted", self.recording.stamp, self._stop_reason)
        self._context.run(self._session.end, ended)
        self._update()

    def _stop_at_exit(self) -> None:
        """End the run without a picture, because Python exits."""
        self._updater = PictureUpdater(None, self._pace.clock)
        self.stop("Python has ended.")

    def _update(self) -> None:
        """Update the picture and, once the run has ended, release everything."""
        ended = list(self.recording.ended[::2]) if self.over else None
        urgent = {"speed": self.speed, "paused": self.paused, "ended": ended}
        self._updater.frame(self._session, self.stamp)
        self._updater.state(self._session, self.stamp, self._pace.measured, **urgent)
        if self.over and not self._released:
            self._released, latest.player = True, None if latest.player is self else latest.player
            atexit.unregister(self._stop_at_exit)
            # In the caller's context: tools that execute notebooks receive output of the current cell only.
            self._updater.finish(self.recording)

    def _execute(self, command: dict[str, Any]) -> None:
        match command:
            case {"speed": speed}:
                self.speed = speed
            case {"pause": on}:
                self.pause() if on else self.resume()
            case {"step": True}:
                self.step()
            case {"stop": True}:
                self.stop()
            case {"topic": name}:
                self._updater.telemetry.select(name)
            case {"graph": True}:
                self._updater.connections(self.recording)
            case _:
                self._context.run(self._keyboard_driver.execute, command)
