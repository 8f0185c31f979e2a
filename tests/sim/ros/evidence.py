"""Short ways to what a recording holds, for comparing with lists written by hand."""

from __future__ import annotations

from typing import Any

from sim import Recording


def logged(recording: Recording) -> list[tuple[float, str]]:
    """(stamp, text) of every log line."""
    return [(line.stamp, line.text) for line in recording.logs]


def times(recording: Recording, text: str) -> list[float]:
    """Stamps of the log lines with this text."""
    return [line.stamp for line in recording.logs if line.text == text]


def values(recording: Recording, topic: str) -> list[tuple[float, Any]]:
    """(stamp, data) of every message on a topic of a std_msgs type."""
    return [(received.stamp, received.message.data) for received in recording.messages(topic)]


def why(recording: Recording) -> tuple[str, float, str]:
    """Why the run ended, as a plain tuple."""
    return tuple(recording.ended)


def raised(recording: Recording) -> list[tuple[float, str, str, str, str]]:
    """(stamp, node, callback, type, text) of every exception."""
    return [tuple(error)[:5] for error in recording.errors]
