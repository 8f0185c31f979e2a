"""Services and clients for the graph; requests for the recording."""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from typing import Any

from rclpy.client import Client
from rclpy.lifecycle import LifecycleNodeMixin
from rclpy.node import Node
from rclpy.service import Service
from rclpy.task import Future

from sim.ros.fibers.scheduler import active, engine
from sim.ros.hooks.contexts import INVALID, is_shut_down, require_context
from sim.ros.hooks.table import hook
from sim.ros.messages.codec import encode, expect
from sim.ros.rclpy_cpp import cpp
from sim.ros.recorder.records import CLIENT, SERVICE


def _seek(node: Node, service: Any) -> None:
    """Create the proxies of another process first: an endpoint with another type is refused."""
    run = engine()
    if run is not None and run.transport.peer is not None:
        with contextlib.suppress(cpp.RCLError, TypeError):  # not a name: rclpy raises later
            run.transport.peer.seek(node.resolve_service_name(service))


@hook(Node, "create_service", "the graph")
def create_service(original: Callable) -> Callable:
    def create_service(self: Node, srv_type: Any, srv_name: str, *arguments: Any, **keywords: Any) -> Any:
        require_context(self, "failed to create service")
        _seek(self, srv_name)
        service = original(self, srv_type, srv_name, *arguments, **keywords)
        run = engine()
        if run is not None:
            name = self.resolve_service_name(srv_name)
            SERVICE.of(service).node = run.recorder.name_of(self)
            run.recorder.endpoint("service", self, name, srv_type, service.qos_profile, handle=service.handle)
        return service

    return create_service


@hook(LifecycleNodeMixin, "__init__", "the graph: its services are created without create_service()")
def lifecycle_init(original: Callable) -> Callable:
    def __init__(self: LifecycleNodeMixin, **keywords: Any) -> None:
        original(self, **keywords)
        run = engine()
        if run is not None:
            for service in self.services:  # type: ignore[attr-defined]
                if service.srv_type.__module__.startswith("lifecycle_msgs."):
                    SERVICE.of(service).node = run.recorder.name_of(self)
                    run.recorder.endpoint(
                        "service", self, service.service_name, service.srv_type, service.qos_profile,
                        handle=service.handle,
                    )  # fmt: skip

    return __init__


@hook(Service, "__init__", "requests wait in a service's queue; the recording has their senders")
def service_init(original: Callable) -> Callable:
    def __init__(self: Service, *arguments: Any, **keywords: Any) -> None:
        original(self, *arguments, **keywords)
        run = engine()
        if run is not None:
            run.recorder.calls.service_created(self)

    return __init__


@hook(Service, "send_response", "every response is recorded as the bytes that are sent, also a library's")
def send_response(original: Callable) -> Callable:
    def send_response(self: Service, response: Any, header: Any) -> None:
        run, record = engine(), SERVICE.find(self)
        call = None if run is None or record is None else record.unanswered.pop(id(header), None)
        if call is None:
            return original(self, response, header)
        expect(response, self.srv_type.Response)  # type: ignore[attr-defined]
        raw = encode(response)
        original(self, response, header)
        return run.recorder.calls.response_sent(call, raw)

    return send_response


@hook(Node, "create_client", "the graph")
def create_client(original: Callable) -> Callable:
    def create_client(self: Node, srv_type: Any, srv_name: str, **keywords: Any) -> Any:
        require_context(self, "failed to create client")
        _seek(self, srv_name)
        client = original(self, srv_type, srv_name, **keywords)
        run = engine()
        if run is not None:
            run.waiters.endpoints_changed()
            name = self.resolve_service_name(srv_name)
            run.recorder.endpoint("client", self, name, srv_type, client.qos_profile, handle=client.handle)
            run.recorder.calls.client_created(client, self, name)
        return client

    return create_client


@hook(
    cpp.Client,
    "send_request",
    "a request before discovery is lost; and services are polled only when a request was sent",
)
def send_request(original: Callable) -> Callable:
    def send_request(self: Any, request: Any) -> int:
        run = active()
        if run is not None and (lost := run.recorder.calls.lost_request_number()) is not None:
            return lost
        number = original(self, request)
        if run is not None:  # also for a proxy of another process's client
            run.transport.request_sent(self.service_name)
            run.transport.sent_by_middleware()
        return number

    return send_request


@hook(Client, "call_async", "every request is recorded as the bytes that are sent")
def call_async(original: Callable) -> Callable:
    def call_async(self: Client, request: Any) -> Future:
        run = engine()
        if run is None or CLIENT.find(self) is None:
            return original(self, request)
        expect(request, self.srv_type.Request)  # type: ignore[attr-defined]
        run.limits.count_request()
        raw, calls = encode(request), run.recorder.calls
        with calls.sending(calls.discovered(self)):
            future = original(self, request)
        calls.request_sent(self, next(reversed(self._pending_requests)), raw)
        return future

    return call_async


@hook(Client, "service_is_ready", "a client that finds a service ready has discovered it")
def service_is_ready(original: Callable) -> Callable:
    def service_is_ready(self: Client) -> bool:
        if is_shut_down(self.context):
            raise cpp.RCLError(f"failed to check service availability: {INVALID}")
        ready = original(self)
        record = CLIENT.find(self)
        if engine() is not None and ready and record is not None:
            record.server_seen = True
        return ready

    return service_is_ready


@hook(Client, "call", "its TypeError has no text")
def call(original: Callable) -> Callable:
    def call(self: Client, request: Any, timeout_sec: float | None = None) -> Any:
        if engine() is not None:
            expect(request, self.srv_type.Request)  # type: ignore[attr-defined]
        return original(self, request, timeout_sec)

    return call
