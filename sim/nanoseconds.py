"""The engine counts time in whole nanoseconds, as ROS does; recordings and people count in seconds."""

Nanoseconds = int
SECOND: Nanoseconds = 1_000_000_000


def nanoseconds(seconds: float) -> Nanoseconds:
    """A length of time in nanoseconds; what is more than nothing stays more than nothing."""
    return max(round(seconds * SECOND), 1 if seconds > 0 else 0)
