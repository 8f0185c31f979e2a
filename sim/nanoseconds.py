"""Converts between seconds and whole nanoseconds: the engine uses nanoseconds, recordings use seconds."""

from typing import Any

Nanoseconds = int
SECOND: Nanoseconds = 1_000_000_000
EPOCH: Nanoseconds = 1_735_689_600 * SECOND
"""The clock time at the start of every run: 2025-01-01 00:00 UTC. Stamps in messages include it; the engine
and recordings count from the start of the run."""
UPTIME: Nanoseconds = 10_800 * SECOND  # such that (UPTIME + 0.1) - UPTIME >= 0.1 in floating point, too
"""What clocks that count from the start of the machine, such as the steady one, show as a run starts."""


def nanoseconds(seconds: float) -> Nanoseconds:
    """A duration in nanoseconds; a positive duration is at least 1 ns."""
    return max(round(seconds * SECOND), 1 if seconds > 0 else 0)


def in_seconds(duration: Any) -> float:
    """A builtin_interfaces/Duration in seconds."""
    seconds: float = duration.sec + duration.nanosec / SECOND
    return seconds
