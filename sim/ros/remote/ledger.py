"""The side that is believed: it writes down what comes from the other one, checked and stamped by its clock.

A message, a request or a goal is what came over the wire, when it came. What the nodes say of themselves (log
lines, exceptions, callbacks and the like) are claims: they are looked at, cut to size and counted.
"""

from __future__ import annotations

import math
from time import monotonic
from typing import TYPE_CHECKING, Any, ClassVar

from unique_identifier_msgs.msg import UUID

from sim.exchanges import CANCEL_REJECTED, CANCEL_REQUESTED, REJECTED, STATUSES, Call, Goal
from sim.recording import CallbackError, CallbackRun, Heard, LogLine, TimerInfo
from sim.ros.cdr import canonical
from sim.ros.codec import message_class, type_name
from sim.ros.fibers import SECOND
from sim.ros.recorder import LEVELS, MAX_LOG_LINES
from sim.ros.remote.checked import MOST_NAME, Nonsense, Texts, interface, message, number, rows, text, whole
from sim.ros.remote.link import Event, Link
from sim.ros.remote.parts import PuppetClient, PuppetNode, PuppetPublisher

if TYPE_CHECKING:
    from sim.ros.engine import Engine

MOST_CLAIMS = 100_000  # of a kind, in one message
ALL_CLAIMS = 2_000_000  # in a run
MOST_PERIOD = 1e9  # s, of a timer
GOAL_WORDS = (*STATUSES, REJECTED, CANCEL_REJECTED)
KINDS = ("timer", "subscription", "service", "client", "action", "event", "guard condition", "task")


