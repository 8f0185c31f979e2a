"""One side of a run in two processes: what its nodes did goes out as news, the other side's news come in.

Both sides have an engine with the same clock and take turns at each moment. What crosses is what nodes can
hear of each other: which ends they declare, messages, requests and responses. Not /rosout: who listens there
hears the nodes of its own side.

An event is a list, its first item a word of `Link.EVENTS`. Numbers of ends and keys of requests are chosen by
the side that begins to use them.
"""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any, ClassVar

from rclpy.qos import DurabilityPolicy

from sim.exchanges import Call
from sim.recording import Heard
from sim.ros.calls import alive
from sim.ros.cdr import canonical
from sim.ros.codec import encode, type_name
from sim.ros.recorder import OwnEnd
from sim.ros.remote.checked import (
    MOST_NAME,
    Nonsense,
    message,
    message_bytes,
    packed,
    plain_qos,
    rows,
    text,
    whole,
)
from sim.ros.remote.parts import PuppetClient, PuppetPublisher, PuppetService
from sim.ros.remote.puppets import MOST_ENDS, Puppets

if TYPE_CHECKING:
    from sim.ros.engine import Engine

MOST_EVENTS = 100_000  # in one message
ALL_EVENTS = 3_000_000  # in a run

Event = list[Any]


