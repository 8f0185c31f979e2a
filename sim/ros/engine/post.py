"""Requests, responses and what else services and actions send through the network: late, and never lost.

The middleware carries them at once. Here they are held back until they would have come: in order, and what
was lost on the way comes again with one of the publisher's heartbeats.
"""

from __future__ import annotations

import heapq
from collections import defaultdict
from itertools import count
from random import Random
from typing import TYPE_CHECKING, Any

from sim.nanoseconds import Nanoseconds, nanoseconds
from sim.network import LAPTOP
from sim.ros.engine.action_ends import taken_by_client, taken_by_server
from sim.ros.engine.channels import RESPONSE, Link
from sim.ros.engine.outgoing import HEARTBEAT
from sim.ros.messages.cdr import canonical
from sim.ros.messages.codec import encode, type_name

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine

MOST_HEARTBEATS = 1000  # after these nobody waits any more


class Held:
    """What has been sent and has not come yet, for one end."""

    def __init__(self, engine: Engine) -> None:
        self._engine = engine
        self._waiting: list[tuple[Nanoseconds, int, Any]] = []
        self._numbers = count()

    def put(self, due: Nanoseconds | None, what: Any) -> None:
        """Something comes at this time; None: never."""
        if due is None:
            return
        heapq.heappush(self._waiting, (due, next(self._numbers), what))
        if due > self._engine.now:
            self._engine.agenda.arrive(due, self._come)

    def take(self) -> Any:
        """The first that has come; None if nothing has."""
        if self._waiting and self._waiting[0][0] <= self._engine.now:
            return heapq.heappop(self._waiting)[2]
        return None

    def _come(self) -> None:
        self._engine.activity += 1


class Post:
    """The network between the ends of services and actions in one run."""

    def __init__(self, engine: Engine) -> None:
        self._engine = engine
        self._held: dict[tuple[int, str], tuple[Any, Held]] = {}  # with the end, so that its id stays its own
        self._chances: dict[tuple[str, ...], Random] = {}
        self._last: dict[tuple[str, ...], Nanoseconds] = defaultdict(int)
        self._beats: dict[tuple[str, ...], Nanoseconds] = defaultdict(int)  # when heartbeats began to count

    def request(self, service: Any, server: str) -> tuple[Any, Any] | None:
        """The next request that has come to a service of the node `server`, and its header."""
        held = self._of(service, "requests")
        while True:
            request, header = service.handle.service_take_request(service.srv_type.Request)
            if header is None:
                return held.take()
            raw = canonical(f"{type_name(service.srv_type)}_Request", encode(request))
            found = self._engine.recorder.calls.waiting(service, header.request_id.sequence_number, raw)
            due = self._engine.now
            if found is not None:
                way = "request", service.service_name, found.client, server
                due = self.arrival(*way, size=len(raw), since=nanoseconds(found.asked))
            held.put(due, (request, header))

    def response(self, client: Any) -> tuple[Any, Any] | None:
        """The next response that has come to a client, after its header."""
        held = self._of(client, "responses")
        while True:
            header, response = client.handle.take_response(client.srv_type.Response) or (None, None)
            if header is None:
                return held.take()
            kept = client._sim
            _, calls = kept.requests.get(header.request_id.sequence_number, (0, []))
            answered = [call for call in calls if call.answered is not None]
            due = self._engine.now
            if answered:
                call = min(answered, key=lambda call: call.answered)
                way = "response", kept.service, call.server, kept.node
                due = self.arrival(*way, size=len(call.raw_response), since=nanoseconds(call.answered))
            held.put(due, (header, response))

    def at_server(self, server: Any) -> dict[str, Any]:
        """What has come to an action server: at most one goal, wish to cancel and question for a result."""
        client_of = self._engine.recorder.goals.client_of
        while data := taken_by_server(server):
            for kind, (header, request) in data.items():
                goal_id = request.goal_info.goal_id if kind == "cancel" else request.goal_id
                self._hold(server, kind, client_of(server, goal_id), (header, request))
        return self._come(server, ("goal", "cancel", "result"))

    def at_client(self, client: Any) -> dict[str, Any]:
        """What has come to an action client: at most one thing of each kind."""
        server = self._engine.recorder.goals.server_of(client._sim.action)
        while data := taken_by_client(client):
            for kind, what in data.items():
                self._hold(client, kind, server, what)
        return self._come(client, ("goal", "cancel", "result", "feedback", "status"))

    def _hold(self, end: Any, kind: str, sender: str, what: Any) -> None:
        way = kind, end._sim.action, sender, end._sim.node
        self._of(end, kind).put(self.arrival(*way, size=0, since=self._engine.now), what)

    def _come(self, end: Any, kinds: tuple[str, ...]) -> dict[str, Any]:
        found = {kind: self._of(end, kind).take() for kind in kinds}
        return {kind: what for kind, what in found.items() if what is not None}

    def arrival(
        self, kind: str, name: str, sender: str, receiver: str, *, size: int, since: Nanoseconds
    ) -> Nanoseconds | None:
        """When something that a node sent at `since` reaches another one; None: never.

        kind: what it is. name: of the service or action. sender, receiver: full names of the nodes.
        """
        hosts = self._engine.recording.hosts
        ends = hosts.get(sender, LAPTOP), hosts.get(receiver, LAPTOP)
        if ends[0] == ends[1]:
            return since
        key = kind, name, sender, receiver
        chance = self._chances.setdefault(key, self._engine.links.chance(*key))
        there, back = self._engine.links.between(*ends), self._engine.links.between(*reversed(ends))
        if since >= self._beats[key] + HEARTBEAT:
            self._beats[key] = since
        came = there.cross(chance, size, since) or _later(there, back, chance, self._beats[key])
        if came is not None:
            came = self._last[key] = max(came, self._last[key])
        return came

    def _of(self, end: Any, kind: str) -> Held:
        return self._held.setdefault((id(end), kind), (end, Held(self._engine)))[1]


def _later(there: Link, back: Link, chance: Random, begin: Nanoseconds) -> Nanoseconds | None:
    """When something that was lost comes, with the heartbeats that count from `begin`."""
    for beat in range(1, MOST_HEARTBEATS):
        asked = there.travel(chance, begin + beat * HEARTBEAT)
        wanted = None if asked is None else back.travel(chance, asked + RESPONSE)
        came = None if wanted is None else there.travel(chance, wanted + RESPONSE)
        if came is not None:
            return came
    return None
