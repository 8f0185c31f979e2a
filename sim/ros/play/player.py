"""Plays a run along with the clock on the wall: watched, paused, driven by hand, stopped."""

from __future__ import annotations

import asyncio
import atexit
import contextlib
import contextvars
import gc
import math
from collections import deque
from collections.abc import Callable, Generator
from typing import Any

from sim.evidence import Ended, Recording
from sim.notebook import interrupted
from sim.ros.engine import interrupts
from sim.ros.engine.engine import INTERRUPTED
from sim.ros.engine.program import Process
from sim.ros.latest import latest
from sim.ros.play.hand import Hand
from sim.ros.play.pacing import Pace
from sim.ros.play.picture import Picture, Show
from sim.ros.session import Session

FRAME = 1 / 30  # s of wall time
WORK = 0.8 * FRAME  # of it; the rest is the kernel's, for messages and other cells
STEP = 0.05  # s, one period of the robot's sensors


class Player:
    """A run that is played. `recording` grows while it goes on, and ends equal to that of `run`.

    Made by `play`. It works in stretches of a frame each, as a task of the event loop, so that other cells
    and the picture's buttons have their turn in between.
    """

    def __init__(self, session: Session, pace: Pace) -> None:
        """Open the session, and stop what was played before. Raises WorldError for a bad world."""
        if latest.player is not None:  # there is one at a time
            latest.player.stop("Another play has begun.")
        self.recording: Recording = session.recording
        self.paused = False
        self._session, self._pace = session, pace
        self._show = Show(None, pace.clock)
        self.stamp = 0.0  # s of simulated time up to which all that is due has been done
        self._commands: deque[dict[str, Any]] = deque()
        self._hand = Hand(session, pace.clock)
        self._at_work = self._let_go = False
        self._wanted: str | None = None  # why it should stop
        self._error: Exception | None = None
        self._context = contextvars.copy_context()  # a notebook's output goes to the cell that this names
        self._context.run(session.advance, -1.0)  # opens it
        latest.player = self
        atexit.register(self._quit)

    @property
    def over(self) -> bool:
        """Whether the run has ended; `recording.ended` says why."""
        return self._session.over

    @property
    def speed(self) -> float:
        """Simulated seconds per second; can be set. math.inf: as fast as it goes."""
        return self._pace.speed

    @speed.setter
    def speed(self, speed: float) -> None:
        self._pace.speed = speed

    @property
    def nodes(self) -> list[str]:
        """Full names of the nodes that are there now."""
        return [node.get_fully_qualified_name() for node in self._session.nodes]

    def add(self, program: Process) -> None:
        """Add one of our programs, a tool's for example."""
        self._context.run(self._session.start, program, from_course=True)

    def pause(self) -> None:
        """Let time stand still."""
        self.paused = True
        self._pace.start_anew()

    def resume(self) -> None:
        """Let time go on."""
        self.paused = False
        self._pace.start_anew()

    def step(self) -> None:
        """Pause, and go on by 0.05 s: to the next of the robot's scans. Only in the thread of `play`."""
        self.pause()
        self._work(self.stamp + STEP)
        self._update()

    def stop(self, why: str = "The user stopped it.") -> None:
        """End the run here; in another thread, ask for its end."""
        self._wanted = why
        if not self._at_work and not self.over and not self._session.elsewhere:
            self._end()

    def result(self) -> Recording:
        """Run the rest at once, whatever the speed, and return the recording. Only in the thread of `play`.

        Raises KeyboardInterrupt when the user interrupts that, and whatever `until` raised.
        """
        if not self.over:
            self._work(math.inf)
            self._update()
            if self._session.interrupted:
                raise interrupted()
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
        """Let a picture follow it, and obey its commands."""
        self._show = Show(picture, self._pace.clock)
        picture.on_command = self._commands.append

    def begin(self) -> None:
        """Play on the running event loop; without one, play to the end before returning."""
        try:
            loop = asyncio.get_running_loop()
        except RuntimeError:
            try:
                asyncio.run(self._play())
            except KeyboardInterrupt:
                raise interrupted() from None
            self.result()
        else:
            self._task = loop.create_task(self._play())  # kept, for the loop doesn't

    async def _play(self) -> None:
        clock = self._pace.clock
        try:
            while not self.over:
                began = clock()
                interrupts.listen(self._interrupt)
                self.turn()
                await asyncio.sleep(max(began + FRAME - clock(), FRAME - WORK))
        except asyncio.CancelledError:
            self.stop(INTERRUPTED)
            raise
        await interrupts.leave(self._interrupt)

    def _interrupt(self) -> None:
        self._wanted = INTERRUPTED

    def turn(self, limit: float = math.inf, enough: Callable[[], bool] = lambda: False) -> None:
        """Do what a frame has to: obey, go on as far as is due, show it.

        limit: go on to that time (s) at most. enough: asked between moments whether to go on.
        """
        while self._commands and not self.over:
            with contextlib.suppress(ValueError):  # a picture may send anything
                self._obey(self._commands.popleft())
        clock = self._pace.clock
        self._hand.rest()
        if self._wanted is not None and not self.over:
            self._end()
        if not self.over and not self.paused:
            due, rest = min(self._pace.due(self.stamp), limit), clock() + WORK
            self._work(due, lambda: clock() >= rest or enough())
            if self.stamp < due:
                self._pace.fell_behind()
        self._update()
        if self._session.interrupted:
            interrupts.pass_on()

    def _work(self, limit: float, enough: Callable[[], bool] | None = None) -> None:
        """Go on to `limit`; if that ends the run, clean up after it."""
        if self._session.elsewhere:
            raise RuntimeError("A player goes on only in the thread that called play(); here, stop it.")
        if self._at_work:
            raise RuntimeError("A player can't be moved on from inside its own run; let `until` return True.")
        self._at_work = True
        try:
            self.stamp = max(self.stamp, self._context.run(self._session.advance, limit, enough))
        except Exception as error:
            self._error, self._session.over = error, True
            detail = f"`until` raised {type(error).__name__}: {error}"
            self.recording.ended = Ended("interrupted", self._session.stamp, detail)
        finally:
            self._at_work = False
        if self._session.interrupted and not self.over:
            self._wanted = INTERRUPTED
        if self._wanted is not None and not self.over:
            self._end()

    def _end(self) -> None:
        self.recording.stamp = max(self.recording.stamp, self.stamp)
        ended = Ended("interrupted", self.recording.stamp, self._wanted)
        self._context.run(self._session.end, ended)
        self._update()

    def _quit(self) -> None:
        """Python ends: nobody is there to look at a picture."""
        self._show = Show(None, self._pace.clock)
        self.stop("Python has ended.")

    def _update(self) -> None:
        """Show where it is now; and when it is over, say so and let go of everything."""
        ended = list(self.recording.ended[::2]) if self.over else None
        urgent = {"speed": self.speed, "paused": self.paused, "ended": ended}
        self._show.frame(self._session, self.stamp)
        self._show.state(self._session, self.stamp, self._pace.measured, **urgent)
        if self.over and not self._let_go:
            self._let_go, latest.player = True, None if latest.player is self else latest.player
            atexit.unregister(self._quit)
            # In the context of the caller: what executes notebooks unattended hears only the cell under way.
            self._show.finish(self.recording)
            gc.collect()  # what earlier stretches left

    def _obey(self, command: dict[str, Any]) -> None:
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
                self._show.readings.look(name)
            case {"graph": True}:
                self._show.connections(self.recording)
            case {"drive": [forward, left]}:
                self._context.run(self._hand.drive, forward, left)
