"""Requests, responses and what else services and actions send through the network: late, and never lost.

The middleware carries them at once. Here they are held back until they would have come: in order, and what
was lost on the way comes again with one of the publisher's heartbeats.
"""

from __future__ import annotations

import heapq
from collections import Counter, defaultdict, deque
from collections.abc import Callable
from itertools import count
from random import Random
from typing import TYPE_CHECKING, Any

from rclpy.action import ActionClient, ActionServer

from sim.evidence import Call, Seconds
from sim.nanoseconds import Nanoseconds, nanoseconds
from sim.network import LAPTOP
from sim.ros.messages.cdr import canonical
from sim.ros.messages.codec import encode, type_name
from sim.ros.recorder.calls import alive
from sim.ros.recorder.kept import ClientRecord
from sim.ros.transport.action_endpoints import take_at_client, take_at_server
from sim.ros.transport.channels import RESPONSE, HostLink
from sim.ros.transport.outgoing import HEARTBEAT
from sim.ros.transport.qos import queue_length

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine

MOST_HEARTBEATS = 1000  # after these nobody waits any more
PART = "/_action/"
KINDS = {"send_goal": "goal", "cancel_goal": "cancel", "get_result": "result"}  # services of an action


class DelayQueue:
    """What has been sent to one end and has not come yet; and what has come, up to the length of a queue."""

    def __init__(self, engine: Engine, length: int | None = None) -> None:
        self._engine = engine
        self._coming: list[tuple[Nanoseconds, int, Any]] = []
        self._numbers = count()
        self._come: deque[Any] = deque(maxlen=length)

    def put(self, due: Nanoseconds | None, what: Any) -> None:
        """Something comes at this time; None: never."""
        if due is not None:
            heapq.heappush(self._coming, (due, next(self._numbers), what))
            if due > self._engine.now:
                self._engine.agenda.schedule_arrival(due, self.look)
            else:
                self.look()

    def look(self) -> None:
        """Time has moved on, so something may have come."""
        while self._coming and self._coming[0][0] <= self._engine.now:
            self._come.append(heapq.heappop(self._coming)[2])
        self._engine.activity += 1

    def take(self) -> Any:
        """The first that has come; None if nothing has."""
        return self._come.popleft() if self._come else None


