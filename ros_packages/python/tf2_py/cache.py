"""What is known of one frame: where it was in its parent, and when.

Times are nanoseconds, and 0 asks for the newest.
"""

from bisect import bisect_left, bisect_right
from typing import NamedTuple

from tf2_py.errors import ExtrapolationException
from tf2_py.rigid import Motion, between

Nanoseconds = int


class Known(NamedTuple):
    """Where a frame was in its parent."""

    stamp: Nanoseconds
    parent: str
    motion: Motion


class MovingFrame:
    """A frame that moves: its transforms of the last seconds, the oldest first."""

    def __init__(self, length: Nanoseconds) -> None:
        """length: how far back it remembers, from the newest."""
        self._length = length
        self._known: list[Known] = []
        self._stamps: list[Nanoseconds] = []

    def __len__(self) -> int:
        return len(self._known)

    @property
    def newest(self) -> Known | None:
        """The newest transform, if there is one."""
        return self._known[-1] if self._known else None

    @property
    def span(self) -> tuple[Nanoseconds, Nanoseconds]:
        """The oldest and the newest stamp."""
        return (self._stamps[0], self._stamps[-1]) if self._stamps else (0, 0)

    def insert(self, known: Known) -> bool:
        """Remember it, in the order of stamps. False: it is older than what is remembered at all."""
        stamps = self._stamps
        if stamps:
            limit = stamps[-1] - self._length
            gone = bisect_left(stamps, limit)
            del stamps[:gone], self._known[:gone]
            if known.stamp < limit:
                return False
        at = bisect_right(stamps, known.stamp)
        if known not in self._known[bisect_left(stamps, known.stamp) : at]:
            stamps.insert(at, known.stamp)
            self._known.insert(at, known)
        return True

    def at(self, time: Nanoseconds) -> Known:
        """Where the frame was at this time, between two that are known if need be.

        Raises:
            ExtrapolationException: the time is before the oldest or after the newest.
        """
        stamps = self._stamps
        if stamps and (time == 0 or time == stamps[-1]):
            return self._known[-1]
        if len(stamps) < 2 and (not stamps or time != stamps[0]):
            only = stamps[0] if stamps else 0
            raise ExtrapolationException(
                f"Lookup would require extrapolation at time {seconds(time)}, "
                f"but only time {seconds(only)} is in the buffer"
            )
        if time > stamps[-1]:
            raise ExtrapolationException(
                f"Lookup would require extrapolation into the future.  Requested time {seconds(time)} "
                f"but the latest data is at time {seconds(stamps[-1])}"
            )
        if time < stamps[0]:
            raise ExtrapolationException(
                f"Lookup would require extrapolation into the past.  Requested time {seconds(time)} "
                f"but the earliest data is at time {seconds(stamps[0])}"
            )
        return self._between(time)

    def _between(self, time: Nanoseconds) -> Known:
        at = bisect_right(self._stamps, time)
        before, after = self._known[at - 1], self._known[at]
        if before.stamp == time or before.parent != after.parent:
            return before
        ratio = (time - before.stamp) / (after.stamp - before.stamp)
        return Known(time, before.parent, between(before.motion, after.motion, ratio))

    def clear(self) -> None:
        """Forget all."""
        self._known.clear()
        self._stamps.clear()


class StaticFrame:
    """A frame that never moves in its parent: the last word holds for all times."""

    newest: Known | None = None
    span = 0, 0

    def __len__(self) -> int:
        return 1

    def insert(self, known: Known) -> bool:
        """Remember it in place of what was said before."""
        self.newest = known._replace(stamp=0)
        return True

    def at(self, time: Nanoseconds) -> Known:
        """Where the frame is, at all times."""
        return self.newest

    def clear(self) -> None:
        """Forget nothing: it is published once, and would never come again."""


Frame = MovingFrame | StaticFrame


def seconds(time: Nanoseconds) -> str:
    """A time as upstream writes it."""
    return f"{time / 1e9:.6f}"
