"""QoS events that come as time passes: deadlines, liveliness, lost messages.

The middleware tells of who comes and goes and of what doesn't fit; its clocks know nothing of a run's time.
How Fast DDS does all this was measured: `tests/sim/ros/middleware_facts.txt`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import partial
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

from rclpy.event_handler import EventHandler, QoSPublisherEventType, QoSSubscriptionEventType
from rclpy.qos import LivelinessPolicy, QoSProfile

from sim.nanoseconds import Nanoseconds
from sim.ros.transport.qos import FOREVER

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine
    from sim.ros.transport.writer import Writer

REQUESTED = QoSSubscriptionEventType.RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED
CHANGED = QoSSubscriptionEventType.RCL_SUBSCRIPTION_LIVELINESS_CHANGED
MISSED = QoSSubscriptionEventType.RCL_SUBSCRIPTION_MESSAGE_LOST
OFFERED = QoSPublisherEventType.RCL_PUBLISHER_OFFERED_DEADLINE_MISSED
LOST = QoSPublisherEventType.RCL_PUBLISHER_LIVELINESS_LOST
# What an event counts, for both ends: a kind of one has the number of another kind of the other.
OF_WRITER = {OFFERED: ("total_count",), LOST: ("total_count",)}
OF_READER = {
    REQUESTED: ("total_count",),
    CHANGED: ("alive_count", "not_alive_count"),
    MISSED: ("total_count",),
}


class EventCounts:
    """What one kind of event has counted, and what of that its callback was told."""

    def __init__(self, engine: Engine, counts: Iterable[str]) -> None:
        self._engine = engine
        self._counts = dict.fromkeys(counts, 0)
        self._reported = dict(self._counts)

    def add(self, **changes: int) -> None:
        """Count on."""
        for name, change in changes.items():
            self._counts[name] += change
        self._engine.activity += 1

    def take(self) -> SimpleNamespace | None:
        """What rclpy's callback gets, with all that is new since the last time; None if nothing is."""
        if self._counts == self._reported:
            return None
        changes = {f"{name}_change": count - self._reported[name] for name, count in self._counts.items()}
        self._reported = dict(self._counts)
        return SimpleNamespace(**self._counts, **changes)


def statuses(
    engine: Engine, handlers: Iterable[EventHandler], kinds: Mapping[Any, tuple[str, ...]]
) -> dict[Any, EventCounts]:
    """For those of an end's event handlers that are told of time, by kind. kinds: those of this end."""
    found = {}
    for handler in handlers:
        if handler.event_type in kinds:
            found[handler.event_type] = handler._sim = EventCounts(engine, kinds[handler.event_type])
    return found


class Lease:
    """A length of time in which something has to happen again, once it has happened."""

    def __init__(self, engine: Engine, length: Nanoseconds, over: Callable[[], bool]) -> None:
        """over: called when it is over; whether it begins again by itself."""
        self._engine, self._length, self._over = engine, length, over
        self._due: Nanoseconds | None = None
        self._scheduled = False

    def begin(self) -> None:
        """It happened."""
        self._due = self._engine.now + self._length
        if not self._scheduled:
            self._scheduled = True
            self._engine.agenda.schedule_deadline(self._due, self._look)

    def end(self) -> None:
        """Nobody waits for it any more."""
        self._due = None

    def _look(self) -> None:
        self._scheduled = False
        if self._due is None:
            return
        if self._engine.now >= self._due:
            self._due = self._due + self._length if self._over() else None
        if self._due is not None:
            self._scheduled = True
            self._engine.agenda.schedule_deadline(self._due, self._look)


def deadline(engine: Engine, profile: QoSProfile, status: EventCounts | None) -> Lease | None:
    """What watches over an end's deadline, if it has one and somebody wants to be told."""
    length = profile.deadline.nanoseconds
    if status is None or not 0 < length < FOREVER:
        return None

    def over() -> bool:
        status.add(total_count=1)
        return True

    return Lease(engine, length, over)


def liveliness_lease(engine: Engine, profile: QoSProfile, status: EventCounts | None) -> Lease | None:
    """What watches whether a publisher gives signs of life, if it has promised to, in the same way."""
    length = profile.liveliness_lease_duration.nanoseconds
    manual = profile.liveliness is LivelinessPolicy.MANUAL_BY_TOPIC
    if status is None or not manual or not 0 < length < FOREVER:
        return None
    return Lease(engine, length, lambda: bool(status.add(total_count=1)))


class LivelinessMonitor:
    """Which publishers are alive for a subscription with a lease. length: that of the lease.

    Automatic ones are as long as they are there; others from a sign of life on, for the lease.
    """

    def __init__(self, engine: Engine, length: Nanoseconds, status: EventCounts) -> None:
        self._engine, self._length, self._status = engine, length, status
        self._alive: dict[Writer, bool] = {}
        self._limits: dict[Writer, Lease] = {}

    def matched(self, writer: Writer) -> None:
        """They have found each other."""
        if writer.profile.liveliness is not LivelinessPolicy.MANUAL_BY_TOPIC:
            self._alive[writer] = True
            self._status.add(alive_count=1)
            return
        self._limits[writer] = Lease(self._engine, self._length, partial(self._over, writer))

    def assert_liveliness(self, writer: Writer) -> None:
        """A publisher gave a sign of life: a message came, or it said so."""
        limit = self._limits.get(writer)
        if limit is None:
            return
        if not self._alive.get(writer):
            self._status.add(alive_count=1, not_alive_count=-1 if writer in self._alive else 0)
            self._alive[writer] = True
        limit.begin()

    def unmatched(self, writer: Writer) -> None:
        """It is not there any more."""
        if writer in self._limits:
            self._limits.pop(writer).end()
        alive = self._alive.pop(writer, None)
        if alive is not None:
            self._status.add(**{"alive_count" if alive else "not_alive_count": -1})

    def _over(self, writer: Writer) -> bool:
        self._alive[writer] = False
        self._status.add(alive_count=-1, not_alive_count=1)
        return False


def liveliness(engine: Engine, profile: QoSProfile, status: EventCounts | None) -> LivelinessMonitor | None:
    """What watches over the publishers of a subscription, if it has a lease and somebody wants to know."""
    length = profile.liveliness_lease_duration.nanoseconds
    return LivelinessMonitor(engine, length, status) if status and 0 < length < FOREVER else None
