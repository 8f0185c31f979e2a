"""The stored transforms of one frame to its parent.

Times are nanoseconds; a lookup at time 0 returns the latest transform.
"""

from bisect import bisect_left, bisect_right
from typing import NamedTuple

from tf2_py.errors import ExtrapolationException
from tf2_py.rigid_transform import RigidTransform, interpolate

Nanoseconds = int


class StoredTransform(NamedTuple):
    """A transform of a frame to its parent, with its stamp."""

    stamp: Nanoseconds
    parent: str
    transform: RigidTransform


class TimeCache:
    """The transforms of a moving frame, ordered by stamp."""

    def __init__(self, cache_time: Nanoseconds) -> None:
        """cache_time: the greatest age of a stored transform, counted from the latest one."""
        self._cache_time = cache_time
        self._stored: list[StoredTransform] = []
        self._stamps: list[Nanoseconds] = []

    def __len__(self) -> int:
        return len(self._stored)

    @property
    def latest(self) -> StoredTransform | None:
        """The latest transform, if there is one."""
        return self._stored[-1] if self._stored else None

    @property
    def span(self) -> tuple[Nanoseconds, Nanoseconds]:
        """The oldest and the latest stamp."""
        return (self._stamps[0], self._stamps[-1]) if self._stamps else (0, 0)

    def insert(self, transform: StoredTransform) -> bool:
        """Store a transform. Returns False, and stores nothing, if it is too old."""
        stamps = self._stamps
        if stamps:
            limit = stamps[-1] - self._cache_time
            expired = bisect_left(stamps, limit)
            del stamps[:expired], self._stored[:expired]
            if transform.stamp < limit:
                return False
        at = bisect_right(stamps, transform.stamp)
        if transform not in self._stored[bisect_left(stamps, transform.stamp) : at]:
            stamps.insert(at, transform.stamp)
            self._stored.insert(at, transform)
        return True

    def lookup(self, time: Nanoseconds) -> StoredTransform:
        """The transform at this time, interpolated between two stored ones if necessary.

        Raises:
            ExtrapolationException: the time is before the oldest transform or after the latest.
        """
        stamps = self._stamps
        if stamps and (time == 0 or time == stamps[-1]):
            return self._stored[-1]
        if len(stamps) < 2 and (not stamps or time != stamps[0]):
            only = stamps[0] if stamps else 0
            raise ExtrapolationException(
                f"Lookup would require extrapolation at time {format_seconds(time)}, "
                f"but only time {format_seconds(only)} is in the buffer"
            )
        if time > stamps[-1]:
            raise ExtrapolationException(
                f"Lookup would require extrapolation into the future.  Requested time {format_seconds(time)} "
                f"but the latest data is at time {format_seconds(stamps[-1])}"
            )
        if time < stamps[0]:
            raise ExtrapolationException(
                f"Lookup would require extrapolation into the past.  Requested time {format_seconds(time)} "
                f"but the earliest data is at time {format_seconds(stamps[0])}"
            )
        return self._interpolate(time)

    def _interpolate(self, time: Nanoseconds) -> StoredTransform:
        at = bisect_right(self._stamps, time)
        before, after = self._stored[at - 1], self._stored[at]
        if before.stamp == time or before.parent != after.parent:
            return before
        ratio = (time - before.stamp) / (after.stamp - before.stamp)
        transform = interpolate(before.transform, after.transform, ratio)
        return StoredTransform(time, before.parent, transform)

    def clear(self) -> None:
        """Remove all transforms."""
        self._stored.clear()
        self._stamps.clear()


class StaticCache:
    """The transform of a static frame: the one that was inserted last, valid at any time."""

    latest: StoredTransform | None = None
    span = 0, 0

    def __len__(self) -> int:
        return 1

    def insert(self, transform: StoredTransform) -> bool:
        """Replace the transform."""
        self.latest = transform._replace(stamp=0)
        return True

    def lookup(self, time: Nanoseconds) -> StoredTransform:
        """The transform."""
        return self.latest

    def clear(self) -> None:
        """Keep the transform: static transforms are published once, and would never be received again."""


FrameCache = TimeCache | StaticCache


def format_seconds(time: Nanoseconds) -> str:
    """A time as upstream prints it."""
    return f"{time / 1e9:.6f}"
