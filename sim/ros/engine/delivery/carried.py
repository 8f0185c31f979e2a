"""Ends of topics whose messages the middleware carries: C++ code publishes there, or tests ask for it."""

from __future__ import annotations

from rclpy.duration import Duration

from sim.ros.engine.delivery.qos import latches
from sim.ros.engine.delivery.reader import Reader, Sent
from sim.ros.engine.delivery.writer import Writer
from sim.ros.messages.cdr import canonical
from sim.ros.messages.codec import type_name

REPLAY_WAIT = Duration(seconds=2)  # wall time; measured at 0.1 s


class CarriedWriter(Writer):
    """A writer whose messages the middleware carries."""

    def _hand_over(self, raw: bytes) -> None:
        self.handle.publish_raw(raw)

    def meet(self, reader: Reader) -> None:
        """Wait, in wall time, for what a late joiner of a latched topic gets."""
        if latches(self.profile) and latches(reader.profile):
            self.handle.wait_for_all_acked(REPLAY_WAIT._duration_handle)


class CarriedReader(Reader):
    """A reader whose messages the middleware carries. It is asked only when one was sent."""

    _seen: int | None = -1

    def take(self) -> Sent | None:
        """As `Reader.take`."""
        sent = self.engine.topics.sent.get(self.topic)  # None: C++ code alone publishes here; nobody counts
        if sent is not None and sent == self._seen:
            return None
        taken = self.handle.take_message(self.message_class, self.raw)
        if taken is None:
            self._seen = sent
            return None
        message, information = taken
        if self.raw:  # DDS leaves what was in memory in gaps and behind the end
            message = canonical(type_name(self.message_class), message)
        stamp = self.engine.time.moment_at(information["source_timestamp"])
        return Sent(message, stamp, information["publication_sequence_number"])