class ServiceTransport:
    """The network between the ends of services and actions in one run."""

    def __init__(self, engine: Engine) -> None:
        self._engine = engine
        self._held: dict[tuple[int, str], tuple[Any, DelayQueue]] = {}  # with the endpoint: keeps its id
        self._sent: Counter[tuple[Any, ...]] = Counter()  # at each moment
        self._last: dict[tuple[str, ...], Nanoseconds] = defaultdict(int)
        self._beats: dict[tuple[str, ...], Nanoseconds] = defaultdict(int)  # when heartbeats began to count

    def collect(self) -> bool:
        """Let set out what was sent at this moment; whether any of it is there at once."""
        before, recorder = self._engine.activity, self._engine.recorder
        for service in recorder.calls.asked_services():
            self._collect_requests(service)
        for end in filter(None, (known() for known in recorder.goals.ends)):
            if isinstance(end, ActionServer) and alive(end._handle):
                self._collect_at_server(end)
            elif isinstance(end, ActionClient) and alive(end._client_handle):
                self._collect_at_client(end)
        return self._engine.activity != before

    def request(self, service: Any) -> tuple[Any, Any] | None:
        """The next request that has come to a service, and its header."""
        self._collect_requests(service)
        request, header, calls = self._of(service, "requests").take() or (None, None, [])
        if header is None:
            return None
        service._sim.inbox.appendleft((header.request_id.sequence_number, calls))
        return request, header

    def _collect_requests(self, service: Any) -> None:
        held = self._of(service, "requests", queue_length(service.qos_profile))
        while True:
            request, header = service.handle.service_take_request(service.srv_type.Request)
            if header is None:
                return
            due, calls = self._due_request(service, header.request_id.sequence_number, request)
            held.put(due, (request, header, calls))

    def _due_request(self, service: Any, number: int, request: Any) -> tuple[Nanoseconds | None, list[Call]]:
        recorder, name, server = self._engine.recorder, service.service_name, service._sim.node
        if PART in name:
            action, _, part = name.partition(PART)
            client = recorder.goals.client_of(action, _goal_id(request))
            return self._due(KINDS[part], action, client, server), []
        raw = canonical(f"{type_name(service.srv_type)}_Request", encode(request))
        calls = recorder.calls.sent(service, number, raw)
        if not calls:
            return self._engine.now, []
        return self._due("request", name, calls[0].client, server, len(raw), calls[0].requested), calls

    def response(self, client: Any) -> tuple[Any, Any] | None:
        """The header of the next response that has come to a client, and the response."""
        held = self._of(client, "responses")
        while True:
            header, response = client.handle.take_response(client.srv_type.Response) or (None, None)
            if header is None:
                return held.take()
            held.put(self._due_response(client._sim, header.request_id.sequence_number), (header, response))

    def _due_response(self, client: ClientRecord, number: int) -> Nanoseconds | None:
        if PART in client.service:
            action, _, part = client.service.partition(PART)
            return self._due(KINDS[part], action, self._engine.recorder.goals.server_of(action), client.node)
        _, calls = client.requests.get(number, (number, []))
        answered = [call for call in calls if call.answered is not None]
        if not answered:
            return self._engine.now
        call = min(answered, key=lambda call: call.answered)
        size = len(call.raw_response)
        return self._due("response", client.service, call.server, client.node, size=size, since=call.answered)

    def news(self, subscriber: Any, node: str, take: Callable[[], bytes | None]) -> bytes | None:
        """The next feedback or status of an action that has come to what listens for a client of `node`."""
        action, _, part = subscriber.name.partition(PART)
        held = self._of(subscriber, part)
        while (raw := take()) is not None:
            held.put(self._due(part, action, self._engine.recorder.goals.server_of(action), node), raw)
        return held.take()

    def at_server(self, server: Any) -> dict[str, Any]:
        """What has come to an action server: at most one goal, wish to cancel and question for a result."""
        self._collect_at_server(server)
        return self._taken(server, ("goal", "cancel", "result"))

    def _collect_at_server(self, server: Any) -> None:
        goals, action = self._engine.recorder.goals, server._sim.action
        while data := take_at_server(server):
            for kind, (header, request) in data.items():
                due = self._due(kind, action, goals.client_of(action, _goal_id(request)), server._sim.node)
                self._of(server, kind).put(due, (header, request))

    def at_client(self, client: Any) -> dict[str, Any]:
        """What has come to an action client: at most one thing of each kind."""
        self._collect_at_client(client)
        return self._taken(client, ("goal", "cancel", "result", "feedback", "status"))

    def _collect_at_client(self, client: Any) -> None:
        action = client._sim.action
        server = self._engine.recorder.goals.server_of(action)
        while data := take_at_client(client):
            for kind, what in data.items():
                self._of(client, kind).put(self._due(kind, action, server, client._sim.node), what)

    def _taken(self, end: Any, kinds: tuple[str, ...]) -> dict[str, Any]:
        found = {kind: self._of(end, kind).take() for kind in kinds}
        return {kind: what for kind, what in found.items() if what is not None}

    def _due(
        self, kind: str, name: str, sender: str, receiver: str, size: int = 0, since: Seconds | None = None
    ) -> Nanoseconds | None:
        """When something that a node sent at `since`, or now, reaches another one; None: never.

        kind: what it is. name: of the service or action. sender, receiver: full names of the nodes.
        """
        begin = self._engine.now if since is None else nanoseconds(since)
        hosts = self._engine.recording.hosts
        ends = hosts.get(sender, LAPTOP), hosts.get(receiver, LAPTOP)
        if ends[0] == ends[1]:
            return begin
        key = kind, name, sender, receiver
        self._sent[(*key, begin)] += 1
        chance = self._engine.links.chance(*key, str(begin), str(self._sent[(*key, begin)]))
        there, back = self._engine.links.between(*ends), self._engine.links.between(*reversed(ends))
        if begin >= self._beats[key] + HEARTBEAT:
            self._beats[key] = begin
        came = there.cross(chance, size, begin)
        if came is None:
            came = _later(there, back, chance, self._beats[key])
        if came is not None:
            came = self._last[key] = max(came, self._last[key])
        return came

    def _of(self, end: Any, kind: str, length: int | None = None) -> DelayQueue:
        key = id(end), kind
        if key not in self._held:
            self._held[key] = end, DelayQueue(self._engine, length)
        return self._held[key][1]


def _goal_id(request: Any) -> Any:
    return request.goal_info.goal_id if hasattr(request, "goal_info") else request.goal_id


def _later(there: HostLink, back: HostLink, chance: Random, begin: Nanoseconds) -> Nanoseconds | None:
    """When something that was lost comes, with the heartbeats that count from `begin`."""
    for beat in range(1, MOST_HEARTBEATS):
        asked = there.travel(chance, begin + beat * HEARTBEAT)
        wanted = None if asked is None else back.travel(chance, asked + RESPONSE)
        came = None if wanted is None else there.travel(chance, wanted + RESPONSE)
        if came is not None:
            return came
    return None
