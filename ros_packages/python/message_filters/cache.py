"""The latest messages, to be looked up by their stamps."""

from __future__ import annotations

from typing import Any

from rclpy.time import Time

from message_filters.simple_filter import SimpleFilter
from message_filters.stamps import stamp_of

# Upstream's words.
WARNING = (
    "can not use message filters messages without timestamp infomation when 'allow_headerless' is disabled. "
    "auto assign ROSTIME to headerless messages once enabling constructor option of 'allow_headerless'."
)


class Cache(SimpleFilter):
    """Stores the latest `cache_size` messages in the order of their arrival, and passes each on."""

    def __init__(self, f: SimpleFilter, cache_size: int = 1, allow_headerless: bool = False) -> None:
        """allow_headerless: store messages without a header, at the present time."""
        super().__init__()
        self.connectInput(f)
        self.cache_size = cache_size
        self.cache_msgs: list[Any] = []
        self.cache_times: list[Time] = []
        self.allow_headerless = allow_headerless

    def connectInput(self, f: SimpleFilter) -> None:
        """Store the output of another filter."""
        self.incoming_connection = f.registerCallback(self.add)

    def add(self, msg: Any) -> None:
        """Store a message, in place of the oldest one if the cache is full."""
        stamp = stamp_of(
            msg, allow_headerless=self.allow_headerless, logger="message_filters_cache", warning=WARNING
        )
        if stamp is None:
            return
        self.cache_times.append(stamp)
        self.cache_msgs.append(msg)
        if len(self.cache_msgs) > self.cache_size:
            del self.cache_msgs[0], self.cache_times[0]
        self.signalMessage(msg)

    def getInterval(self, from_stamp: Time, to_stamp: Time) -> list[Any]:
        """The messages from one time to another, both included."""
        assert from_stamp <= to_stamp
        return [msg for msg, stamp in self._stored() if from_stamp <= stamp <= to_stamp]

    def getElemAfterTime(self, stamp: Time) -> Any | None:
        """The first message at this time or later, or None."""
        return next((msg for msg, stored in self._stored() if stored >= stamp), None)

    def getElemBeforeTime(self, stamp: Time) -> Any | None:
        """The last message at this time or earlier, or None."""
        return next((msg for msg, stored in reversed(self._stored()) if stored <= stamp), None)

    def getLastestTime(self) -> Time | None:
        """The stamp of the last message, or None. The spelling is upstream's."""
        return self.cache_times[-1] if self.cache_times else None

    def getOldestTime(self) -> Time | None:
        """The stamp of the first message, or None."""
        return self.cache_times[0] if self.cache_times else None

    def getLast(self) -> Any | None:
        """The first message that is not earlier than the last one, or None."""
        latest = self.getLastestTime()
        return None if latest is None else self.getElemAfterTime(latest)

    def _stored(self) -> list[tuple[Any, Time]]:
        return list(zip(self.cache_msgs, self.cache_times, strict=True))
