"""QoS events that come as time passes: deadlines, liveliness, lost messages.

The middleware reports matched and incompatible endpoints; its clocks know nothing of simulated time, so the
rest is here. How Fast DDS does all this was measured: `tests/sim/ros/middleware_facts.txt`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import partial
from types import SimpleNamespace
from typing import Any

from rclpy.event_handler import EventHandler, QoSPublisherEventType, QoSSubscriptionEventType
from rclpy.qos import LivelinessPolicy, QoSProfile

from sim.nanoseconds import Nanoseconds
from sim.ros.attached import Attached
from sim.ros.fibers.scheduler import Scheduler
from sim.ros.transport.context import TransportContext
from sim.ros.transport.endpoint import TopicEndpoint
from sim.ros.transport.qos import FOREVER

REQUESTED = QoSSubscriptionEventType.RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED
CHANGED = QoSSubscriptionEventType.RCL_SUBSCRIPTION_LIVELINESS_CHANGED
MESSAGE_LOST = QoSSubscriptionEventType.RCL_SUBSCRIPTION_MESSAGE_LOST
OFFERED = QoSPublisherEventType.RCL_PUBLISHER_OFFERED_DEADLINE_MISSED
LIVELINESS_LOST = QoSPublisherEventType.RCL_PUBLISHER_LIVELINESS_LOST
# What an event counts. One table for each kind of endpoint: their event types share their numbers.
OF_WRITER = {OFFERED: ("total_count",), LIVELINESS_LOST: ("total_count",)}
OF_READER = {
    REQUESTED: ("total_count",),
    CHANGED: ("alive_count", "not_alive_count"),
    MESSAGE_LOST: ("total_count",),
}


class EventCounts:
    """Counts of one kind of event, and how much of that its callback has been given."""

    def __init__(self, scheduler: Scheduler, counts: Iterable[str]) -> None:
        self._scheduler = scheduler
        self._counts = dict.fromkeys(counts, 0)
        self._reported = dict(self._counts)

    def add(self, **changes: int) -> None:
        """Change these counts."""
        for name, change in changes.items():
            self._counts[name] += change
        self._scheduler.wake_all()

    def take(self) -> SimpleNamespace | None:
        """Return what rclpy's callback gets, with all changes since the last time; None if there are none."""
        if self._counts == self._reported:
            return None
        changes = {f"{name}_change": count - self._reported[name] for name, count in self._counts.items()}
        self._reported = dict(self._counts)
        return SimpleNamespace(**self._counts, **changes)


EVENT_COUNTS = Attached[EventCounts]()  # of an EventHandler whose events depend on time


def event_counts(
    run: TransportContext, handlers: Iterable[EventHandler], kinds: Mapping[Any, tuple[str, ...]]
) -> dict[Any, EventCounts]:
    """The counts for those of an endpoint's event handlers whose events depend on time, by kind.

    kinds: what such events count at this kind of endpoint.
    """
    found = {}
    for handler in handlers:
        if handler.event_type in kinds:
            counts = EventCounts(run.scheduler, kinds[handler.event_type])
            found[handler.event_type] = EVENT_COUNTS.attach(handler, counts)
    return found


class Lease:
    """A length of time in which something has to happen again, once it has happened."""

    def __init__(self, run: TransportContext, length: Nanoseconds, on_expired: Callable[[], bool]) -> None:
        """on_expired: called when it expires; whether it begins again by itself."""
        self._run, self._length, self._on_expired = run, length, on_expired
        self._due: Nanoseconds | None = None
        self._scheduled = False

    def renew(self) -> None:
        """Note that it happened."""
        self._due = self._run.scheduler.now + self._length
        if not self._scheduled:
            self._schedule()

    def cancel(self) -> None:
        """Stop waiting: it need not happen any more."""
        self._due = None

    def _schedule(self) -> None:
        self._scheduled = True
        self._run.events.schedule_deadline(self._due, self._check)

    def _check(self) -> None:
        self._scheduled = False
        if self._due is None:
            return
        if self._run.scheduler.now >= self._due:
            self._due = self._due + self._length if self._on_expired() else None
        if self._due is not None:
            self._schedule()


def deadline_lease(run: TransportContext, profile: QoSProfile, counts: EventCounts | None) -> Lease | None:
    """The lease of an endpoint's deadline, if it has one and a callback for missing it."""
    length = profile.deadline.nanoseconds
    if counts is None or not 0 < length < FOREVER:
        return None

    def on_expired() -> bool:
        counts.add(total_count=1)
        return True

    return Lease(run, length, on_expired)


def liveliness_lease(run: TransportContext, profile: QoSProfile, counts: EventCounts | None) -> Lease | None:
    """The lease of a publisher's manual liveliness, if it has one and a callback for losing it."""
    length = profile.liveliness_lease_duration.nanoseconds
    manual = profile.liveliness is LivelinessPolicy.MANUAL_BY_TOPIC
    if counts is None or not manual or not 0 < length < FOREVER:
        return None
    return Lease(run, length, lambda: bool(counts.add(total_count=1)))


class LivelinessMonitor:
    """The publishers that are alive for a subscription with a lease. length: that of the lease.

    Automatic ones are as long as they exist; others from an assertion on, for the lease.
    """

    def __init__(self, run: TransportContext, length: Nanoseconds, counts: EventCounts) -> None:
        self._run, self._length, self._counts = run, length, counts
        self._alive: dict[TopicEndpoint, bool] = {}
        self._leases: dict[TopicEndpoint, Lease] = {}

    def matched(self, writer: TopicEndpoint) -> None:
        """A publisher and the subscription are connected."""
        if writer.profile.liveliness is not LivelinessPolicy.MANUAL_BY_TOPIC:
            self._alive[writer] = True
            self._counts.add(alive_count=1)
            return
        self._leases[writer] = Lease(self._run, self._length, partial(self._on_expired, writer))

    def assert_liveliness(self, writer: TopicEndpoint) -> None:
        """A message of a publisher came, or its assertion."""
        lease = self._leases.get(writer)
        if lease is None:
            return
        if not self._alive.get(writer):
            self._counts.add(alive_count=1, not_alive_count=-1 if writer in self._alive else 0)
            self._alive[writer] = True
        lease.renew()

    def unmatched(self, writer: TopicEndpoint) -> None:
        """A publisher was destroyed."""
        if writer in self._leases:
            self._leases.pop(writer).cancel()
        alive = self._alive.pop(writer, None)
        if alive is not None:
            self._counts.add(**{"alive_count" if alive else "not_alive_count": -1})

    def _on_expired(self, writer: TopicEndpoint) -> bool:
        self._alive[writer] = False
        self._counts.add(alive_count=-1, not_alive_count=1)
        return False


def liveliness_monitor(
    run: TransportContext, profile: QoSProfile, counts: EventCounts | None
) -> LivelinessMonitor | None:
    """Return what watches the publishers of a subscription, if it has a lease and a callback for changes."""
    length = profile.liveliness_lease_duration.nanoseconds
    return LivelinessMonitor(run, length, counts) if counts and 0 < length < FOREVER else None
