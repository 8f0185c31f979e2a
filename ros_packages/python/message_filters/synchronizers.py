"""Combine messages of several topics whose stamps match."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from threading import Lock
from typing import Any

from rclpy.duration import Duration
from rclpy.time import Time

from message_filters.simple_filter import SimpleFilter
from message_filters.stamps import stamp_of

# Upstream's words.
WARNING = (
    "can not use message filters for messages without timestamp infomation when 'allow_headerless' is "
    "disabled. auto assign ROSTIME to headerless messages once enabling constructor option of "
    "'allow_headerless'."
)


class TimeSynchronizer(SimpleFilter):
    """Passes on one message of each input whenever all have one with the same stamp."""

    def __init__(self, fs: Sequence[SimpleFilter], queue_size: int) -> None:
        """queue_size: how many messages of each input wait for the others; the newest stamps stay."""
        super().__init__()
        self.connectInput(fs)
        self.queue_size = queue_size
        self.passed_on = 0  # sets of messages
        self.lock = Lock()

    def connectInput(self, fs: Sequence[SimpleFilter]) -> None:
        """Combine the outputs of these filters; callbacks get their messages in this order."""
        self.queues: list[dict[int, Any]] = [{} for _ in fs]  # nanoseconds -> message
        self.input_connections = [
            f.registerCallback(self.add, queue, index)
            for index, (f, queue) in enumerate(zip(fs, self.queues, strict=True))
        ]

    def add(self, msg: Any, my_queue: dict[int, Any], my_queue_index: int | None = None) -> None:
        """Add a message of one input, and pass on what is complete."""
        with self.lock:
            self._store(msg, Time.from_msg(msg.header.stamp).nanoseconds, my_queue)
            for stamp in sorted(set.intersection(*map(set, self.queues))):
                self._pass_on([stamp] * len(self.queues))

    def _store(self, msg: Any, stamp: int, queue: dict[int, Any]) -> None:
        queue[stamp] = msg
        while len(queue) > self.queue_size:
            del queue[min(queue)]

    def _pass_on(self, stamps: Sequence[int]) -> None:
        self.passed_on += 1
        self.signalMessage(*(queue[stamp] for queue, stamp in zip(self.queues, stamps, strict=True)))
        for queue, stamp in zip(self.queues, stamps, strict=True):
            del queue[stamp]


class ApproximateTimeSynchronizer(TimeSynchronizer):
    """Passes on one message of each input whenever their stamps are less than `slop` seconds apart."""

    def __init__(
        self, fs: Sequence[SimpleFilter], queue_size: int, slop: float, allow_headerless: bool = False
    ) -> None:
        """allow_headerless: accept messages without a header, at the present time."""
        super().__init__(fs, queue_size)
        self.slop = Duration(seconds=slop)
        self.allow_headerless = allow_headerless

    def add(self, msg: Any, my_queue: dict[int, Any], my_queue_index: int | None = None) -> None:
        """Add a message of one input, and pass on the combination that is nearest to it, if there is one."""
        time = stamp_of(
            msg, allow_headerless=self.allow_headerless, logger="message_filters_approx", warning=WARNING
        )
        if time is None:
            return
        stamp, slop = time.nanoseconds, self.slop.nanoseconds
        with self.lock:
            self._store(msg, stamp, my_queue)
            if my_queue_index is not None and stamp not in my_queue:
                return  # older than all that wait in a full queue
            choices = [
                [stamp] if index == my_queue_index else _nearest(queue, stamp, slop)
                for index, queue in enumerate(self.queues)
            ]
            for stamps in itertools.product(*choices):
                if max(stamps) - min(stamps) < slop:
                    self._pass_on(stamps)
                    return


def _nearest(queue: dict[int, Any], stamp: int, slop: int) -> list[int]:
    """The stamps in a queue that are at most `slop` from this one, the nearest first."""
    near = [other for other in queue if abs(other - stamp) <= slop]
    return sorted(near, key=lambda other: abs(other - stamp))
