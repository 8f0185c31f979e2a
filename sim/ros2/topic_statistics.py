"""Rate, bandwidth and delay of a topic, as `ros2 topic hz`, `bw` and `delay` print them."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Sequence

from sim.nanoseconds import SECOND, Nanoseconds
from sim.ros2.system import CliError, ReceivedMessage

REPORT_PERIOD = 1.0  # s


class TopicStatistic(ABC):
    """A statistic of a topic. window: of so many messages at most."""

    header = ""  # printed first, formatted with the topic's name

    def __init__(self, window: int) -> None:
        self.window = window
        self._reported_at: float | None = None

    @abstractmethod
    def add(self, message: ReceivedMessage) -> None:
        """Add a received message."""

    @abstractmethod
    def text(self, now: float) -> str:
        """The current value as text; empty if there are too few messages."""

    def due(self, now: float) -> str:
        """Work like `text`, but only once a second; otherwise empty."""
        if self._reported_at is None:
            self._reported_at = now
        if now < self._reported_at + REPORT_PERIOD - 1e-9:
            return ""
        self._reported_at = now
        return self.text(now)


def _spread(what: str, values: Sequence[float], mean: float) -> str:
    deviation = math.sqrt(sum((value - mean) ** 2 for value in values) / len(values))
    return (
        f"{what}\n\tmin: {min(values):.3f}s max: {max(values):.3f}s"
        f" std dev: {deviation:.5f}s window: {len(values)}"
    )


class Rate(TopicStatistic):
    """The average rate in Hz."""

    def __init__(self, window: int) -> None:
        super().__init__(window)
        self._last: float | None = None
        self._gaps: deque[float] = deque(maxlen=window)
        self._reported: float | None = None

    def add(self, message: ReceivedMessage) -> None:
        """Work like `TopicStatistic`."""
        if self._last is not None:
            self._gaps.append(message.stamp - self._last)
        self._last = message.stamp

    def text(self, now: float) -> str:
        """Work like `TopicStatistic`; empty if no message came since the last report."""
        if not self._gaps or self._last == self._reported:
            return ""
        self._reported = self._last
        mean = sum(self._gaps) / len(self._gaps)
        return _spread(f"average rate: {1 / mean if mean > 0 else 0:.3f}", self._gaps, mean)


class Bandwidth(TopicStatistic):
    """Bytes per second."""

    header = "Subscribed to [{}]"

    def __init__(self, window: int) -> None:
        super().__init__(window)
        self._sizes: deque[tuple[float, int]] = deque(maxlen=window)

    def add(self, message: ReceivedMessage) -> None:
        """Work like `TopicStatistic`."""
        self._sizes.append((message.stamp, len(message.raw)))

    def text(self, now: float) -> str:
        """Work like `TopicStatistic`."""
        if len(self._sizes) < 2 or now <= self._sizes[0][0]:
            return ""
        sizes = [size for _, size in self._sizes]
        rate = sum(sizes) / (now - self._sizes[0][0])
        shown = [_bytes(value, rate) for value in (rate, sum(sizes) / len(sizes), min(sizes), max(sizes))]
        return (
            f"{shown[0]}/s from {len(sizes)} messages\n"
            f"\tMessage size mean: {shown[1]} min: {shown[2]} max: {shown[3]}"
        )


def _bytes(number: float, unit_of: float) -> str:
    """A number of bytes, in the unit that suits `unit_of`."""
    if unit_of < 1e3:
        return f"{number:.0f} B"
    return f"{number / 1e3:.2f} KB" if unit_of < 1e6 else f"{number / 1e6:.2f} MB"


class Delay(TopicStatistic):
    """The time from a message's header stamp to its reception. epoch: as `System.epoch`."""

    def __init__(self, window: int, epoch: Nanoseconds) -> None:
        super().__init__(window)
        self._epoch = epoch
        self._delays: deque[float] = deque(maxlen=window)
        self._new = False

    def add(self, message: ReceivedMessage) -> None:
        """Work like `TopicStatistic`. Raises CliError for a message without a header."""
        from sim.ros.messages.decoder import decode  # imported late, because numpy is slow

        decoded = decode(message.type, message.raw)
        if not hasattr(decoded, "header"):
            raise CliError("msg does not have header")
        stamp = decoded.header.stamp
        late = self._epoch + round(message.stamp * SECOND) - stamp.sec * SECOND - stamp.nanosec
        self._delays.append(late / SECOND)
        self._new = True

    def text(self, now: float) -> str:
        """Work like `TopicStatistic`."""
        if not self._delays:
            return ""
        if not self._new:
            return "no new messages"
        self._new = False
        mean = sum(self._delays) / len(self._delays)
        return _spread(f"average delay: {mean:.3f}", self._delays, mean)
