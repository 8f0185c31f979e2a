"""What the QoS profiles of two endpoints of a topic mean for the messages between them."""

from __future__ import annotations

import copy
from collections.abc import Callable

from rclpy.duration import Duration
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSCompatibility,
    QoSProfile,
    ReliabilityPolicy,
    qos_check_compatible,
)

# All others leave the choice to the middleware.
RELIABILITIES = ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_EFFORT
DURABILITIES = DurabilityPolicy.TRANSIENT_LOCAL, DurabilityPolicy.VOLATILE
# "Without limit" in rclpy, and in the middleware, in nanoseconds.
NO_LIMIT, FOREVER = Duration(), 2**63 - 1


def are_compatible(offered: QoSProfile, requested: QoSProfile) -> bool:
    """Return whether a subscription receives from a publisher."""
    compatibility, _ = qos_check_compatible(offered, requested)
    return compatibility != QoSCompatibility.ERROR


def latches(profile: QoSProfile) -> bool:
    """Return whether an endpoint is latched: a late joiner gets earlier messages if both ends are."""
    return (
        profile.durability is DurabilityPolicy.TRANSIENT_LOCAL
        and profile.reliability is ReliabilityPolicy.RELIABLE
    )


def queue_length(profile: QoSProfile) -> int | None:
    """Return how many messages wait at most; None: without limit."""
    return None if profile.history is HistoryPolicy.KEEP_ALL else max(profile.depth, 1)


def resolved(profile: QoSProfile, found: Callable[[], list[dict]]) -> QoSProfile:
    """The profile, with what the middleware has chosen where the profile leaves it the choice.

    found: gives rclpy's information on such endpoints of this topic, the newest last.
    """
    chosen = copy.copy(profile)
    if chosen.liveliness is LivelinessPolicy.SYSTEM_DEFAULT:
        chosen.liveliness = LivelinessPolicy.AUTOMATIC
    if profile.reliability in RELIABILITIES and profile.durability in DURABILITIES:
        return chosen
    created_at = QoSProfile(**found()[-1]["qos_profile"])
    chosen.reliability, chosen.durability = created_at.reliability, created_at.durability
    chosen.liveliness = created_at.liveliness
    for name in ("deadline", "liveliness_lease_duration"):
        limit = getattr(created_at, name)
        setattr(chosen, name, limit if limit.nanoseconds < FOREVER else NO_LIMIT)
    return chosen
