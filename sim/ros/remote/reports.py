"""The side of the nodes: what they say of themselves, for the other side's recording.

The recording of this side is only a notebook: what is new in it is told, and stamped by the other side.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from sim.evidence import Call, Goal, Message
from sim.ros.engine.delivery.reader import Reader, Sent
from sim.ros.messages.codec import encode
from sim.ros.remote import events
from sim.ros.remote.link import Link
from sim.ros.remote.news import News
from sim.ros.remote.parts import PuppetClient, PuppetPublisher, PuppetService

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine

# Whose client and server a call has: the other side writes down itself what its own nodes do.
INNER, ASKED_HERE, ASKED_THERE = "inner", "asked here", "asked there"
RESULT_SERVICE = "/_action/get_result"
STAMPED = {"logs", "prints", "errors", "busy_loops", "unheard", "parameters"}
MOST_PIECES = 1_000  # printed at a moment


@dataclass
class _OpenCall:
    key: int
    call: Call
    whose: str
    told: set[str]

    def news(self) -> Iterator[Any]:
        """What happened to the call since the last time."""
        call, key = self.call, self.key
        if self.whose != ASKED_HERE:
            if call.server and self._first("taken"):
                yield events.CallTaken(key, call.server)
            if call.raised and self._first("raised"):
                yield events.CallRaised(key, call.raised)
        if self.whose is INNER and call.raw_response is not None and self._first("response"):
            yield events.CallAnswered(key, call.raw_response)
        if self.whose != ASKED_THERE and call.received is not None and self._first("received"):
            yield events.CallReceived(key)

    def _first(self, word: str) -> bool:
        new = word not in self.told
        self.told.add(word)
        return new

    @property
    def over(self) -> bool:
        """Whether nothing more can happen to it."""
        if self.whose is ASKED_THERE:
            return self.call.answered is not None or bool(self.call.raised)
        return self.call.lost or "received" in self.told


@dataclass
class _OpenGoal:
    key: int
    goal: Goal
    told: set[str]
    events: int = 0
    feedback: int = 0

    def news(self) -> Iterator[Any]:
        """What happened to the goal since the last time."""
        goal, key = self.goal, self.key
        if goal.server and self._first("server"):
            yield events.GoalTaken(key, goal.server)
        for _, word in goal.events[self.events :]:
            yield events.GoalEvent(key, word)
        self.events = len(goal.events)
        if goal.server:
            for heard in goal.feedback[self.feedback :]:
                yield events.GoalFeedback(key, heard.raw)
            self.feedback = len(goal.feedback)
            if goal.raw_result is not None and self._first("result"):
                yield events.GoalResult(key, goal.raw_result)
        if goal.answered is not None and self._first("answered"):
            yield events.GoalAnswered(key)
        if goal.received is not None and self._first("received"):
            yield events.GoalReceived(key)

    def _first(self, word: str) -> bool:
        new = word not in self.told
        self.told.add(word)
        return new


class Reports(Link):
    """The side in which the student's programs run."""

    def __init__(self, engine: Engine) -> None:
        super().__init__(engine, keys=1)
        recording, graph = engine.recording, engine.recording.graph
        self._new_calls, self._new_goals = News(recording.calls), News(recording.goals)
        self._claims = {
            "nodes": News(graph.nodes),
            "timers": News(graph.timers),
            "logs": News(recording.logs),
            "prints": News(recording.prints),
            "busy_loops": News(recording.busy_loops),
            "unheard": News(recording.undelivered),
            "parameters": News(recording.parameters),
            "errors": News(recording.errors),
            "callbacks": News(recording.callbacks),
        }
        self._calls: list[_OpenCall] = []
        self._goals: list[_OpenGoal] = []
        self._asks: dict[int, events.Ask] = {}  # requests to the other side, by the id of their call

    def crosses(self, heard: Message) -> bool:
        """All do: the other side writes down what is said."""
        return True

    def unpacked(self, raw: Any, publisher: PuppetPublisher) -> bytes:
        """The bytes of a message: the other side is believed, and a look into each takes time."""
        return raw

    # -- calls and goals ---------------------------------------------------------------------------

    def gather_exchanges(self) -> None:
        """Add what happened to calls and goals: first that, for it explains the responses."""
        self.gather_requests()
        self._gather_calls()
        self._gather_goals()
        self.gather_responses()

    def tell_request(self, event: events.Ask, call: Call | None) -> None:
        """Add a request to the news; one of a service only when its turn comes among the calls."""
        if call is None:
            self.news.append(event)
        else:
            self._asks[id(call)] = event

    def _gather_calls(self) -> None:
        for call in self._new_calls.take():
            event, whose = self._asks.pop(id(call), None), ASKED_HERE
            if event is None:
                about = call.service, call.type, call.client, call.requested is not None
                made = events.CallMade(next(self.keys), *about, call.raw_request, call.lost)
                event, whose = made, INNER
            self.news.append(event)
            self._calls.append(_OpenCall(event.key, call, whose, set()))
        for kept in self._calls:
            self.news += kept.news()
        self._calls = [kept for kept in self._calls if not kept.over]

    def has_asked(self, key: int, client: PuppetClient, number: int) -> None:
        """A call of the other side is under way to a service of this one."""
        _, calls = client._sim.requests[number]
        self._calls += [_OpenCall(key, call, ASKED_THERE, set()) for call in calls]
        self._new_calls.take()

    def _gather_goals(self) -> None:
        for goal in self._new_goals.take():
            key = next(self.keys)
            about = goal.action, goal.type, goal.client, goal.id
            self.news.append(events.GoalMade(key, *about, goal.raw_request, goal.lost))
            self._goals.append(_OpenGoal(key, goal, set()))
        for kept in self._goals:
            self.news += kept.news()

    def answered(self, key: int, service: PuppetService, response: Any, raw: bytes) -> Any:
        """Write a response down: the client that gets it here looks there."""
        for kept in self._calls:
            if kept.key == key:
                self.engine.recorder.calls.answered(kept.call, raw)
        request = super().answered(key, service, response, raw)
        if service.name.endswith(RESULT_SERVICE):
            action = service.name.removesuffix(RESULT_SERVICE)
            for goal in self.engine.recorder.goals.known(action, request.goal_id):
                goal.raw_result = goal.raw_result or encode(response.result)
        return request

    # -- what comes through the network --------------------------------------------------------------

    def _arrived(self, event: events.Arrived) -> None:
        reader = self._reader(event.number)
        if reader is not None:
            if event.missed:
                reader.missed(event.missed)
            reader.receive(Sent(event.raw, event.stamp, event.count, event.expires))

    def _sign(self, event: events.Sign) -> None:
        reader = self._reader(event.number)
        publisher = None if reader is None else self.puppets.publisher(event.node, reader.topic)
        if publisher is not None and reader.liveliness is not None:
            reader.liveliness.sign(publisher.writer)

    def _reader(self, number: int) -> Reader | None:
        end = self.own.get(number)
        return None if end is None else self.engine.topics.reader_of(end.name, end.handle)

    HANDLERS: ClassVar[dict[type, Callable[..., None]]] = Link.HANDLERS | {
        events.Arrived: _arrived,
        events.Sign: _sign,
    }

    # -- what else is told -------------------------------------------------------------------------

    def claims(self) -> dict[str, list[Any]]:
        """What the nodes say of themselves, since the last time; no word where there is nothing."""
        new = {kind: told for kind, news in self._claims.items() if (told := news.take())}
        for kind in STAMPED & new.keys():
            new[kind] = [row[1:] for row in new[kind]]  # the other side's clock stamps them
        if "logs" in new:
            new["logs"] = [line[:3] for line in new["logs"]]  # it knows whose they are
        if "prints" in new:
            pieces = [piece for (piece,) in new["prints"]]
            many = len(pieces) > MOST_PIECES  # a loop that prints without end
            new["prints"] = ["".join(pieces)] if many else pieces
        return new
