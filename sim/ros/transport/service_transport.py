"""Requests, responses and what else services and actions send through the network: late, and never lost.

The middleware carries them at once. Here they are held back until they would have arrived: in order, and what
was lost on the way comes again with one of the publisher's heartbeats.
"""

from __future__ import annotations

import heapq
from collections import Counter, defaultdict, deque
from collections.abc import Callable
from itertools import count
from random import Random
from typing import Any

from rclpy.action import ActionClient, ActionServer

from sim.evidence import Call, Seconds
from sim.nanoseconds import Nanoseconds, nanoseconds
from sim.network import LAPTOP
from sim.ros.messages.cdr import canonical
from sim.ros.messages.codec import encode, type_name
from sim.ros.recorder.calls import alive
from sim.ros.recorder.records import ACTION, CLIENT, SERVICE, ClientRecord
from sim.ros.transport.action_endpoints import take_at_client, take_at_server
from sim.ros.transport.channels import RESPONSE
from sim.ros.transport.context import TransportContext
from sim.ros.transport.history import HEARTBEAT
from sim.ros.transport.links import HostLink
from sim.ros.transport.qos import queue_length

MOST_HEARTBEATS = 1000  # after so many the message is given up
PART = "/_action/"
KINDS = {"send_goal": "goal", "cancel_goal": "cancel", "get_result": "result"}  # services of an action


class DelayQueue:
    """The messages sent to one endpoint: those not arrived yet; those arrived, up to a queue's length."""

    def __init__(self, run: TransportContext, on_arrival: Callable[[], None], length: int | None) -> None:
        self._run, self._on_arrival = run, on_arrival
        self._coming: list[tuple[Nanoseconds, int, Any]] = []
        self._numbers = count()
        self._arrived: deque[Any] = deque(maxlen=length)

    def put(self, due: Nanoseconds | None, what: Any) -> None:
        """This arrives at that time; None: never."""
        if due is not None:
            heapq.heappush(self._coming, (due, next(self._numbers), what))
            if due > self._run.scheduler.now:
                self._run.events.schedule_arrival(due, self._arrive)
            else:
                self._arrive()

    def _arrive(self) -> None:
        while self._coming and self._coming[0][0] <= self._run.scheduler.now:
            self._arrived.append(heapq.heappop(self._coming)[2])
        self._on_arrival()

    def take(self) -> Any:
        """The first that has arrived; None if nothing has."""
        return self._arrived.popleft() if self._arrived else None


