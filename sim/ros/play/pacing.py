"""Paces simulated time to the wall clock."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable
from time import perf_counter

MAX_GAP = 0.25  # s of wall time between calls of `due`; after more, pacing restarts and doesn't catch up
MEASURING_PERIOD = 1.0  # s of wall time


class Pace:
    """Computes the simulated time that is due, and measures the speed that is reached.

    speed: simulated seconds per second; math.inf for as fast as possible. clock: wall time (s).
    Raises ValueError for an invalid speed.
    """

    def __init__(self, speed: float = 1.0, clock: Callable[[], float] = perf_counter) -> None:
        self.clock = clock
        self._samples: deque[tuple[float, float]] = deque()  # (wall time, simulated time) of the last second
        self._start: tuple[float, float] | None = (
            None  # wall time and simulated time since when it runs at this speed
        )
        self.speed = speed

    @property
    def speed(self) -> float:
        """Simulated seconds per second."""
        return self._speed

    @speed.setter
    def speed(self, speed: float) -> None:
        if isinstance(speed, bool) or not isinstance(speed, int | float) or not speed > 0:
            raise ValueError(
                "speed must be a number greater than 0, such as 2.0 for twice as fast as real time; it is "
                f"{speed!r}."
            )
        self._speed = float(speed)
        self.restart()

    def restart(self) -> None:
        """Continue from the current simulated time, however much wall time has passed."""
        self._start = None
        self._samples.clear()

    def due(self, reached: float) -> float:
        """The simulated time (s) that is due now; at least `reached`, the time (s) reached so far."""
        now = self.clock()
        if self._samples and now - self._samples[-1][0] > MAX_GAP:
            self.restart()
        if self._start is None:
            self._start = now, reached
        self._samples.append((now, reached))
        while now - self._samples[0][0] > MEASURING_PERIOD:
            self._samples.popleft()
        since, origin = self._start
        return math.inf if self._speed == math.inf else max(reached, origin + (now - since) * self._speed)

    def fell_behind(self) -> None:
        """The due time was not reached: don't catch up, because that would fall behind even more."""
        self._start = None

    @property
    def measured(self) -> float:
        """Simulated seconds per second over the last second; 0 without measurements."""
        if len(self._samples) < 2:
            return 0.0
        (begin, origin), (end, reached) = self._samples[0], self._samples[-1]
        return (reached - origin) / (end - begin) if end > begin else 0.0
