"""Endpoints of topics whose messages the middleware carries: C++ code publishes there, or a test wants it."""

from __future__ import annotations

from rclpy.duration import Duration

from sim.ros.messages.cdr import canonical
from sim.ros.messages.codec import type_name
from sim.ros.transport.endpoint import Sample
from sim.ros.transport.qos import latches
from sim.ros.transport.reader import DataReader
from sim.ros.transport.writer import DataWriter

REPLAY_WAIT = Duration(seconds=2)  # wall time; measured at 0.1 s


class MiddlewareWriter(DataWriter):
    """A writer whose messages the middleware carries."""

    def _hand_over(self, raw: bytes) -> None:
        self.handle.publish_raw(raw)

    def match(self, reader: DataReader) -> None:
        """Wait, in wall time, for what a late joiner of a latched topic gets."""
        if latches(self.profile) and latches(reader.profile):
            self.handle.wait_for_all_acked(REPLAY_WAIT._duration_handle)


class MiddlewareReader(DataReader):
    """A reader whose messages the middleware carries: its executor has to poll it.

    It looks only if a message was sent since it last found none.
    """

    _seen: int | None = -1

    def take(self) -> Sample | None:
        """Work like `DataReader.take`."""
        sent = self.run.sent.get(self.topic)  # None: only C++ code publishes here, uncounted
        if sent is not None and sent == self._seen:
            return None
        taken = self.handle.take_message(self.message_class, self.raw)
        if taken is None:
            self._seen = sent
            return None
        message, information = taken
        if self.raw:  # DDS leaves what was in memory in gaps and behind the end
            message = canonical(type_name(self.message_class), message)
        stamp = self.run.moment_at(information["source_timestamp"])
        return Sample(message, stamp, information["publication_sequence_number"])
