"""The engine counts time in whole nanoseconds, as ROS does; recordings and people count in seconds."""

from typing import Any

Nanoseconds = int
SECOND: Nanoseconds = 1_000_000_000
EPOCH: Nanoseconds = 1_735_689_600 * SECOND
"""What clocks show at the start of every run: 2025-01-01 00:00 UTC. Messages have it in their stamps; the
engine and recordings count from the start."""


def nanoseconds(seconds: float) -> Nanoseconds:
    """A length of time in nanoseconds; what is more than nothing stays more than nothing."""
    return max(round(seconds * SECOND), 1 if seconds > 0 else 0)


def in_seconds(duration: Any) -> float:
    """The length of a duration as messages have it, builtin_interfaces/Duration, in seconds."""
    return duration.sec + duration.nanosec / SECOND
