"""The leader's link to the student's process: it validates what arrives and writes the recording.

Messages, requests and goals are recorded as they arrive, with the leader's time. All else is self-reported.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from time import monotonic
from typing import TYPE_CHECKING, Any, ClassVar

from unique_identifier_msgs.msg import UUID

from sim.evidence import CANCEL_REJECTED, CANCEL_REQUESTED, REJECTED, STATUSES, Call, Goal, Message
from sim.ros.messages.cdr import canonical
from sim.ros.messages.codec import message_class, type_name
from sim.ros.remote import events
from sim.ros.remote.process_link import ProcessLink
from sim.ros.remote.proxy import ProxyClient, ProxyNode, ProxyPublisher
from sim.ros.remote.self_reports import SelfReports
from sim.ros.remote.validation import (
    MAX_NAME_LENGTH,
    ProtocolError,
    TextBudget,
    valid_int,
    valid_interface,
    valid_message,
    valid_text,
)

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine

GOAL_EVENTS = (*STATUSES, REJECTED, CANCEL_REJECTED)


class LeaderLink(ProcessLink):
    """The link of the process that leads the run and writes the recording."""

    def __init__(self, engine: Engine) -> None:
        super().__init__(engine, keys=0)
        self.deadline = math.inf  # of `apply`, by the clock `monotonic`
        self._calls: dict[int, Call] = {}  # by key: calls whose progress the follower reports
        self._sent: dict[int, tuple[ProxyClient, int]] = {}  # requests of the follower's clients, by key
        self._goals: dict[int, Goal] = {}
        self._started: set[int] = set()  # keys of goals that a server of the follower has taken
        self._texts = TextBudget()
        self.self_reports = SelfReports(engine, self._texts)

    @property
    def _now(self) -> float:
        return self.engine.recorder.now

    def check_deadline(self) -> None:
        """Raises ProtocolError after the deadline: a single event may wake thousands of subscriptions."""
        if monotonic() > self.deadline:
            raise ProtocolError("more than can be processed in the remaining time")

    # -- endpoints, messages and requests ----------------------------------------------------------

    def declared(self, kind: str, node: ProxyNode, name: str, type_: type, profile: Any) -> None:
        """Add an endpoint to the recorded graph."""
        self.engine.recorder.endpoint(kind, node, name, type_, profile)

    def publish(self, publisher: ProxyPublisher, raw: bytes) -> None:
        """Publish and record the message."""
        publisher.writer.publish(raw)

    def send_request(self, event: events.RequestSent, call: Call | None) -> None:
        """Queue the request, and store its call for the follower's reports on it."""
        super().send_request(event, call)
        if call is not None:
            self._calls[event.key] = call

    def request_received(self, key: int, client: ProxyClient, number: int) -> None:
        """A client of the follower has sent a request to a service of the leader."""
        self._sent[key] = client, number

    def answered(self, key: int, service: Any, response: Any, raw: bytes) -> Any:
        """Record the response, then send it to the client."""
        call = self._calls.pop(key, None)
        if call is not None:
            self.engine.recorder.calls.response_sent(call, raw)
        return super().answered(key, service, response, raw)

    # -- calls within the follower, and progress of calls -------------------------------------------

    def _call(self, event: events.CallRequested) -> None:
        cls = valid_interface(valid_text(event.type, "a type", MAX_NAME_LENGTH), "srv")
        _, raw = valid_message(event.raw, cls.Request, "a request")
        service, type_ = valid_text(event.service, "a service", MAX_NAME_LENGTH), type_name(cls)
        self.engine.recorder.count(valid_text(event.client, "a node's name", MAX_NAME_LENGTH), len(raw))
        raw = canonical(f"{type_}_Request", raw)
        client, stamp, from_course = self._caller(event.client, service, type_, raw)
        requested = stamp if event.timed else None
        lost = bool(event.lost)
        call = Call(service, type_, client, raw, requested, lost=lost, requested_by_course=from_course)
        self._calls[self._fresh(event.key, self._calls)] = call
        self.recording.calls.append(call)

    def _call_started(self, event: events.CallStarted) -> None:
        call = self._known(event.key, self._calls, "a call")
        call.server, call.taken = self._follower_node(event.server), self._now

    def _call_raised(self, event: events.CallRaised) -> None:
        self._known(event.key, self._calls, "a call").raised = valid_text(
            event.error, "an error", MAX_NAME_LENGTH
        )

    def _call_answered(self, event: events.CallAnswered) -> None:
        call = self._known(event.key, self._calls, "a call")
        if event.key in self._answering:
            raise ProtocolError("a response without a receiver")
        _, bytes_ = valid_message(event.raw, message_class(f"{call.type}_Response"), "a response")
        self.engine.recorder.calls.response_sent(call, bytes_)

    def _call_received(self, event: events.CallReceived) -> None:
        if valid_int(event.key, "a key") in self._sent:
            client, asked = self._sent.pop(event.key)
            self.engine.recorder.calls.response_received(client, asked)
        else:
            self._known(event.key, self._calls, "a call").received = self._now

    # -- goals ---------------------------------------------------------------------------------------

    def _goal(self, event: events.GoalRequested) -> None:
        key, goals = self._fresh(event.key, self._goals), self.engine.recorder.goals
        cls = valid_interface(valid_text(event.type, "a type", MAX_NAME_LENGTH), "action")
        action = valid_text(event.action, "an action", MAX_NAME_LENGTH)
        try:
            goal_id = UUID(uuid=list(bytes.fromhex(valid_text(event.id, "an id", 32))))
        except (ValueError, AssertionError):
            raise ProtocolError("an invalid goal id") from None
        _, bytes_ = valid_message(event.raw, cls.Goal, "a goal")
        if not event.client:  # a goal of the leader, taken by a server of the follower
            waiting = [goal for goal in goals.with_id(action, goal_id) if not goal.server and not goal.lost]
            if not waiting:
                raise ProtocolError("a goal that no client has sent")
            self._goals[key] = waiting[0]
            return
        client = self._node(event.client)
        end = self.proxies.action(client, action, type_name(cls))
        if end is None:
            raise ProtocolError(f"a goal of {action!r}, of which {client!r} has no client")
        goal = self._goals[key] = goals.add(end, client, goal_id, bytes_, self._now)
        goal.lost = bool(event.lost)

    def _goal_started(self, event: events.GoalStarted) -> None:
        goal = self._known(event.key, self._goals, "a goal")
        if goal.server:
            raise ProtocolError("a goal that another server has taken")
        goal.server = self._follower_node(event.server)
        self._started.add(event.key)

    def _goal_event(self, event: events.GoalEvent) -> None:
        goal, word = self._known(event.key, self._goals, "a goal"), event.event
        if word != CANCEL_REQUESTED and (word not in GOAL_EVENTS or event.key not in self._started):
            raise ProtocolError("an invalid event of a goal")
        goal.events.append((self._now, word))

    def _goal_feedback(self, event: events.GoalFeedback) -> None:
        goal, bytes_ = self._served(event, "Feedback")
        self.engine.recorder.count(goal.server, len(bytes_))
        topic, type_ = f"{goal.action}/_action/feedback", f"{goal.type}_Feedback"
        goal.feedback.append(Message(self._now, topic, type_, goal.server, canonical(type_, bytes_)))

    def _goal_result(self, event: events.GoalResult) -> None:
        goal, bytes_ = self._served(event, "Result")
        goal.raw_result = canonical(f"{goal.type}_Result", bytes_)

    def _served(self, event: events.GoalFeedback | events.GoalResult, part: str) -> tuple[Goal, bytes]:
        goal = self._known(event.key, self._goals, "a goal")
        if event.key not in self._started:
            raise ProtocolError("a report on a goal that its server has not taken")
        return goal, valid_message(event.raw, message_class(f"{goal.type}_{part}"), f"a {part.lower()}")[1]

    def _goal_answered(self, event: events.GoalAnswered) -> None:
        self._known(event.key, self._goals, "a goal").answered = self._now

    def _goal_received(self, event: events.GoalReceived) -> None:
        self._known(event.key, self._goals, "a goal").received = self._now

    def _node(self, name: Any) -> str:
        return self._texts.name(name, "a node's name")

    def _follower_node(self, name: Any) -> str:
        """The name of a node of the follower, which can't report on nodes of the leader."""
        name = self._node(name)
        if name not in self.proxies.names:
            raise ProtocolError(f"a report on the node {name!r}, which it does not have")
        return name

    def _caller(self, name: Any, service: str, type_: str, raw: bytes) -> tuple[str, float | None, bool]:
        """The client that made a call, the time, and whether the client is the course's.

        A client of the leader is accepted only if it has made such a call. If two servers take one request,
        the recording has two calls. The client's name may be empty.
        """
        name = self._node(name)
        if not name or name in self.proxies.names:
            return name, self._now, False
        for it in reversed(self.recording.calls):
            if (it.client, it.service, it.type, it.raw_request) == (name, service, type_, raw):
                return name, it.requested, it.requested_by_course
        return self._follower_node(name), self._now, False

    def _fresh(self, key: Any, known: dict[int, Any]) -> int:
        if valid_int(key, "a key") % 2 == 0 or key in known:
            raise ProtocolError("a key that it may not choose")
        return key

    def _known(self, key: Any, known: dict[int, Any], what: str) -> Any:
        found = known.get(valid_int(key, "a key"))
        if found is None:
            raise ProtocolError(f"a report on {what} that does not exist")
        return found

    HANDLERS: ClassVar[dict[type, Callable[..., None]]] = ProcessLink.HANDLERS | {
        events.CallRequested: _call,
        events.CallStarted: _call_started,
        events.CallRaised: _call_raised,
        events.CallAnswered: _call_answered,
        events.CallReceived: _call_received,
        events.GoalRequested: _goal,
        events.GoalStarted: _goal_started,
        events.GoalEvent: _goal_event,
        events.GoalFeedback: _goal_feedback,
        events.GoalResult: _goal_result,
        events.GoalAnswered: _goal_answered,
        events.GoalReceived: _goal_received,
    }
