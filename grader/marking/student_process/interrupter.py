"""Interrupts a cell that takes too long, like the notebook's Stop button."""

from __future__ import annotations

import contextlib
import signal
import threading
from collections.abc import Iterator

AGAIN = 3.0  # s of wall time; code may catch the first interrupt


class Interrupter:
    """Interrupts the main thread when it takes too long; at other times SIGINT is ignored.

    A thread watches the time because a run inside the cell uses the timer signals.
    """

    def __init__(self) -> None:
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        self._over = threading.Event()

    @contextlib.contextmanager
    def limit(self, seconds: float) -> Iterator[None]:
        """Interrupt what runs inside after so many seconds of wall time."""
        self._over = threading.Event()
        watch = threading.Thread(target=_watch, args=(self._over, seconds), daemon=True)
        signal.signal(signal.SIGINT, signal.default_int_handler)
        watch.start()
        try:
            yield
        finally:
            signal.signal(signal.SIGINT, signal.SIG_IGN)
            self._over.set()
            watch.join()

    def stop(self) -> None:
        """Interrupt no more: the caller limits the time from here on."""
        self._over.set()


def _watch(over: threading.Event, seconds: float) -> None:
    main = threading.main_thread().ident
    while not over.wait(seconds):
        seconds = AGAIN
        if main is not None:
            signal.pthread_kill(main, signal.SIGINT)
