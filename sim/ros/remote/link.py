"""One side of a run in two processes: what its nodes did goes out as news, the other side's news come in.

Both sides have an engine with the same clock and take turns at each moment. What crosses is what nodes can
hear of each other: which ends they declare, messages, requests and responses. Not /rosout: who listens there
hears the nodes of its own side.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ClassVar

from sim.evidence import Call, Message
from sim.ros.messages.cdr import canonical
from sim.ros.messages.codec import encode, type_name
from sim.ros.remote.checked import (
    MOST_NAME,
    Nonsense,
    message,
    message_bytes,
    rows,
    text,
    whole,
)
from sim.ros.remote.events import Alive, Answer, Ask, End, Gone, Incoming, MessageEvent, row
from sim.ros.remote.news import News
from sim.ros.remote.own_ends import OwnEnds
from sim.ros.remote.parts import PuppetClient, PuppetPublisher, PuppetService
from sim.ros.remote.puppets import MOST_ENDS, Puppets

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine


class Link:
    """The side of one engine. keys: 0 for one side, 1 for the other, so that no two choose the same."""

    def __init__(self, engine: Engine, keys: int) -> None:
        self.engine, self.recording = engine, engine.recording
        self.puppets = Puppets(engine)
        self.seek = self.puppets.seek
        self.news: list[Any] = []  # events
        self.keys = itertools.count(keys, 2)
        self.own = OwnEnds(engine.recorder.ends, self.keys)
        self._answering: dict[int, PuppetService] = {}  # requests of this side without a response yet
        self._repeated: list[tuple[str, Any]] = []  # requests of the other side to a service that both have
        self._heard = News(engine.recording.published)
        self._destroyed = engine.destroyed
        self._incoming = Incoming()
        engine.link = self

    def close(self) -> None:
        """Destroy all that stands for the other side."""
        self.puppets.close()

    def alive(self, node: str, topic: str) -> None:
        """A publisher of this side says that it is alive."""
        if self.engine.links is None:
            self.news.append(Alive(node, topic))

    # -- what goes out -----------------------------------------------------------------------------

    def gather(self) -> None:
        """Add to the news what the nodes of this side have done."""
        self.news += self.own.new()
        self.gather_exchanges()
        self._gather_messages()
        if self._destroyed != self.engine.destroyed:
            self._destroyed = self.engine.destroyed
            self.news += self.own.gone()

    def gather_exchanges(self) -> None:
        """Add requests and responses to the news."""
        self.gather_requests()
        self.gather_responses()

    def take_news(self) -> list[list[Any]]:
        """The news, as rows for the wire, and nothing is left of them."""
        news, self.news = self.news, []
        return [row(event) for event in news]

    def entered(self) -> None:
        """What the other side's news have added to the recording is no news of this side."""
        self.own.forget_new()
        self._heard.take()

    def _gather_messages(self) -> None:
        for heard in self._heard.take():
            if self.crosses(heard):
                self.news.append(MessageEvent(heard.sender, heard.topic, heard.raw, heard.early))
        self.news += self.puppets.arrivals
        self.puppets.arrivals.clear()
        for part in self.puppets.listening:
            while (raw := part.take()) is not None:
                self.news.append(MessageEvent("", part.name, raw, False))

    def crosses(self, heard: Message) -> bool:
        """Whether the other side has to know of a message of this side."""
        if self.engine.links is not None:  # the network brings it
            return False
        return bool(self.puppets.wanted.get(heard.topic)) or heard.topic in self.own.latched

    def gather_requests(self) -> None:
        """Add the requests that clients of this side have made to services of the other."""
        for service in self.puppets.services:
            while service.of_action or service._sim.inbox or self.engine.post is not None:
                taken = service.take()
                if taken is None:
                    break
                if (service.name, taken[0]) in self._repeated:  # it came from there: don't send it back
                    self._repeated.remove((service.name, taken[0]))
                else:
                    self.asked(service, *taken)

    def asked(self, service: PuppetService, request: Any, header: Any) -> None:
        """A client of this side asks a service of the other."""
        key, raw, call = next(self.keys), encode(request), None
        if not service.of_action:
            raw = canonical(f"{type_name(service.type)}_Request", raw)
            calls = self.engine.recorder.calls.sent(service, header.sequence_number, raw)
            call = calls[0] if calls else None
        service.waiting[key] = header, request
        self._answering[key] = service
        self.tell_request(Ask(key, service.name, call.client if call else "", raw), call)

    def tell_request(self, event: Ask, call: Call | None) -> None:
        """Add a request to the news. call: the one that it belongs to; None for a part of an action."""
        self.news.append(event)

    def gather_responses(self) -> None:
        """Add the responses that services of this side have given to clients of the other."""
        for clients in self.puppets.clients.values():
            for client in clients:
                while client.asked and (taken := client.take()) is not None:
                    key, response = taken
                    if key is not None:
                        self.news.append(Answer(key, encode(response)))

    # -- what comes in -----------------------------------------------------------------------------

    def enter(self, news: Any) -> None:
        """Let what the other side did be so here too. Raises Nonsense for what can't be."""
        for event in self._incoming.read(news):
            self.hurry()
            if type(event) not in self.HANDLERS:
                raise Nonsense("an event of no known kind")
            self.HANDLERS[type(event)](self, event)
        if news:
            self.engine.activity += 1

    def hurry(self) -> None:
        """Called before each event that comes in."""

    def _end(self, event: End) -> None:
        self.declared(*self.puppets.declare(*event))

    def declared(self, kind: str, node: Any, name: str, type_: type, profile: Any) -> None:
        """A node of the other side has declared an end."""

    def _gone(self, event: Gone) -> None:
        for number in rows(event.numbers, "numbers", MOST_ENDS):
            if number not in self.puppets:
                raise Nonsense("the end of something that there is not")
            self.puppets.remove(number)

    def _message(self, event: MessageEvent) -> None:
        publisher = self._publisher(event, "a message", newest=bool(event.early))
        bytes_ = self.unpacked(event.raw, publisher)
        if publisher.of_action:
            publisher.handle.publish_raw(bytes_)
        else:
            self.publish(publisher, bytes_)

    def _alive(self, event: Alive) -> None:
        self._publisher(event, "a sign of life").writer.sign()

    def _publisher(self, event: MessageEvent | Alive, what: str, *, newest: bool = False) -> PuppetPublisher:
        node, topic = text(event.node, "a node's name", MOST_NAME), text(event.topic, "a topic", MOST_NAME)
        publisher = self.puppets.publisher(node, topic, newest=newest)
        if publisher is None:
            raise Nonsense(f"{what} on {topic!r}, where {node!r} has no publisher")
        return publisher

    def unpacked(self, raw: Any, publisher: PuppetPublisher) -> bytes:
        """The bytes of a message."""
        return message_bytes(raw, publisher.type, f"a message on {publisher.name}")

    def publish(self, publisher: PuppetPublisher, raw: bytes) -> None:
        """Send a message of the other side to the subscriptions of this one."""
        publisher.writer.send(raw)

    def _ask(self, event: Ask) -> None:
        key, service = whole(event.key, "a key"), text(event.service, "a service", MOST_NAME)
        node = text(event.client, "a node's name", MOST_NAME)
        client = self.puppets.client(node, service)
        if client is None:
            raise Nonsense(f"a request to {service!r}, of which {node!r} has no client")
        request, bytes_ = message(event.raw, client.type.Request, f"a request to {service}")
        if any(end.name == service for end in self.puppets.services):  # which gets it, too
            self._repeated.append((service, request))
        number = client.ask(key, request)
        if not client.of_action:
            self.engine.recorder.calls.asked(client, number, bytes_)
            self.has_asked(key, client, number)

    def has_asked(self, key: int, client: PuppetClient, number: int) -> None:
        """A node of the other side has sent a request; `number` is that of the puppet which sent it here."""

    def _answer(self, event: Answer) -> None:
        service = self._answering.pop(whole(event.key, "a key"), None)
        if service is None:
            raise Nonsense("a response to a request that nobody has made")
        response, bytes_ = message(event.raw, service.type.Response, f"a response of {service.name}")
        self.answered(event.key, service, response, bytes_)

    def answered(self, key: int, service: PuppetService, response: Any, raw: bytes) -> Any:
        """A service of the other side has answered; gives the request."""
        return service.answer(key, response)

    HANDLERS: ClassVar[dict[type, Callable[..., None]]] = {  # what each event that comes in does
        End: _end,
        Gone: _gone,
        MessageEvent: _message,
        Alive: _alive,
        Ask: _ask,
        Answer: _answer,
    }
