"""Quality of service as plain data, and what it means for a connection."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

FOREVER = 9e9  # s; rclpy says "without limit" as 0, and as all that 63 bits of nanoseconds hold
_POLICIES = ("reliability", "durability", "history", "liveliness")
_LIMITS = ("deadline", "lifespan", "liveliness_lease_duration")
# Of one policy, from the weakest offer to the strongest: a publisher must offer what is asked for, or more.
_STRENGTHS = {
    "reliability": ("best_effort", "reliable"),
    "durability": ("volatile", "transient_local"),
    "liveliness": ("automatic", "manual_by_topic"),
}
_LENGTHS = {"deadline": "deadline", "liveliness_lease_duration": "liveliness lease"}


def settings(profile: Any) -> dict[str, Any]:
    """Return what an rclpy `QoSProfile` sets: policies as words in small letters, durations in seconds.

    A duration is None where it has no limit.
    """
    chosen = {name: getattr(profile, name).name.lower() for name in _POLICIES} | {"depth": profile.depth}
    if chosen["liveliness"] == "system_default":
        chosen["liveliness"] = "automatic"  # what the middleware makes of it
    for name in _LIMITS:
        seconds = getattr(profile, name).nanoseconds * 1e-9
        chosen[name] = seconds if 0 < seconds < FOREVER else None
    return chosen


def refusal(offered: Mapping[str, Any], wanted: Mapping[str, Any]) -> tuple[str, str, str] | None:
    """Return why a subscription receives nothing from a publisher: the policy, what's offered and requested.

    None where the two fit. What isn't known of one of them fits.
    """
    for policy, strengths in _STRENGTHS.items():
        given, requested = offered.get(policy), wanted.get(policy)
        if given in strengths and requested in strengths[strengths.index(given) + 1 :]:
            return policy, given, requested
    for limit, name in _LENGTHS.items():
        given, requested = offered.get(limit), wanted.get(limit)
        if requested is not None and limit in offered and (given is None or given > requested):
            return name, "" if given is None else f"{given:g} s", f"{requested:g} s"
    return None


def offer(policy: str, offered: str) -> str:
    """Return how a publisher publishes, for a sentence; of what `refusal` gives."""
    return f"with {policy} {offered}" if offered else f"without a {policy}"
