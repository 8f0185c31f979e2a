"""The signals that a process gets when it doesn't exit on request."""

from __future__ import annotations

import asyncio
import signal
from collections.abc import Callable, Sequence

from launch.logging import Logger

_ESCALATION = (("SIGINT", signal.SIGTERM), ("SIGTERM", signal.SIGKILL))


async def escalate_signals(
    send_signal: Callable[[signal.Signals], None],
    logger: Logger,
    name: str,
    delays: Sequence[float],
    elapsed: Sequence[str],
) -> None:
    """Send a process SIGTERM after the first delay (s) and SIGKILL after the second. Cancel it on exit.

    elapsed: the seconds since SIGINT at both times, as they are logged.
    """
    for (before, number), delay, seconds in zip(_ESCALATION, delays, elapsed, strict=True):
        await asyncio.sleep(delay)
        logger.error(
            f"process[{name}] failed to terminate '{seconds}' seconds after receiving '{before}', "
            f"escalating to '{number.name}'"
        )
        send_signal(number)
