"""How simulated time goes along with the clock on the wall."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable
from time import perf_counter

LATE = 0.25  # s of wall time between two looks; after more, the pace starts anew instead of catching up
MEASURED_OVER = 1.0  # s of wall time


class Pace:
    """Says how far simulated time should have come by now, and measures how fast it really goes.

    speed: simulated seconds per second; math.inf for as fast as it goes. clock: seconds of wall time.
    Raises ValueError for a speed that is none.
    """

    def __init__(self, speed: float = 1.0, clock: Callable[[], float] = perf_counter) -> None:
        self.clock = clock
        self._looks: deque[tuple[float, float]] = deque()  # (wall time, simulated time) of the last second
        self._start: tuple[float, float] | None = None  # when and from where it has gone at this speed
        self.speed = speed

    @property
    def speed(self) -> float:
        """Simulated seconds per second."""
        return self._speed

    @speed.setter
    def speed(self, speed: float) -> None:
        if isinstance(speed, bool) or not isinstance(speed, int | float) or not speed > 0:
            raise ValueError(
                "speed must be a number more than 0, such as 2.0 for twice as fast as real time;"
                f" it is {speed!r}."
            )
        self._speed = float(speed)
        self.start_anew()

    def start_anew(self) -> None:
        """Go on from where it is now, whatever the clock did meanwhile."""
        self._start = None
        self._looks.clear()

    def due(self, reached: float) -> float:
        """The simulated time (s) to go on to now. reached: how far it has come; there is no way back."""
        now = self.clock()
        if self._looks and now - self._looks[-1][0] > LATE:
            self.start_anew()
        if self._start is None:
            self._start = now, reached
        self._looks.append((now, reached))
        while now - self._looks[0][0] > MEASURED_OVER:
            self._looks.popleft()
        since, origin = self._start
        return math.inf if self._speed == math.inf else max(reached, origin + (now - since) * self._speed)

    def fell_behind(self) -> None:
        """It came less far than was due: don't catch up, for that would only get worse."""
        self._start = None

    @property
    def measured(self) -> float:
        """Simulated seconds per second over the last second; 0 while there is nothing to measure."""
        if len(self._looks) < 2:
            return 0.0
        (begin, origin), (end, reached) = self._looks[0], self._looks[-1]
        return (reached - origin) / (end - begin) if end > begin else 0.0