class Ledger(Link):
    """The side that writes the recording."""

    def __init__(self, engine: Engine) -> None:
        super().__init__(engine, keys=0)
        self.until = math.inf  # by the clock `monotonic`: when what came has to be entered
        self.errors: list[CallbackError] = []  # those that the other side told of
        self._calls: dict[int, Call] = {}  # by key; of these the other side tells what becomes of them
        self._sent: dict[int, tuple[PuppetClient, int]] = {}  # requests of the other side, by key
        self._goals: dict[int, Goal] = {}
        self._taken: set[int] = set()  # keys of goals that a server of the other side has taken
        self._claims, self._texts = 0, Texts()

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

    def published(self, publisher: PuppetPublisher, raw: bytes) -> None:
        """Write a message down."""
        self.engine.published(publisher.name, type_name(publisher.type), publisher.node.name, raw)

    def tell_request(self, event: Event, call: Call | None) -> None:
        """Add a request to the news, and remember its call: the other side tells what becomes of it."""
        super().tell_request(event, call)
        if call is not None:
            self._calls[event[1]] = call

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

    def _call(self, key: Any, service: Any, type_: Any, client: Any, asked: Any, raw: Any, lost: Any) -> None:
        cls = interface(text(type_, "a type", MOST_NAME), "srv")
        _, bytes_ = message(raw, cls.Request, "a request")
        service = text(service, "a service", MOST_NAME)
        type_ = type_name(cls)
        self.engine.recorder.count(text(client, "a node's name", MOST_NAME), len(bytes_))
        bytes_ = canonical(f"{type_}_Request", bytes_)
        client, stamp = self._caller(client, service, type_, bytes_)
        call = Call(service, type_, client, bytes_, stamp if asked else None, lost=bool(lost))
        self._calls[self._fresh(key, self._calls)] = call
        self.recording.calls.append(call)

    def _call_taken(self, key: Any, server: Any) -> None:
        call = self._known(key, self._calls, "a call")
        call.server, call.taken = self._theirs(server), self._now

    def _call_raised(self, key: Any, error: Any) -> None:
        self._known(key, self._calls, "a call").raised = text(error, "an error", MOST_NAME)

    def _call_response(self, key: Any, raw: Any) -> None:
        call = self._known(key, self._calls, "a call")
        if key in self._answering:
            raise Nonsense("a response that came to nobody")
        _, bytes_ = message(raw, message_class(f"{call.type}_Response"), "a response")
        self.engine.recorder.calls.answered(call, bytes_)

    def _call_received(self, key: Any) -> None:
        if whole(key, "a key") in self._sent:
            client, asked = self._sent.pop(key)
            self.engine.recorder.calls.received(client, asked)
        else:
            self._known(key, self._calls, "a call").received = self._now

    # -- goals ---------------------------------------------------------------------------------------

    def _goal(self, key: Any, action: Any, type_: Any, client: Any, id_: Any, raw: Any, lost: Any) -> None:
        key, cls = self._fresh(key, self._goals), interface(text(type_, "a type", MOST_NAME), "action")
        action, goals = text(action, "an action", MOST_NAME), self.engine.recorder.goals
        try:
            goal_id = UUID(uuid=list(bytes.fromhex(text(id_, "an id", 32))))
        except (ValueError, AssertionError):
            raise Nonsense("a goal's id that is none") from None
        _, bytes_ = message(raw, cls.Goal, "a goal")
        if not client:  # one of this side's, which a server of the other side has taken
            waiting = [goal for goal in goals.known(action, goal_id) if not goal.server and not goal.lost]
            if not waiting:
                raise Nonsense("a goal that nobody has sent")
            self._goals[key] = waiting[0]
            return
        end = self.puppets.action(self._node(client), action, type_name(cls))
        if end is None:
            raise Nonsense(f"a goal of {action!r}, of which {client!r} has no client")
        goal = self._goals[key] = goals.new(end, client, goal_id, bytes_, self._now)
        goal.lost = bool(lost)

    def _goal_taken(self, key: Any, server: Any) -> None:
        goal = self._known(key, self._goals, "a goal")
        if goal.server:
            raise Nonsense("a goal that another server has taken")
        goal.server = self._theirs(server)
        self._taken.add(key)

    def _goal_event(self, key: Any, word: Any) -> None:
        goal = self._known(key, self._goals, "a goal")
        if word != CANCEL_REQUESTED and (word not in GOAL_WORDS or key not in self._taken):
            raise Nonsense("a goal's event that can't be")
        goal.events.append((self._now, word))

    def _goal_feedback(self, key: Any, raw: Any) -> None:
        goal, bytes_ = self._served(key, raw, "Feedback")
        self.engine.recorder.count(goal.server, len(bytes_))
        topic, type_ = f"{goal.action}/_action/feedback", f"{goal.type}_Feedback"
        goal.feedback.append(Heard(self._now, topic, type_, goal.server, canonical(type_, bytes_)))

    def _goal_result(self, key: Any, raw: Any) -> None:
        goal, bytes_ = self._served(key, raw, "Result")
        goal.raw_result = canonical(f"{goal.type}_Result", bytes_)

    def _served(self, key: Any, raw: Any, part: str) -> tuple[Goal, bytes]:
        goal = self._known(key, self._goals, "a goal")
        if key not in self._taken:
            raise Nonsense("news of a goal that its server did not take")
        return goal, message(raw, message_class(f"{goal.type}_{part}"), f"a {part.lower()}")[1]

    def _goal_answered(self, key: Any) -> None:
        self._known(key, self._goals, "a goal").answered = self._now

    def _goal_received(self, key: Any) -> None:
        self._known(key, self._goals, "a goal").received = self._now

    # -- claims --------------------------------------------------------------------------------------

    def believe(self, claims: dict[str, Any]) -> None:
        """Write down what the nodes say of themselves. Raises Nonsense for what can't be."""
        recording, now = self.recording, self._now
        for (name,) in self._claimed(claims, "nodes", 0):
            recording.graph.nodes.append(self._node(name))
        for node, period, callback in self._claimed(claims, "timers", 3):
            seconds = number(period, "a timer's period", 0, MOST_PERIOD)
            recording.graph.timers.append(TimerInfo(self._node(node), seconds, self._name(callback)))
        for level, logger, line in self._claimed(claims, "logs", 3):
            if level not in LEVELS.values():
                raise Nonsense("a log line of no known level")
            logger, line = self._name(logger), self._texts.take(line, "a log line")
            if len(recording.logs) < MAX_LOG_LINES:
                recording.logs.append(LogLine(now, level, logger, line))
        for (line,) in self._claimed(claims, "prints", 0):
            self.engine.recorder.printed(self._texts.take(line, "a print"))
        for row in self._claimed(claims, "errors", 5):
            error = CallbackError(now, *(self._texts.take(part, "an error") for part in row))
            recording.errors.append(error)
            self.errors.append(error)
        for began, lasted, node, callback, kind in self._claimed(claims, "callbacks", 5):
            if kind not in KINDS:
                raise Nonsense("a callback of no known kind")
            begin = number(began, "the beginning of a callback", 0, now)
            length = number(lasted, "a callback's duration", 0, now - begin + 1 / SECOND)
            names = self._name(node), self._name(callback), kind
            recording.callbacks.append(CallbackRun(begin, length, *names))

    def _claimed(self, claims: dict[str, Any], name: str, width: int) -> list[Any]:
        """Claims of a kind; with no width, each is one thing and not a list."""
        if name not in claims:
            return []
        found = rows(claims[name], name, MOST_CLAIMS, width)
        self._claims += len(found)
        if self._claims > ALL_CLAIMS:
            raise Nonsense(f"more than {ALL_CLAIMS} log lines, callbacks and the like")
        return found if width else [(item,) for item in found]

    def _node(self, name: Any) -> str:
        return self._texts.take(name, "a node's name", MOST_NAME)

    def _theirs(self, name: Any) -> str:
        """The name of a node of the other side: for ours it can't speak."""
        name = self._node(name)
        if name not in self.puppets.names:
            raise Nonsense(f"news of the node {name!r}, which it does not have")
        return name

    def _caller(self, name: Any, service: str, type_: str, raw: bytes) -> tuple[str, float | None]:
        """Who made a call, and when: a node of the other side, nobody that is known, or one of ours.

        One of ours has to have made it: where two servers took that, there are two calls.
        """
        name = self._node(name)
        if not name or name in self.puppets.names:
            return name, self._now
        for it in reversed(self.recording.calls):
            if (it.client, it.service, it.type, it.raw_request) == (name, service, type_, raw):
                return name, it.asked
        return self._theirs(name), self._now

    def _name(self, name: Any) -> str:
        return self._texts.take(name, "a name", MOST_NAME)

    def _fresh(self, key: Any, known: dict[int, Any]) -> int:
        if whole(key, "a key") % 2 == 0 or key in known:
            raise Nonsense("a key that it may not choose")
        return key

    def _known(self, key: Any, known: dict[int, Any], what: str) -> Any:
        found = known.get(whole(key, "a key"))
        if found is None:
            raise Nonsense(f"news of {what} that there is not")
        return found

    EVENTS: ClassVar[dict[str, tuple[Any, int]]] = Link.EVENTS | {
        "call": (_call, 8),
        "taken": (_call_taken, 3),
        "raised": (_call_raised, 3),
        "response": (_call_response, 3),
        "received": (_call_received, 2),
        "goal": (_goal, 8),
        "goal taken": (_goal_taken, 3),
        "goal event": (_goal_event, 3),
        "goal feedback": (_goal_feedback, 3),
        "goal result": (_goal_result, 3),
        "goal answered": (_goal_answered, 2),
        "goal received": (_goal_received, 2),
    }
