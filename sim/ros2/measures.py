"""How often messages come, how much of it and how late, in the form of `ros2 topic hz`, `bw` and `delay`."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Sequence

from sim.nanoseconds import SECOND, Nanoseconds
from sim.ros.messages.decoder import decode
from sim.ros2.system import Arrived, Wrong

EVERY = 1.0  # s between two answers


class Measure(ABC):
    """Something that is measured of a topic, over so many messages at most."""

    begin = ""  # what is said first, of the topic's name

    def __init__(self, window: int) -> None:
        self.window = window
        self._said: float | None = None  # when something was said last

    @abstractmethod
    def add(self, arrived: Arrived) -> None:
        """A message has come."""

    @abstractmethod
    def text(self, now: float) -> str:
        """What has been measured by now; nothing where there was too little."""

    def due(self, now: float) -> str:
        """The same, but no more than once in a second."""
        if self._said is None:
            self._said = now
        if now < self._said + EVERY - 1e-9:
            return ""
        self._said = now
        return self.text(now)


def _spread(what: str, values: Sequence[float], mean: float) -> str:
    deviation = math.sqrt(sum((value - mean) ** 2 for value in values) / len(values))
    return (
        f"{what}\n\tmin: {min(values):.3f}s max: {max(values):.3f}s"
        f" std dev: {deviation:.5f}s window: {len(values)}"
    )


class Rate(Measure):
    """The average rate."""

    def __init__(self, window: int) -> None:
        super().__init__(window)
        self._last: float | None = None
        self._gaps: deque[float] = deque(maxlen=window)
        self._told: float | None = None

    def add(self, arrived: Arrived) -> None:
        """As `Measure`."""
        if self._last is not None:
            self._gaps.append(arrived.stamp - self._last)
        self._last = arrived.stamp

    def text(self, now: float) -> str:
        """As `Measure`; nothing where none came since the last time."""
        if not self._gaps or self._last == self._told:
            return ""
        self._told = self._last
        mean = sum(self._gaps) / len(self._gaps)
        return _spread(f"average rate: {1 / mean if mean > 0 else 0:.3f}", self._gaps, mean)


class Bandwidth(Measure):
    """Bytes a second."""

    begin = "Subscribed to [{}]"

    def __init__(self, window: int) -> None:
        super().__init__(window)
        self._sizes: deque[tuple[float, int]] = deque(maxlen=window)

    def add(self, arrived: Arrived) -> None:
        """As `Measure`."""
        self._sizes.append((arrived.stamp, len(arrived.raw)))

    def text(self, now: float) -> str:
        """As `Measure`."""
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
    """A number of bytes, in the unit that suits another."""
    if unit_of < 1e3:
        return f"{number:.0f} B"
    return f"{number / 1e3:.2f} KB" if unit_of < 1e6 else f"{number / 1e6:.2f} MB"


class Delay(Measure):
    """How long ago a message was stamped as it came. epoch: as of a `System`."""

    def __init__(self, window: int, epoch: Nanoseconds) -> None:
        super().__init__(window)
        self._epoch = epoch
        self._delays: deque[float] = deque(maxlen=window)
        self._new = False

    def add(self, arrived: Arrived) -> None:
        """As `Measure`. Raises Wrong for a message without a stamp."""
        message = decode(arrived.type, arrived.raw)
        if not hasattr(message, "header"):
            raise Wrong("msg does not have header")
        stamp = message.header.stamp
        late = self._epoch + round(arrived.stamp * SECOND) - stamp.sec * SECOND - stamp.nanosec
        self._delays.append(late / SECOND)
        self._new = True

    def text(self, now: float) -> str:
        """As `Measure`."""
        if not self._delays:
            return ""
        if not self._new:
            return "no new messages"
        self._new = False
        mean = sum(self._delays) / len(self._delays)
        return _spread(f"average delay: {mean:.3f}", self._delays, mean)