class ServiceTransport:
    """The network between the endpoints of services and actions in one run."""

    def __init__(self, run: TransportContext) -> None:
        self._run, self._recorder = run, run.recorder
        # By endpoint and kind; the endpoint is stored as well, so that no other gets its id.
        self._queues: dict[tuple[int, str], tuple[Any, DelayQueue]] = {}
        self._sent: Counter[tuple[Any, ...]] = Counter()  # at each moment
        self._last: dict[tuple[str, ...], Nanoseconds] = defaultdict(int)
        self._beats: dict[tuple[str, ...], Nanoseconds] = defaultdict(int)  # when heartbeats began to count
        self._arrivals = 0

    def collect(self) -> bool:
        """Put on the network what was sent at this moment; whether any of it has already arrived."""
        before, recorder = self._arrivals, self._recorder
        for service in recorder.calls.services_with_requests():
            self._collect_requests(service)
        for endpoint in recorder.goals.endpoints():
            if isinstance(endpoint, ActionServer) and alive(endpoint._handle):
                self._collect_at_server(endpoint)
            elif isinstance(endpoint, ActionClient) and alive(endpoint._client_handle):
                self._collect_at_client(endpoint)
        return self._arrivals != before

    def _on_arrival(self) -> None:
        self._arrivals += 1
        self._run.scheduler.wake_all()

    def request(self, service: Any) -> tuple[Any, Any] | None:
        """The next request that has arrived at a service, and its header."""
        self._collect_requests(service)
        request, header, calls = self._queue(service, "requests").take() or (None, None, [])
        if header is None:
            return None
        SERVICE.of(service).inbox.appendleft((header.request_id.sequence_number, calls))
        return request, header

    def _collect_requests(self, service: Any) -> None:
        queue = self._queue(service, "requests", queue_length(service.qos_profile))
        while True:
            request, header = service.handle.service_take_request(service.srv_type.Request)
            if header is None:
                return
            due, calls = self._due_request(service, header.request_id.sequence_number, request)
            queue.put(due, (request, header, calls))

    def _due_request(self, service: Any, number: int, request: Any) -> tuple[Nanoseconds | None, list[Call]]:
        recorder, name, server = self._recorder, service.service_name, SERVICE.of(service).node
        if PART in name:
            action, _, part = name.partition(PART)
            client = recorder.goals.client_of(action, _goal_id(request))
            return self._due(KINDS[part], action, client, server), []
        raw = canonical(f"{type_name(service.srv_type)}_Request", encode(request))
        calls = recorder.calls.calls_of(service, number, raw)
        if not calls:
            return self._run.scheduler.now, []
        return self._due("request", name, calls[0].client, server, len(raw), calls[0].requested), calls

    def response(self, client: Any) -> tuple[Any, Any] | None:
        """The header of the next response that has arrived at a client, and the response."""
        queue = self._queue(client, "responses")
        while True:
            header, response = client.handle.take_response(client.srv_type.Response) or (None, None)
            if header is None:
                return queue.take()
            due = self._due_response(CLIENT.of(client), header.request_id.sequence_number)
            queue.put(due, (header, response))

    def _due_response(self, client: ClientRecord, number: int) -> Nanoseconds | None:
        if PART in client.service:
            action, _, part = client.service.partition(PART)
            return self._due(KINDS[part], action, self._recorder.goals.server_of(action), client.node)
        _, calls = client.requests.get(number, (number, []))
        answered = [call for call in calls if call.answered is not None]
        if not answered:
            return self._run.scheduler.now
        call = min(answered, key=lambda call: call.answered)
        size = len(call.raw_response)
        return self._due("response", client.service, call.server, client.node, size=size, since=call.answered)

    def action_message(self, subscription: Any, node: str, take: Callable[[], bytes | None]) -> bytes | None:
        """The next feedback or status that has arrived at the subscription of an action client of `node`."""
        action, _, part = subscription.name.partition(PART)
        queue = self._queue(subscription, part)
        while (raw := take()) is not None:
            queue.put(self._due(part, action, self._recorder.goals.server_of(action), node), raw)
        return queue.take()

    def at_server(self, server: Any) -> dict[str, Any]:
        """Return what has arrived at an action server: at most one request of each kind."""
        self._collect_at_server(server)
        return self._taken(server, ("goal", "cancel", "result"))

    def _collect_at_server(self, server: Any) -> None:
        goals, record = self._recorder.goals, ACTION.of(server)
        while data := take_at_server(server):
            for kind, (header, request) in data.items():
                sender = goals.client_of(record.action, _goal_id(request))
                due = self._due(kind, record.action, sender, record.node)
                self._queue(server, kind).put(due, (header, request))

    def at_client(self, client: Any) -> dict[str, Any]:
        """Return what has arrived at an action client: at most one of each kind."""
        self._collect_at_client(client)
        return self._taken(client, ("goal", "cancel", "result", "feedback", "status"))

    def _collect_at_client(self, client: Any) -> None:
        record = ACTION.of(client)
        server = self._recorder.goals.server_of(record.action)
        while data := take_at_client(client):
            for kind, what in data.items():
                self._queue(client, kind).put(self._due(kind, record.action, server, record.node), what)

    def _taken(self, endpoint: Any, kinds: tuple[str, ...]) -> dict[str, Any]:
        found = {kind: self._queue(endpoint, kind).take() for kind in kinds}
        return {kind: what for kind, what in found.items() if what is not None}

    def _due(
        self, kind: str, name: str, sender: str, receiver: str, size: int = 0, since: Seconds | None = None
    ) -> Nanoseconds | None:
        """Return when something that a node sent at `since`, or now, reaches another one; None: never.

        kind: what it is. name: of the service or action. sender, receiver: full names of the nodes.
        """
        begin = self._run.scheduler.now if since is None else nanoseconds(since)
        hosts = self._recorder.recording.hosts
        ends = hosts.get(sender, LAPTOP), hosts.get(receiver, LAPTOP)
        if ends[0] == ends[1]:
            return begin
        key = kind, name, sender, receiver
        self._sent[(*key, begin)] += 1
        random = self._run.links.random(*key, str(begin), str(self._sent[(*key, begin)]))
        there, back = self._run.links.between(*ends), self._run.links.between(*reversed(ends))
        if begin >= self._beats[key] + HEARTBEAT:
            self._beats[key] = begin
        arrival = there.cross(random, size, begin)
        if arrival is None:
            arrival = _later(there, back, random, self._beats[key])
        if arrival is not None:
            arrival = self._last[key] = max(arrival, self._last[key])
        return arrival

    def _queue(self, endpoint: Any, kind: str, length: int | None = None) -> DelayQueue:
        key = id(endpoint), kind
        if key not in self._queues:
            self._queues[key] = endpoint, DelayQueue(self._run, self._on_arrival, length)
        return self._queues[key][1]


def _goal_id(request: Any) -> Any:
    return request.goal_info.goal_id if hasattr(request, "goal_info") else request.goal_id


def _later(there: HostLink, back: HostLink, random: Random, begin: Nanoseconds) -> Nanoseconds | None:
    """Return when what was lost arrives after all, with the heartbeats that count from `begin`."""
    for beat in range(1, MOST_HEARTBEATS):
        heartbeat = there.travel(random, begin + beat * HEARTBEAT)
        request = None if heartbeat is None else back.travel(random, heartbeat + RESPONSE)
        arrival = None if request is None else there.travel(random, request + RESPONSE)
        if arrival is not None:
            return arrival
    return None
