"""Ctrl-C waits for a message to be written, or it would leave a file that can't be read."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Handle a Ctrl-C within the block at its end. For the main thread, where rclpy's own handler is off."""
    received = False

    def take_note(*_: Any) -> None:
        nonlocal received
        received = True

    handler = signal.signal(signal.SIGINT, take_note)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, handler)
        if received:
            signal.raise_signal(signal.SIGINT)
