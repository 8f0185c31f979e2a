"""Messages, endpoints, timers and log lines of student code, for the recording."""

from __future__ import annotations

import functools
import os
import sys
from collections.abc import Callable
from types import FrameType
from typing import Any

import rclpy.logging
from rclpy.duration import Duration
from rclpy.impl import rcutils_logger
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.subscription import Subscription

from sim.evidence import RATE
from sim.nanoseconds import SECOND, Nanoseconds
from sim.ros.attached import Attached
from sim.ros.engine.running_program import shared_context
from sim.ros.engine.sim_executor import NOT_VALID
from sim.ros.fibers.scheduler import active, engine
from sim.ros.hooks.contexts import require_context
from sim.ros.hooks.table import hook
from sim.ros.messages.lenient import convert_float_message, create_with_matching_type
from sim.ros.rclpy_cpp import cpp
from sim.ros.transport.reader import READER
from sim.ros.transport.writer import WRITER

LONGEST_BLOCKING: Nanoseconds = SECOND // 10  # of publish() while the history is full; measured with Fast DDS
FOR_EVER = Duration(seconds=-1)


@hook(Node, "create_publisher", "the graph, and the senders of messages")
def create_publisher(original: Callable) -> Callable:
    def create_publisher(
        self: Node, msg_type: Any, topic: str, *arguments: Any, **keywords: Any
    ) -> Publisher:
        run = engine()
        require_context(self, "Failed to create publisher")
        publisher = create_with_matching_type(
            lambda type_: original(self, type_, topic, *arguments, **keywords), msg_type
        )
        if run is not None:
            name, msg_type = publisher.topic_name, publisher.msg_type
            if name == "/clock" and not run.current.process.from_course:
                self.destroy_publisher(publisher)
                raise NotImplementedError(
                    "Messages on /clock can't change the time in a run: all clocks show its simulated time."
                )
            end = {"topic": name, "profile": publisher.qos_profile, "sender": run.recorder.name_of(self)}
            end |= {"from_course": run.recorder.is_course_node(), "events": publisher.event_handlers}
            writer = run.transport.topics.writer(self.handle, publisher.handle, msg_type, **end)
            WRITER.attach(publisher, writer).context = shared_context(self.context)
            run.recorder.endpoint(
                "publisher", self, name, msg_type, publisher.qos_profile, handle=publisher.handle
            )
            run.waiters.endpoints_changed()
        return publisher

    return create_publisher


@hook(Node, "create_subscription", "the graph, and late joiners of transient_local topics")
def create_subscription(original: Callable) -> Callable:
    def create_subscription(self: Node, msg_type: Any, topic: str, *arguments: Any, **keywords: Any) -> Any:
        run = engine()
        require_context(self, "Failed to create subscription")
        subscription = create_with_matching_type(
            lambda type_: original(self, type_, topic, *arguments, **keywords), msg_type
        )
        if run is not None:
            msg_type = subscription.msg_type
            handle, name, profile = subscription.handle, subscription.topic_name, subscription.qos_profile
            end = {"topic": name, "profile": profile, "raw": subscription.raw}
            end |= {"subscriber": run.recorder.name_of(self), "events": subscription.event_handlers}
            READER.attach(subscription, run.transport.topics.reader(self.handle, handle, msg_type, **end))
            run.recorder.endpoint("subscription", self, name, msg_type, profile, handle=handle)
            run.waiters.endpoints_changed()
        return subscription

    return create_subscription


@hook(Node, "create_timer", "the graph")
def create_timer(original: Callable) -> Callable:
    def create_timer(self: Node, *arguments: Any, **keywords: Any) -> Any:
        require_context(self, "failed to create timer", NOT_VALID)
        timer = original(self, *arguments, **keywords)
        run = engine()
        if run is not None:
            run.recorder.timer_created(self, timer)
            if timer.callback_group is self._rate_group:
                run.recorder.node_fact(self, RATE)
        return timer

    return create_timer


def _require_context(publisher: Publisher, failed: str) -> None:
    """Work like `require_context`, with the words of a publisher."""
    writer = WRITER.find(publisher)
    if writer is not None and not writer.context.alive and engine() is not None:
        raise cpp.RCLError(f"{failed}: publisher's context is invalid")


