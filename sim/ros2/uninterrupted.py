"""Ctrl-C waits until a file is complete, or it would leave one that can't be read."""

from __future__ import annotations

import signal
from collections.abc import Iterator, Sequence
from contextlib import contextmanager


@contextmanager
def uninterrupted() -> Iterator[Sequence[int]]:
    """Handle Ctrl-C at the end of the block; yields the signals so far, so that the block can end soon.

    For the main thread, where rclpy's own handler is off.
    """
    received: list[int] = []
    handler = signal.signal(signal.SIGINT, lambda number, _: received.append(number))
    try:
        yield received
    finally:
        signal.signal(signal.SIGINT, handler)
        if received:
            signal.raise_signal(signal.SIGINT)
