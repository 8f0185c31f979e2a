"""The endpoint of a subscription."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from typing import Any

from rclpy.event_handler import EventHandler
from rclpy.qos import QoSProfile

from sim.ros.attached import Attached
from sim.ros.fibers.waiter import Waiter
from sim.ros.messages.decoder import decode_message
from sim.ros.rclpy_cpp import cpp
from sim.ros.transport.context import TransportContext
from sim.ros.transport.endpoint import Sample, TopicEndpoint
from sim.ros.transport.qos import FOREVER, queue_length
from sim.ros.transport.qos_events import (
    CHANGED,
    MESSAGE_LOST,
    OF_READER,
    REQUESTED,
    deadline_lease,
    event_counts,
    liveliness_monitor,
)

NO_EXECUTOR = Waiter()


class DataReader(TopicEndpoint):
    """The endpoint of a subscription, with the messages that wait there to be taken.

    raw: it takes bytes. subscriber: the node's name. events: handlers of what happens to it. The other
    arguments are those of TopicEndpoint.
    """

    def __init__(
        self,
        run: TransportContext,
        node: Any,
        handle: Any,
        type_: type,
        topic: str,
        profile: QoSProfile,
        raw: bool,
        on_close: Callable[[TopicEndpoint], None],
        subscriber: str = "",
        events: Iterable[EventHandler] = (),
    ) -> None:
        find = cpp.rclpy_get_subscriptions_info_by_topic
        super().__init__(run, node, handle, topic, profile, find, on_close)
        self.message_class, self.raw, self.subscriber = type_, raw, subscriber
        self.queue: deque[Sample] = deque(maxlen=queue_length(profile))
        self.closed = False
        self.waiter = NO_EXECUTOR  # the executor that takes from the queue, once that has listed its entities
        counts = event_counts(run, events, OF_READER)
        self.liveliness = liveliness_monitor(run, self.profile, counts.get(CHANGED))
        self._deadline = deadline_lease(run, self.profile, counts.get(REQUESTED))
        self._lifespan = profile.lifespan.nanoseconds or FOREVER
        self._lost = counts.get(MESSAGE_LOST)

    def receive(self, sample: Sample) -> None:
        """A message has come: its executor has work."""
        if self._deadline is not None:
            self._deadline.renew()
        self.queue.append(sample)
        self.waiter.wake()

    def is_expired(self, sample: Sample) -> bool:
        """Return whether a message is older than this subscription's lifespan, not the publisher's."""
        return self.scheduler.now - sample.stamp >= self._lifespan

    def on_lost(self, count: int) -> None:
        """Note that so many messages did not come before the one that comes now."""
        if self._lost is not None:
            self._lost.add(total_count=count)

    def take(self) -> Sample | None:
        """The next message; None if there is none."""
        while self.queue:
            sample = self.queue.popleft()
            if self.is_expired(sample):
                continue
            raw, stamp, number, _ = sample
            if self.raw:
                return Sample(bytes(raw), stamp, number)
            try:
                return Sample(decode_message(self.message_class, raw), stamp, number)
            except cpp.RMWError:  # bytes that are no message: ROS drops them, too
                continue
        return None

    def close(self) -> None:
        """Its subscription was destroyed."""
        self.closed = True
        self.queue.clear()
        if self._deadline is not None:
            self._deadline.cancel()
        self.on_close(self)


READER = Attached[DataReader]()  # of a Subscription
