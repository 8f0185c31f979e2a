import math
import os
import signal
import threading
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from sim import Recording, run
from sim.nanoseconds import SECOND
from sim.ros.engine import guard
from sim.ros.fibers.scheduler import active
from tests.students.engine import mains


@pytest.fixture
def interrupt(monkeypatch) -> Iterator[Callable[[Recording], None]]:
    """`until` of a run, which has this process interrupted by another thread once the run is at 1 s.

    Until then no loop counts as a hang, however late that thread has its turn. Afterwards all is as before.
    """
    handlers = [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGALRM)]
    usual, limit = run(mains.classic, seconds=2, quiet=True).digest, guard.COMPUTING_LIMIT
    engines: list[Any] = []
    over = threading.Event()

    def send() -> None:
        while not (engines and engines[0].now >= SECOND):
            if over.wait(0.002):
                return
        guard.COMPUTING_LIMIT = limit
        os.kill(os.getpid(), signal.SIGINT)

    monkeypatch.setattr(guard, "COMPUTING_LIMIT", math.inf)
    sender = threading.Thread(target=send)
    sender.start()
    yield lambda _: engines.append(active()) if not engines else None
    over.set()
    sender.join()
    assert active() is None
    assert [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGALRM)] == handlers
    assert signal.getitimer(signal.ITIMER_REAL) == (0.0, 0.0)
    assert run(mains.classic, seconds=2, quiet=True).digest == usual
