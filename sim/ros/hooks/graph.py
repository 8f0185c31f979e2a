"""What student code says and declares, for the recording: messages, endpoints, timers, log lines."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.node import Node
from rclpy.publisher import Publisher

from sim.ros.codec import type_name
from sim.ros.fibers import engine
from sim.ros.hooks import hook
from sim.ros.processes import shared_context


@hook(Node, "create_publisher", "the graph, and who sends what")
def create_publisher(original: Callable) -> Callable:
    def create_publisher(
        self: Node, msg_type: Any, topic: str, *arguments: Any, **keywords: Any
    ) -> Publisher:
        publisher = original(self, msg_type, topic, *arguments, **keywords)
        run = engine()
        if run is not None:
            name = publisher.topic_name
            publisher._sim_identity = (name, type_name(msg_type), run.recorder.name_of(self))
            publisher._sim_context = shared_context(self.context)
            run.recorder.endpoint(
                "publisher", self, name, msg_type, publisher.qos_profile, handle=publisher.handle
            )
            run.endpoints_changed()
        return publisher

    return create_publisher


@hook(Node, "create_subscription", "the graph, and late joiners of transient_local topics")
def create_subscription(original: Callable) -> Callable:
    def create_subscription(self: Node, msg_type: Any, topic: str, *arguments: Any, **keywords: Any) -> Any:
        subscription = original(self, msg_type, topic, *arguments, **keywords)
        run = engine()
        if run is not None:
            # Asked for messages when one was sent; nobody counts those that C++ code publishes.
            name = subscription._sim_topic = subscription.topic_name
            subscription._sim_seen = -1
            run.recorder.endpoint(
                "subscription", self, name, msg_type, subscription.qos_profile, handle=subscription.handle
            )
            run.subscribed(name, subscription)
        return subscription

    return create_subscription


@hook(Node, "create_timer", "the graph")
def create_timer(original: Callable) -> Callable:
    def create_timer(self: Node, *arguments: Any, **keywords: Any) -> Any:
        timer = original(self, *arguments, **keywords)
        run = engine()
        if run is not None:
            run.recorder.timer(self, timer)
        return timer

    return create_timer


@hook(Publisher, "publish", "every message is recorded as the bytes that are sent")
def publish(original: Callable) -> Callable:
    def publish(self: Publisher, msg: Any) -> None:
        run = engine()
        identity = self.__dict__.get("_sim_identity")
        if run is None or identity is None:
            return original(self, msg)
        if isinstance(msg, self.msg_type):
            raw = _rclpy.rclpy_serialize(msg, self.msg_type)
        elif isinstance(msg, bytes):
            raw = msg
        else:
            return original(self, msg)  # raises the TypeError that a student would get on a robot
        if not self._sim_context.alive:
            raise _rclpy.RCLError("Failed to publish: publisher's context is invalid")
        self.handle.publish_raw(raw)
        run.published(*identity, raw)
        return None

    return publish


@hook(
    _rclpy,
    "rclpy_logging_rcutils_log",
    "log lines go to the recording, with simulated stamps, and never to stderr",
)
def log(original: Callable) -> Callable:
    def log(severity: Any, name: str, text: str, *place: Any) -> None:
        run = engine()
        if run is None or run.rosout_wanted or not isinstance(text, str):
            original(severity, name, text, *place)  # raises TypeError for what is no text
        if run is not None:
            run.activity += run.rosout_wanted  # C++ code published it
            run.logged(severity, name, text)

    return log