@hook(Publisher, "publish", "every message is recorded as the bytes that are sent")
def publish(original: Callable) -> Callable:
    def publish(self: Publisher, msg: Any) -> None:
        run = engine()
        writer = WRITER.find(self)
        if run is None or writer is None:
            return original(self, msg)
        msg = convert_float_message(msg, self.msg_type)
        if isinstance(msg, self.msg_type):
            raw = cpp.rclpy_serialize(msg, self.msg_type)
        elif isinstance(msg, bytes):
            raw = msg
        else:
            return original(self, msg)  # raises the TypeError that a student would get on a robot
        with self.handle:  # raises InvalidHandle if it was destroyed
            pass
        _require_context(self, "Failed to publish")
        outgoing = writer.outgoing
        if outgoing is not None and not outgoing.has_room():
            what = f"room in the history of {writer.topic}"
            run.wait(what, ready=outgoing.has_room, until=run.now + LONGEST_BLOCKING)
            if not outgoing.has_room():
                raise cpp.RCLError("Failed to publish: cannot publish data")
        writer.publish(raw)
        run.count_call("messages")
        return None

    return publish


@hook(Publisher, "get_subscription_count", "a subscription counts as soon as messages reach it")
def get_subscription_count(original: Callable) -> Callable:
    def get_subscription_count(self: Publisher) -> int:
        _require_context(self, "failed to get subscription count")
        count = original(self)
        writer = WRITER.find(self)
        return count if engine() is None or writer is None else max(count - writer.undiscovered(), 0)

    return get_subscription_count


@hook(Publisher, "assert_liveliness", "an assertion counts at the run's time")
def assert_liveliness(original: Callable) -> Callable:
    def assert_liveliness(self: Publisher) -> None:
        _require_context(self, "Failed to assert liveliness on the Publisher")
        original(self)
        writer = WRITER.find(self)
        if engine() is not None and writer is not None:
            writer.assert_liveliness()

    return assert_liveliness


@hook(Publisher, "wait_for_all_acked", "it waits in simulated time for messages on the network")
def wait_for_all_acked(original: Callable) -> Callable:
    def wait_for_all_acked(self: Publisher, timeout: Duration = FOR_EVER) -> bool:
        _require_context(self, "Failed to wait for all acknowledgments")
        run = engine()
        writer = WRITER.find(self)
        if run is None or writer is None or writer.outgoing is None:
            return original(self, timeout)
        until = None if timeout.nanoseconds < 0 else run.now + timeout.nanoseconds
        acknowledged = writer.outgoing.all_acknowledged
        run.wait(f"the acknowledgments on {writer.topic}", ready=acknowledged, until=until)
        return acknowledged()

    return wait_for_all_acked


def _close_with(owner: type, endpoint: Attached) -> None:
    @hook(owner, "destroy", "its topic removes it")
    def destroy_endpoint(original: Callable) -> Callable:
        def destroy(self: Any) -> None:
            original(self)
            end = endpoint.find(self)
            if end is not None:
                end.close()

        return destroy


_close_with(Publisher, WRITER)
_close_with(Subscription, READER)


@hook(cpp.Destroyable, "destroy_when_not_in_use", "its proxy in another process is destroyed with it")
def destroy_handle(original: Callable) -> Callable:
    def destroy_when_not_in_use(self: Any) -> None:
        original(self)
        run = active()  # also for what is freed after its program has ended
        if run is not None and run.transport.peer is not None:
            run.transport.peer.handle_destroyed()

    return destroy_when_not_in_use


@hook(
    cpp,
    "rclpy_logging_rcutils_log",
    "log lines go to the recording, with simulated stamps, and never to stderr",
)
def log(original: Callable) -> Callable:
    def log(severity: Any, name: str, text: str, *place: Any) -> None:
        run = engine()
        if run is None or run.transport.topics.rosout_wanted or not isinstance(text, str):
            original(severity, name, text, *place)  # raises TypeError for what is not a str
        if run is not None:
            run.output.log(severity, name, text)

    return log


@hook(
    rcutils_logger.CallerId,
    "__new__",
    "a log line's place is found without reading the sources around it, and the names of all modules",
)
def caller_id(original: Callable) -> Callable:
    def __new__(cls: type, frame: FrameType | None = None) -> Any:
        if engine() is None:
            return original(cls, frame or rcutils_logger._find_caller(sys._getframe(1)))
        frame = frame or _outside_rclpy(sys._getframe(1))
        code = frame.f_code
        place = code.co_name, os.path.abspath(code.co_filename), frame.f_lineno, frame.f_lasti
        return tuple.__new__(cls, place)

    return __new__


def _outside_rclpy(frame: FrameType) -> FrameType:
    inner = *_LOGGERS, *rcutils_logger._internal_callers
    while any(file in _real_path(frame.f_code.co_filename) for file in inner):
        frame = frame.f_back
    return frame


_real_path = functools.cache(os.path.realpath)
_LOGGERS = _real_path(rcutils_logger.__file__), _real_path(rclpy.logging.__file__)
