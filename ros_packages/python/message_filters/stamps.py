"""The stamp of a message, or the present time for a message without a header."""

from __future__ import annotations

from typing import Any

from rclpy.clock import ROSClock
from rclpy.logging import LoggingSeverity, get_logger
from rclpy.time import Time


def stamp_of(msg: Any, *, allow_headerless: bool, logger: str, warning: str) -> Time | None:
    """The time in the message's header; without one, the present time if allowed, or None and a warning."""
    stamp = getattr(getattr(msg, "header", None), "stamp", None)
    if stamp is not None:
        return stamp if hasattr(stamp, "nanoseconds") else Time.from_msg(stamp)
    if allow_headerless:
        return ROSClock().now()
    warnings = get_logger(logger)
    warnings.set_level(LoggingSeverity.INFO)
    warnings.warning(warning)
    return None
