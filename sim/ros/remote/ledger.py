"""The side that is believed: it writes down what comes from the other one, checked and stamped by its clock.

A message, a request or a goal is what came over the wire, when it came; the rest are claims.
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
from sim.ros.remote.checked import MOST_NAME, Nonsense, Texts, interface, message, text, whole
from sim.ros.remote.claims import Claims
from sim.ros.remote.link import Link
from sim.ros.remote.parts import PuppetClient, PuppetNode, PuppetPublisher

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine

GOAL_WORDS = (*STATUSES, REJECTED, CANCEL_REJECTED)


class Ledger(Link):
    """The side that writes the recording."""

    def __init__(self, engine: Engine) -> None:
        super().__init__(engine, keys=0)
        self.until = math.inf  # by the clock `monotonic`: when what came has to be entered
        self._calls: dict[int, Call] = {}  # by key; of these the other side tells what becomes of them
        self._sent: dict[int, tuple[PuppetClient, int]] = {}  # requests of the other side, by key
        self._goals: dict[int, Goal] = {}
        self._taken: set[int] = set()  # keys of goals that a server of the other side has taken
        self._texts = Texts()
        self.claims = Claims(engine, self._texts)

    @property
    def _now(self) -> float:
        return self.engine.recorder.now

    def hurry(self) -> None:
        """One event may wake thousands of subscriptions. Raises Nonsense when the time is over."""
        if monotonic() > self.until:
            raise Nonsense("more than can be looked at in the time that is left")

    # -- what crosses ------------------------------------------------------------------------------

    def declared(self, kind: str, node: PuppetNode, name: str, type_: type, profile: Any) -> None:
        """Write an end into the graph."""
        self.engine.recorder.endpoint(kind, node, name, type_, profile)

    def publish(self, publisher: PuppetPublisher, raw: bytes) -> None:
        """Send it, and write it down."""
        publisher.writer.publish(raw)

    def tell_request(self, event: events.Ask, call: Call | None) -> None:
        """Add a request to the news, and remember its call: the other side tells what becomes of it."""
        super().tell_request(event, call)
        if call is not None:
            self._calls[event.key] = call

    def has_asked(self, key: int, client: PuppetClient, number: int) -> None:
        """A call of the other side is under way to a service of this one."""
        self._sent[key] = client, number

    def answered(self, key: int, service: Any, response: Any, raw: bytes) -> Any:
        """Write a response down, then give it to the client."""
        call = self._calls.pop(key, None)
        if call is not None:
            self.engine.recorder.calls.answered(call, raw)
        return super().answered(key, service, response, raw)

    # -- calls that never leave the other side, and what becomes of calls ---------------------------

    def _call(self, event: events.CallMade) -> None:
        cls = interface(text(event.type, "a type", MOST_NAME), "srv")
        _, raw = message(event.raw, cls.Request, "a request")
        service, type_ = text(event.service, "a service", MOST_NAME), type_name(cls)
        self.engine.recorder.count(text(event.client, "a node's name", MOST_NAME), len(raw))
        raw = canonical(f"{type_}_Request", raw)
        client, stamp, from_course = self._caller(event.client, service, type_, raw)
        asked = stamp if event.asked else None
        call = Call(
            service, type_, client, raw, asked, lost=bool(event.lost), requested_by_course=from_course
        )
        self._calls[self._fresh(event.key, self._calls)] = call
        self.recording.calls.append(call)

    def _call_taken(self, event: events.CallTaken) -> None:
        call = self._known(event.key, self._calls, "a call")
        call.server, call.taken = self._theirs(event.server), self._now

    def _call_raised(self, event: events.CallRaised) -> None:
        self._known(event.key, self._calls, "a call").raised = text(event.error, "an error", MOST_NAME)

    def _call_answered(self, event: events.CallAnswered) -> None:
        call = self._known(event.key, self._calls, "a call")
        if event.key in self._answering:
            raise Nonsense("a response that came to nobody")
        _, bytes_ = message(event.raw, message_class(f"{call.type}_Response"), "a response")
        self.engine.recorder.calls.answered(call, bytes_)

    def _call_received(self, event: events.CallReceived) -> None:
        if whole(event.key, "a key") in self._sent:
            client, asked = self._sent.pop(event.key)
            self.engine.recorder.calls.received(client, asked)
        else:
            self._known(event.key, self._calls, "a call").received = self._now

    # -- goals ---------------------------------------------------------------------------------------

    def _goal(self, event: events.GoalMade) -> None:
        key, goals = self._fresh(event.key, self._goals), self.engine.recorder.goals
        cls = interface(text(event.type, "a type", MOST_NAME), "action")
        action = text(event.action, "an action", MOST_NAME)
        try:
            goal_id = UUID(uuid=list(bytes.fromhex(text(event.id, "an id", 32))))
        except (ValueError, AssertionError):
            raise Nonsense("a goal's id that is none") from None
        _, bytes_ = message(event.raw, cls.Goal, "a goal")
        if not event.client:  # one of this side's, which a server of the other side has taken
            waiting = [goal for goal in goals.known(action, goal_id) if not goal.server and not goal.lost]
            if not waiting:
                raise Nonsense("a goal that nobody has sent")
            self._goals[key] = waiting[0]
            return
        client = self._node(event.client)
        end = self.puppets.action(client, action, type_name(cls))
        if end is None:
            raise Nonsense(f"a goal of {action!r}, of which {client!r} has no client")
        goal = self._goals[key] = goals.new(end, client, goal_id, bytes_, self._now)
        goal.lost = bool(event.lost)

    def _goal_taken(self, event: events.GoalTaken) -> None:
        goal = self._known(event.key, self._goals, "a goal")
        if goal.server:
            raise Nonsense("a goal that another server has taken")
        goal.server = self._theirs(event.server)
        self._taken.add(event.key)

    def _goal_event(self, event: events.GoalEvent) -> None:
        goal, word = self._known(event.key, self._goals, "a goal"), event.word
        if word != CANCEL_REQUESTED and (word not in GOAL_WORDS or event.key not in self._taken):
            raise Nonsense("a goal's event that can't be")
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
        if event.key not in self._taken:
            raise Nonsense("news of a goal that its server did not take")
        return goal, message(event.raw, message_class(f"{goal.type}_{part}"), f"a {part.lower()}")[1]

    def _goal_answered(self, event: events.GoalAnswered) -> None:
        self._known(event.key, self._goals, "a goal").answered = self._now

    def _goal_received(self, event: events.GoalReceived) -> None:
        self._known(event.key, self._goals, "a goal").received = self._now

    def _node(self, name: Any) -> str:
        return self._texts.name(name, "a node's name")

    def _theirs(self, name: Any) -> str:
        """The name of a node of the other side: for ours it can't speak."""
        name = self._node(name)
        if name not in self.puppets.names:
            raise Nonsense(f"news of the node {name!r}, which it does not have")
        return name

    def _caller(self, name: Any, service: str, type_: str, raw: bytes) -> tuple[str, float | None, bool]:
        """Who made a call, when, and whether it was one of ours: else a node of the other side, or nobody.

        One of ours has to have made it: where two servers took that, there are two calls.
        """
        name = self._node(name)
        if not name or name in self.puppets.names:
            return name, self._now, False
        for it in reversed(self.recording.calls):
            if (it.client, it.service, it.type, it.raw_request) == (name, service, type_, raw):
                return name, it.requested, it.requested_by_course
        return self._theirs(name), self._now, False

    def _fresh(self, key: Any, known: dict[int, Any]) -> int:
        if whole(key, "a key") % 2 == 0 or key in known:
            raise Nonsense("a key that it may not choose")
        return key

    def _known(self, key: Any, known: dict[int, Any], what: str) -> Any:
        found = known.get(whole(key, "a key"))
        if found is None:
            raise Nonsense(f"news of {what} that there is not")
        return found

    HANDLERS: ClassVar[dict[type, Callable[..., None]]] = Link.HANDLERS | {
        events.CallMade: _call,
        events.CallTaken: _call_taken,
        events.CallRaised: _call_raised,
        events.CallAnswered: _call_answered,
        events.CallReceived: _call_received,
        events.GoalMade: _goal,
        events.GoalTaken: _goal_taken,
        events.GoalEvent: _goal_event,
        events.GoalFeedback: _goal_feedback,
        events.GoalResult: _goal_result,
        events.GoalAnswered: _goal_answered,
        events.GoalReceived: _goal_received,
    }