class Link:
    """The side of one engine. keys: 0 for one side, 1 for the other, so that no two choose the same."""

    def __init__(self, engine: Engine, keys: int) -> None:
        self.engine, self.recording = engine, engine.recording
        self.puppets = Puppets(engine)
        self.news: list[Event] = []
        self.keys = itertools.count(keys, 2)
        self._nodes: dict[int, int] = {}  # id of a node's handle -> its number
        self._own: dict[int, OwnEnd] = {}  # ends of this side, as long as they live
        self._latched: set[str] = set()  # topics on which a late joiner gets earlier messages
        self._answering: dict[int, PuppetService] = {}  # requests of this side without a response yet
        self._repeated: list[
            tuple[str, Any]
        ] = []  # the other side's requests to a service that both sides have
        homes = engine.recorder, self.recording.graph, self.recording
        found = [pair for home in homes for pair in vars(home).items()]
        self._lists = {name: items for name, items in found if isinstance(items, list)}
        self._seen: dict[str, int] = {}  # how much of each of these lists is news no more
        self._topology = -1
        self._entered = 0  # events of the other side
        engine.link = self

    def close(self) -> None:
        """Destroy all that stands for the other side."""
        self.puppets.close()

    # -- what goes out -----------------------------------------------------------------------------

    def gather(self, thorough: bool = True) -> None:
        """Add to the news what the nodes of this side have done.

        thorough: look also for what the engine is not told of: ends that were destroyed.
        """
        if thorough or self._topology != self.engine.topology:
            self._topology = self.engine.topology
            self._gather_ends()
        self.gather_exchanges()
        self._gather_messages()
        if thorough:
            self._gather_gone()

    def gather_exchanges(self) -> None:
        """Add requests and responses to the news."""
        self.gather_requests()
        self.gather_responses()

    def take_news(self) -> list[Event]:
        """The news, and nothing is left of them."""
        news, self.news = self.news, []
        return news

    def new(self, name: str) -> list[Any]:
        """What is new in this list of the recording, of its graph or of the recorder."""
        items, start = self._lists[name], self._seen.get(name, 0)
        if start == len(items):
            return []
        self._seen[name] = len(items)
        return items[start:]

    def skip(self, *names: str) -> None:
        """What the other side's news have added to these lists is no news of this side."""
        for name in names:
            self.new(name)

    def _gather_ends(self) -> None:
        for end in self.new("ends"):
            number = next(self.keys)
            self._own[number] = end
            node = self._nodes.setdefault(id(end.node), next(self.keys))
            profile = None if end.qos is None else plain_qos(end.qos)
            self.news.append(
                ["end", number, node, end.node_name, end.kind, end.name, type_name(end.type), profile]
            )
            if end.kind == "publisher" and end.qos.durability is DurabilityPolicy.TRANSIENT_LOCAL:
                self._latched.add(end.name)

    def _gather_gone(self) -> None:
        gone = [number for number, end in self._own.items() if not alive(end.handle)]
        for number in gone:
            del self._own[number]
        if gone:
            self.news.append(["gone", gone])

    def _gather_messages(self) -> None:
        for heard in self.new("heard"):
            if self.crosses(heard):
                self.news.append(["message", heard.sender, heard.topic, packed(heard.raw)])
        for part in self.puppets.listening:
            while (raw := part.take()) is not None:
                self.news.append(["message", "", part.name, packed(raw)])

    def crosses(self, heard: Heard) -> bool:
        """Whether the other side has to know of a message of this side."""
        return bool(self.puppets.wanted[heard.topic]) or heard.topic in self._latched

    def gather_requests(self) -> None:
        """Add the requests that clients of this side have made to services of the other."""
        for service in self.puppets.services:
            while service.of_action or service._sim_inbox:
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
        self.tell_request(["ask", key, service.name, call.client if call else "", packed(raw)], call)

    def tell_request(self, event: Event, call: Call | None) -> None:
        """Add a request to the news. call: the one that it belongs to; None for a part of an action."""
        self.news.append(event)

    def gather_responses(self) -> None:
        """Add the responses that services of this side have given to clients of the other."""
        for clients in self.puppets.clients.values():
            for client in clients:
                while client.asked and (taken := client.take()) is not None:
                    key, response = taken
                    if key is not None:
                        self.news.append(["answer", key, packed(encode(response))])

    # -- what comes in -----------------------------------------------------------------------------

    def enter(self, news: Any) -> None:
        """Let what the other side did be so here too. Raises Nonsense for what can't be."""
        self._entered += len(rows(news, "events", MOST_EVENTS))
        if self._entered > ALL_EVENTS:
            raise Nonsense(f"more than {ALL_EVENTS} events")
        for event in news:
            self.hurry()
            word = event[0] if isinstance(event, list) and event else None
            known = self.EVENTS.get(word) if isinstance(word, str) else None
            if known is None:
                raise Nonsense("an event of no known kind")
            act, width = known
            if len(event) != width:
                raise Nonsense(f"the event {word!r} with {len(event) - 1} parts, not {width - 1}")
            act(self, *event[1:])
        if news:
            self.engine.activity += 1
            self._topology = self.engine.topology

    def hurry(self) -> None:
        """Called before each event that comes in."""

    def _end(self, number: Any, node: Any, of: Any, kind: Any, name: Any, type_: Any, profile: Any) -> None:
        told = self.puppets.declare(number, node, of, kind, name, type_, profile)
        self.declared(*told)

    def declared(self, kind: str, node: Any, name: str, type_: type, profile: Any) -> None:
        """A node of the other side has declared an end."""

    def _gone(self, numbers: Any) -> None:
        for number in rows(numbers, "numbers", MOST_ENDS):
            if number not in self.puppets:
                raise Nonsense("the end of something that there is not")
            self.puppets.remove(number)

    def _message(self, node: Any, topic: Any, raw: Any) -> None:
        node, topic = text(node, "a node's name", MOST_NAME), text(topic, "a topic", MOST_NAME)
        publisher = self.puppets.publisher(node, topic)
        if publisher is None:
            raise Nonsense(f"a message on {topic!r}, where {node!r} has no publisher")
        bytes_ = self.unpacked(raw, publisher)
        publisher.handle.publish_raw(bytes_)
        if not publisher.of_action:
            self.published(publisher, bytes_)

    def unpacked(self, raw: Any, publisher: PuppetPublisher) -> bytes:
        """The bytes of a message."""
        return message_bytes(raw, publisher.type, f"a message on {publisher.name}")

    def published(self, publisher: PuppetPublisher, raw: bytes) -> None:
        """A message of the other side is out: its subscriptions have something to take."""
        sent = self.engine.sent
        sent[publisher.name] = sent.get(publisher.name, 0) + 1

    def _ask(self, key: Any, service: Any, node: Any, raw: Any) -> None:
        key = whole(key, "a key")
        service, node = text(service, "a service", MOST_NAME), text(node, "a node's name", MOST_NAME)
        client = self.puppets.client(node, service)
        if client is None:
            raise Nonsense(f"a request to {service!r}, of which {node!r} has no client")
        request, bytes_ = message(raw, client.type.Request, f"a request to {service}")
        if any(end.name == service for end in self.puppets.services):  # which gets it, too
            self._repeated.append((service, request))
        number = client.ask(key, request)
        if not client.of_action:
            self.engine.recorder.calls.asked(client, number, bytes_)
            self.has_asked(key, client, number)

    def has_asked(self, key: int, client: PuppetClient, number: int) -> None:
        """A node of the other side has sent a request; `number` is that of the puppet which sent it here."""

    def _answer(self, key: Any, raw: Any) -> None:
        service = self._answering.pop(whole(key, "a key"), None)
        if service is None:
            raise Nonsense("a response to a request that nobody has made")
        response, bytes_ = message(raw, service.type.Response, f"a response of {service.name}")
        self.answered(key, service, response, bytes_)

    def answered(self, key: int, service: PuppetService, response: Any, raw: bytes) -> Any:
        """A service of the other side has answered; gives the request."""
        return service.answer(key, response)

    EVENTS: ClassVar[dict[str, tuple[Any, int]]] = {  # what each does, and how long it is
        "end": (_end, 8),
        "gone": (_gone, 2),
        "message": (_message, 4),
        "ask": (_ask, 5),
        "answer": (_answer, 3),
    }
