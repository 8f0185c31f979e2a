"""The follower's link to the leader: it reports what the nodes of this process do.

The recording of this process is a scratch buffer: new entries are sent to the leader, which stamps them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from sim.evidence import Call, Goal, Message
from sim.ros.messages.codec import encode
from sim.ros.recorder.records import CLIENT
from sim.ros.remote import events
from sim.ros.remote.new_items import NewItems
from sim.ros.remote.process_link import ProcessLink
from sim.ros.remote.proxy import ProxyClient, ProxyPublisher, ProxyService
from sim.ros.transport.endpoint import Sample
from sim.ros.transport.reader import DataReader

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine

# Which process has the client and the server of a call; the leader records what its own nodes do.
BOTH_HERE, CLIENT_HERE, SERVER_HERE = "both here", "client here", "server here"
RESULT_SERVICE = "/_action/get_result"
WITH_STAMP = {"logs", "prints", "errors", "busy_loops", "unheard", "parameters", "node_facts"}
MAX_PRINT_PIECES = 1_000  # of printed text, at a time step


@dataclass
class _OpenCall:
    key: int
    call: Call
    location: str
    reported: set[str]

    def new_events(self) -> Iterator[Any]:
        """Events for what happened to the call since the last time."""
        call, key = self.call, self.key
        if self.location != CLIENT_HERE:
            if call.server and self._first("started"):
                yield events.CallStarted(key, call.server)
            if call.raised and self._first("raised"):
                yield events.CallRaised(key, call.raised)
        if self.location is BOTH_HERE and call.raw_response is not None and self._first("answered"):
            yield events.CallAnswered(key, call.raw_response)
        if self.location != SERVER_HERE and call.received is not None and self._first("received"):
            yield events.CallReceived(key)

    def _first(self, event: str) -> bool:
        new = event not in self.reported
        self.reported.add(event)
        return new

    @property
    def finished(self) -> bool:
        """Return whether nothing more can happen to the call."""
        if self.location is SERVER_HERE:
            return self.call.answered is not None or bool(self.call.raised)
        return self.call.lost or "received" in self.reported


@dataclass
class _OpenGoal:
    key: int
    goal: Goal
    reported: set[str]
    events: int = 0
    feedback: int = 0

    def new_events(self) -> Iterator[Any]:
        """Events for what happened to the goal since the last time."""
        goal, key = self.goal, self.key
        if goal.server and self._first("started"):
            yield events.GoalStarted(key, goal.server)
        for _, event in goal.events[self.events :]:
            yield events.GoalEvent(key, event)
        self.events = len(goal.events)
        if goal.server:
            for message in goal.feedback[self.feedback :]:
                yield events.GoalFeedback(key, message.raw)
            self.feedback = len(goal.feedback)
            if goal.raw_result is not None and self._first("result"):
                yield events.GoalResult(key, goal.raw_result)
        if goal.answered is not None and self._first("answered"):
            yield events.GoalAnswered(key)
        if goal.received is not None and self._first("received"):
            yield events.GoalReceived(key)

    def _first(self, event: str) -> bool:
        new = event not in self.reported
        self.reported.add(event)
        return new


class FollowerLink(ProcessLink):
    """The link of the process in which the student's programs run."""

    def __init__(self, engine: Engine) -> None:
        super().__init__(engine, keys=1)
        recording, graph = engine.recording, engine.recording.graph
        self._new_calls, self._new_goals = NewItems(recording.calls), NewItems(recording.goals)
        self._reports: dict[str, Any] = {
            "nodes": NewItems(graph.nodes),
            "timers": NewItems(graph.timers),
            "logs": NewItems(recording.logs),
            "prints": NewItems(recording.prints),
            "busy_loops": NewItems(recording.busy_loops),
            "unheard": NewItems(recording.undelivered),
            "parameters": NewItems(recording.parameters),
            "node_facts": NewItems(recording.node_facts),
            "errors": NewItems(recording.errors),
            "callbacks": NewItems(recording.callbacks),
            "departures": NewItems(recording.departures),
        }
        self._calls: list[_OpenCall] = []
        self._goals: list[_OpenGoal] = []
        self._requests: dict[int, events.RequestSent] = {}  # requests to the leader, by the id of their call

    def must_send(self, message: Message) -> bool:
        """Always true: the leader records all messages."""
        return True

    def message_bytes(self, raw: Any, publisher: ProxyPublisher) -> bytes:
        """The bytes of a message, unchecked: the leader is trusted, and validation takes time."""
        return raw

    # -- calls and goals ---------------------------------------------------------------------------

    def collect_exchanges(self) -> None:
        """Queue events on calls and goals before the responses, which belong to them."""
        self.collect_requests()
        self._collect_calls()
        self._collect_goals()
        self.collect_responses()

    def send_request(self, event: events.RequestSent, call: Call | None) -> None:
        """Queue a request of an action; one of a service is queued later, in the order of the calls."""
        if call is None:
            self.outgoing.append(event)
        else:
            self._requests[id(call)] = event

    def _collect_calls(self) -> None:
        for call in self._new_calls.take():
            event, location = self._requests.pop(id(call), None), CLIENT_HERE
            if event is None:
                about = call.service, call.type, call.client, call.requested is not None
                made = events.CallRequested(next(self.keys), *about, call.raw_request, call.lost)
                event, location = made, BOTH_HERE
            self.outgoing.append(event)
            self._calls.append(_OpenCall(event.key, call, location, set()))
        for open_call in self._calls:
            self.outgoing += open_call.new_events()
        self._calls = [open_call for open_call in self._calls if not open_call.finished]

    def request_received(self, key: int, client: ProxyClient, number: int) -> None:
        """A client of the leader has sent a request to a service of this process."""
        _, calls = CLIENT.of(client).requests[number]
        self._calls += [_OpenCall(key, call, SERVER_HERE, set()) for call in calls]
        self._new_calls.take()

    def _collect_goals(self) -> None:
        for goal in self._new_goals.take():
            key = next(self.keys)
            about = goal.action, goal.type, goal.client, goal.id
            self.outgoing.append(events.GoalRequested(key, *about, goal.raw_request, goal.lost))
            self._goals.append(_OpenGoal(key, goal, set()))
        for open_goal in self._goals:
            self.outgoing += open_goal.new_events()

    def answered(self, key: int, service: ProxyService, response: Any, raw: bytes) -> Any:
        """Record the response, where the client in this process looks for it, then send it."""
        for open_call in self._calls:
            if open_call.key == key:
                self.engine.recorder.calls.response_sent(open_call.call, raw)
        request = super().answered(key, service, response, raw)
        if service.name.endswith(RESULT_SERVICE):
            action = service.name.removesuffix(RESULT_SERVICE)
            for goal in self.engine.recorder.goals.with_id(action, request.goal_id):
                goal.raw_result = goal.raw_result or encode(response.result)
        return request

    # -- deliveries of the simulated network ---------------------------------------------------------

    def _message_delivered(self, event: events.MessageDelivered) -> None:
        reader = self._reader(event.number)
        if reader is not None:
            if event.missed:
                reader.on_lost(event.missed)
            reader.receive(Sample(event.raw, event.stamp, event.count, event.expires))

    def _liveliness_delivered(self, event: events.LivelinessDelivered) -> None:
        reader = self._reader(event.number)
        publisher = None if reader is None else self.proxies.publisher(event.node, reader.topic)
        if publisher is not None and reader.liveliness is not None:
            reader.liveliness.assert_liveliness(publisher.writer)

    def _reader(self, number: int) -> DataReader | None:
        end = self.local.get(number)
        return None if end is None else self.engine.transport.topics.reader_of(end.name, end.handle)

    HANDLERS: ClassVar[dict[type, Callable[..., None]]] = ProcessLink.HANDLERS | {
        events.MessageDelivered: _message_delivered,
        events.LivelinessDelivered: _liveliness_delivered,
    }

    # -- self-reports ------------------------------------------------------------------------------

    def take_self_reports(self) -> dict[str, list[Any]]:
        """New log lines, prints, errors and so on of the nodes, by kind; only kinds that have any."""
        new = {kind: items for kind, source in self._reports.items() if (items := source.take())}
        for kind in WITH_STAMP & new.keys():
            new[kind] = [row[1:] for row in new[kind]]  # the leader stamps them
        if "logs" in new:
            new["logs"] = [line[:3] for line in new["logs"]]  # the leader knows whose they are
        if "prints" in new:
            pieces = [piece for (piece,) in new["prints"]]
            many = len(pieces) > MAX_PRINT_PIECES  # an endless loop that prints
            new["prints"] = ["".join(pieces)] if many else pieces
        return new
