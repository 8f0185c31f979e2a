"""How tests wait for what other processes and threads do: until a condition holds, however slow the machine.

No outcome depends on a limit of time: `PATIENCE` is there only to end a test whose other side hangs. Where a
test is about a limit that passes, what is waited for is blocked, so that no machine is fast enough for it.
"""

import time
from collections.abc import Callable
from typing import TypeVar

PATIENCE = 600.0  # s of wall time
BETWEEN = 0.01  # s between two looks at a condition
Found = TypeVar("Found")


def until(condition: Callable[[], Found], what: str = "") -> Found:
    """Wait until the condition gives something true, and return that. what: named if it never does."""
    end = time.monotonic() + PATIENCE
    while not (found := condition()):
        assert time.monotonic() < end, f"waited {PATIENCE:g} s in vain{what and ' for '}{what}"
        time.sleep(BETWEEN)
    return found
