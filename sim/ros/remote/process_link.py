"""One end of the link between the two processes of a run: it exchanges events about the nodes of both.

Both processes have an engine with the same clock and take turns at each time step. They exchange what nodes
receive from each other: endpoints, messages, requests and responses. /rosout is not exchanged: a subscriber
of it gets only the log lines of its own process.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ClassVar

from sim.evidence import Call, Message
from sim.ros.messages.cdr import canonical
from sim.ros.messages.codec import encode, type_name
from sim.ros.recorder.records import SERVICE
from sim.ros.remote.events import (
    EndpointDeclared,
    EndpointsDestroyed,
    EventReader,
    LivelinessAsserted,
    MessagePublished,
    RequestSent,
    ResponseSent,
    to_wire,
)
from sim.ros.remote.local_endpoints import LocalEndpoints
from sim.ros.remote.new_items import NewItems
from sim.ros.remote.proxies import MAX_ENDPOINTS, Proxies
from sim.ros.remote.proxy import ProxyClient, ProxyPublisher, ProxyService
from sim.ros.remote.validation import (
    MAX_NAME_LENGTH,
    ProtocolError,
    valid_int,
    valid_list,
    valid_message,
    valid_message_bytes,
    valid_text,
)

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine


class ProcessLink:
    """The link of one engine. keys: the first key; 0 in one process and 1 in the other keep keys distinct."""

    def __init__(self, engine: Engine, keys: int) -> None:
        self.engine, self.recording = engine, engine.recording
        self.proxies = Proxies(engine)
        self.seek = self.proxies.seek
        self.outgoing: list[Any] = []  # events for the other process
        self.keys = itertools.count(keys, 2)
        self.local = LocalEndpoints(engine.recorder.declared, self.keys)
        self._answering: dict[int, ProxyService] = {}  # requests of this process without a response yet
        self._repeated: list[tuple[str, Any]] = []  # requests to a service that both processes offer
        self._new_messages = NewItems(engine.recording.published)
        self._handle_destroyed = False  # since the last look
        self._incoming = EventReader()
        self.blocked = ""

    def close(self) -> None:
        """Destroy all proxies of the other process."""
        self.proxies.close()

    def alive(self, node: str, topic: str) -> None:
        """A publisher of this process has asserted its liveliness."""
        if self.engine.transport.links is None:
            self.outgoing.append(LivelinessAsserted(node, topic))

    def handle_destroyed(self) -> None:
        """A handle of rclpy was destroyed in this process, so an endpoint may be gone."""
        self._handle_destroyed = True

    # -- outgoing events ---------------------------------------------------------------------------

    def collect(self) -> None:
        """Queue events for what the nodes of this process have done."""
        self.outgoing += self.local.declared()
        self.collect_exchanges()
        self._collect_messages()
        if self._handle_destroyed:
            self._handle_destroyed = False
            self.outgoing += self.local.destroyed()

    def collect_exchanges(self) -> None:
        """Queue requests and responses."""
        self.collect_requests()
        self.collect_responses()

    def take_outgoing(self) -> list[list[Any]]:
        """The queued events as lists for the wire; the queue is empty afterwards."""
        outgoing, self.outgoing = self.outgoing, []
        return [to_wire(event) for event in outgoing]

    def discard_applied(self) -> None:
        """Skip what the applied events have added to the recording: the other process knows it."""
        self.local.skip_new()
        self._new_messages.take()

    def _collect_messages(self) -> None:
        for message in self._new_messages.take():
            if self.must_send(message):
                self.outgoing.append(
                    MessagePublished(message.sender, message.topic, message.raw, message.early)
                )
        self.outgoing += self.proxies.arrivals
        self.proxies.arrivals.clear()
        for subscription in self.proxies.action_subscriptions:
            while (raw := subscription.take()) is not None:
                self.outgoing.append(MessagePublished("", subscription.name, raw, False))

    def must_send(self, message: Message) -> bool:
        """Return whether the other process needs a message published in this one."""
        if self.engine.transport.links is not None:  # the simulated network delivers it
            return False
        return bool(self.proxies.wanted.get(message.topic)) or message.topic in self.local.latched

    def collect_requests(self) -> None:
        """Queue the requests that clients of this process have sent to services of the other."""
        for service in self.proxies.services:
            always = service.of_action or self.engine.transport.services is not None
            while (always or SERVICE.of(service).inbox) and (taken := service.take()) is not None:
                request = service.name, taken[0]
                if request in self._repeated:  # it came from the other process: don't send it back
                    self._repeated.remove(request)
                else:
                    self._request_taken(service, *taken)

    def _request_taken(self, service: ProxyService, request: Any, header: Any) -> None:
        """A client of this process has sent a request to a service of the other."""
        key, raw, call = next(self.keys), encode(request), None
        if not service.of_action:
            raw = canonical(f"{type_name(service.type)}_Request", raw)
            calls = self.engine.recorder.calls.calls_of(service, header.sequence_number, raw)
            call = calls[0] if calls else None
        service.waiting[key] = header, request
        self._answering[key] = service
        self.send_request(RequestSent(key, service.name, call.client if call else "", raw), call)

    def send_request(self, event: RequestSent, call: Call | None) -> None:
        """Queue a request. call: its record, or None for a service of an action."""
        self.outgoing.append(event)

    def collect_responses(self) -> None:
        """Queue the responses that services of this process have sent to clients of the other."""
        for clients in self.proxies.clients.values():
            for client in clients:
                while client.keys and (taken := client.take()) is not None:
                    key, response = taken
                    if key is not None:
                        self.outgoing.append(ResponseSent(key, encode(response)))

    # -- incoming events ---------------------------------------------------------------------------

    def apply(self, received: Any) -> None:
        """Apply the events of the other process here. Raises ProtocolError for an invalid one."""
        for event in self._incoming.read(received):
            self.check_deadline()
            if type(event) not in self.HANDLERS:
                raise ProtocolError("an event of unknown kind")
            self.HANDLERS[type(event)](self, event)
        if received:
            self.engine.wake_all()

    def check_deadline(self) -> None:
        """Called before each incoming event."""

    def _endpoint_declared(self, event: EndpointDeclared) -> None:
        self.declared(*self.proxies.declare(*event))

    def declared(self, kind: str, node: Any, name: str, type_: type, profile: Any) -> None:
        """A node of the other process has created an endpoint."""

    def _endpoints_destroyed(self, event: EndpointsDestroyed) -> None:
        for number in valid_list(event.numbers, "numbers", MAX_ENDPOINTS):
            if number not in self.proxies:
                raise ProtocolError("the destruction of an endpoint that does not exist")
            self.proxies.remove(number)

    def _message_published(self, event: MessagePublished) -> None:
        publisher = self._publisher(event, "a message", newest=bool(event.early))
        bytes_ = self.message_bytes(event.raw, publisher)
        if publisher.of_action:
            publisher.handle.publish_raw(bytes_)
        else:
            self.publish(publisher, bytes_)

    def _liveliness_asserted(self, event: LivelinessAsserted) -> None:
        self._publisher(event, "a liveliness assertion").writer.assert_liveliness()

    def _publisher(
        self, event: MessagePublished | LivelinessAsserted, what: str, *, newest: bool = False
    ) -> ProxyPublisher:
        node, topic = (
            valid_text(event.node, "a node's name", MAX_NAME_LENGTH),
            valid_text(event.topic, "a topic", MAX_NAME_LENGTH),
        )
        publisher = self.proxies.publisher(node, topic, newest=newest)
        if publisher is None:
            raise ProtocolError(f"{what} on {topic!r}, where {node!r} has no publisher")
        return publisher

    def message_bytes(self, raw: Any, publisher: ProxyPublisher) -> bytes:
        """The validated bytes of a message."""
        return valid_message_bytes(raw, publisher.type, f"a message on {publisher.name}")

    def publish(self, publisher: ProxyPublisher, raw: bytes) -> None:
        """Send a message of the other process to the subscriptions of this one."""
        publisher.writer.send(raw)

    def _request_sent(self, event: RequestSent) -> None:
        key, service = valid_int(event.key, "a key"), valid_text(event.service, "a service", MAX_NAME_LENGTH)
        node = valid_text(event.client, "a node's name", MAX_NAME_LENGTH)
        client = self.proxies.client(node, service)
        if client is None:
            raise ProtocolError(f"a request to {service!r}, of which {node!r} has no client")
        request, bytes_ = valid_message(event.raw, client.type.Request, f"a request to {service}")
        if any(end.name == service for end in self.proxies.services):  # it receives the request as well
            self._repeated.append((service, request))
        number = client.send(key, request)
        if not client.of_action:
            self.engine.recorder.calls.request_sent(client, number, bytes_)
            self.request_received(key, client, number)

    def request_received(self, key: int, client: ProxyClient, number: int) -> None:
        """A node of the other process has sent a request; its proxy has sent it here with this number."""

    def _response_sent(self, event: ResponseSent) -> None:
        service = self._answering.pop(valid_int(event.key, "a key"), None)
        if service is None:
            raise ProtocolError("a response to a request that no client has sent")
        response, bytes_ = valid_message(event.raw, service.type.Response, f"a response of {service.name}")
        self.answered(event.key, service, response, bytes_)

    def answered(self, key: int, service: ProxyService, response: Any, raw: bytes) -> Any:
        """A service of the other process has responded; returns the request."""
        return service.answer(key, response)

    HANDLERS: ClassVar[dict[type, Callable[..., None]]] = {  # by type of event
        EndpointDeclared: _endpoint_declared,
        EndpointsDestroyed: _endpoints_destroyed,
        MessagePublished: _message_published,
        LivelinessAsserted: _liveliness_asserted,
        RequestSent: _request_sent,
        ResponseSent: _response_sent,
    }
