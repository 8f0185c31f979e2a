"""The Stop button during a play: an idle notebook's kernel ignores it, so the player handles it."""

from __future__ import annotations

import asyncio
import signal
import threading
from collections.abc import Callable
from types import FrameType

TRIES, PAUSE = 30, 1 / 30  # s of wall time

_to: Callable[[], None] | None = None  # called for each interrupt
_installed = False


def _on_interrupt(number: int, frame: FrameType | None) -> None:
    if _to is not None:
        _to()


def _main_thread() -> bool:
    return threading.current_thread() is threading.main_thread()


def listen(to: Callable[[], None]) -> None:
    """Call this for interrupts where they are ignored; while a cell runs, they are the cell's."""
    global _to, _installed
    _to = to
    if _main_thread() and signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, _on_interrupt)
        _installed = True


async def leave(to: Callable[[], None]) -> None:
    """Ignore them again, unless another callback is registered by now."""
    global _to, _installed
    _to = None if _to == to else _to
    for _ in range(TRIES):  # while a cell runs, the kernel has put its own handler there
        if _to is not None or not _installed:
            return
        if signal.getsignal(signal.SIGINT) is _on_interrupt:
            signal.signal(signal.SIGINT, signal.SIG_IGN)
            _installed = False
            return
        await asyncio.sleep(PAUSE)


def pass_on() -> None:
    """Let the cell that waits for the player, or the program, be interrupted too."""
    if _main_thread() and signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        signal.raise_signal(signal.SIGINT)  # the default one would end the event loop
