"""Records the goals of actions: sent, accepted, executed, canceled; feedback and results."""

from __future__ import annotations

import weakref
from collections import defaultdict
from typing import Any

from action_msgs.msg import GoalStatus

from sim.evidence import CANCEL_REJECTED, CANCEL_REQUESTED, ENDINGS, REJECTED, Goal, Message
from sim.ros.messages.cdr import canonical
from sim.ros.messages.codec import encode, type_name
from sim.ros.recorder.base import RecorderBase
from sim.ros.recorder.calls import alive
from sim.ros.recorder.records import ACTION, ActionRecord

WORDS = {
    value: name.removeprefix("STATUS_").lower()
    for name, value in vars(GoalStatus).items()
    if name.startswith("STATUS_")
}

BEYOND_CANCEL = ("canceling", *ENDINGS)  # statuses in which rclpy refuses to cancel, and calls no callback


def key(goal_id: Any) -> bytes:
    """The bytes of a goal's UUID message."""
    return bytes(goal_id.uuid)


class Goals:
    """The goals of one run, by their ids."""

    def __init__(self, recorder: RecorderBase) -> None:
        self._recorder = recorder
        self._by_id: dict[tuple[str, bytes], list[Goal]] = {}
        self._ends: list[weakref.ref[Any]] = []  # of all actions
        self._servers: dict[str, list[weakref.ref[Any]]] = defaultdict(list)

    def endpoint_created(self, end: Any, node: Any, name: str, type_: type, *, serves: bool) -> None:
        """A node created an action server or an action client; `name` is the action's resolved name."""
        self._ends.append(weakref.ref(end))
        if serves:
            self._servers[name].append(weakref.ref(end))
        recorder = self._recorder
        fields = {"action": name, "type": type_name(type_), "node": recorder.name_of(node)}
        ACTION.attach(end, ActionRecord(*recorder.creator(), **fields))

    def endpoints(self) -> list[Any]:
        """The action servers and clients that exist."""
        return [endpoint for known in self._ends if (endpoint := known()) is not None]

    def with_id(self, action: str, goal_id: Any) -> list[Goal]:
        """Goals of this id, oldest first: more than one if an id is used again, or two servers take it."""
        return self._by_id.setdefault((action, key(goal_id)), [])

    def _known(self, end: Any, goal_id: Any) -> list[Goal]:
        return self.with_id(ACTION.of(end).action, goal_id)

    def _event(self, goal: Goal | None, word: str) -> None:
        if goal is not None and self._recorder.open:
            goal.events.append((self._recorder.now, word))

    def add(self, end: Any, client: str, goal_id: Any, raw: bytes, requested: float | None) -> Goal:
        """Begin to record a goal; `end` is its client, or a server that took what no client here sent."""
        record = ACTION.of(end)
        self._recorder.count(record.node, len(raw))
        raw = canonical(f"{record.type}_Goal", raw)
        goal = Goal(record.action, record.type, client, key(goal_id).hex(), raw, requested)
        self._recorder.recording.goals.append(goal)
        self._known(end, goal_id).append(goal)
        return goal

    # -- what clients do ---------------------------------------------------------------------------

    def goal_sent(self, client: Any, number: int, goal_id: Any, raw: bytes) -> None:
        """A client sent a goal; one of a number below 0 gets lost."""
        if self._recorder.open:
            record = ACTION.of(client)
            goal = self.add(client, record.node, goal_id, raw, self._recorder.now)
            record.goals[number], goal.requested_by_course = goal, record.from_course
            goal.lost = number < 0 or not self._there(goal.action)

    def _there(self, action: str) -> list[Any]:
        made = (known() for known in self._servers[action])
        return [server for server in made if server is not None and alive(server._handle)]

    def discovered(self, client: Any) -> bool:
        """Return whether a goal of a client would reach a server, if there is one."""
        record = ACTION.of(client)
        there = [ACTION.of(server) for server in self._there(record.action)]
        return record.reaches(there, self._recorder.scheduler.now)

    def client_of(self, action: str, goal_id: Any) -> str:
        """The node that sent a goal; "" for one that no ActionClient sent."""
        known = self.with_id(action, goal_id)
        return known[0].client if known else ""

    def server_of(self, action: str) -> str:
        """The node that takes goals of this action; "" if none does."""
        servers = (known() for known in self._servers[action])
        return next((ACTION.of(server).node for server in servers if server is not None), "")

    def cancel_sent(self, client: Any, goal_id: Any) -> None:
        """A client requested the cancellation of a goal."""
        for goal in self._known(client, goal_id):
            if goal.status != REJECTED:
                self._event(goal, CANCEL_REQUESTED)

    def client_took(self, client: Any, data: dict[str, Any]) -> None:
        """A client took this from its queues, as rclpy's take_data() returns it."""
        if not self._recorder.open:
            return
        goal = ACTION.of(client).goals.pop(data["goal"][0], None) if "goal" in data else None
        if goal is not None:
            goal.answered = self._recorder.now
        number = data["result"][0] if "result" in data else None
        goal_id = client._result_sequence_number_to_goal_id.get(number)
        waiting = self._known(client, goal_id) if goal_id is not None else []
        goal = next((goal for goal in waiting if goal.raw_result is not None), None)
        if goal is not None and goal.received is None:
            goal.received = self._recorder.now

    # -- what servers do ---------------------------------------------------------------------------

    def goal_taken(self, server: Any, goal_id: Any, request: Any) -> Goal | None:
        """A server took the request for a goal; returns the goal, or None after the end of the run."""
        if not self._recorder.open:
            return None
        known = self._known(server, goal_id)
        goal = next((goal for goal in known if not goal.server and not goal.lost), None)
        if goal is None:  # another server has it too, or no ActionClient sent it
            client, requested = (known[0].client, known[0].requested) if known else ("", None)
            goal = self.add(server, client, goal_id, encode(request), requested)
            goal.requested_by_course = known[0].requested_by_course
        record = ACTION.of(server)
        goal.server, goal.served_by_course = record.node, record.from_course
        if key(goal_id) not in server._goal_handles:  # rclpy refuses an id that it knows already
            record.goals[key(goal_id)] = goal
        return goal

    def goal_handled(self, goal: Goal | None) -> None:
        """A server has handled the request for a goal; an accepted one is recorded already."""
        if goal is not None and not goal.status:
            self._event(goal, REJECTED)

    def goal_accepted(self, server: Any, goal_id: Any) -> None:
        """A server accepted a goal."""
        self._event(ACTION.of(server).goals.get(key(goal_id)), "accepted")

    def status_changed(self, server: Any, goal_id: Any, status: int) -> None:
        """A goal has another status: a number of action_msgs/msg/GoalStatus."""
        self._event(ACTION.of(server).goals.get(key(goal_id)), WORDS[status])

    def cancel_taken(self, server: Any, goal_id: Any) -> tuple[Goal | None, str]:
        """A server took the request to cancel a goal; returns the goal and its status."""
        goal = ACTION.of(server).goals.get(key(goal_id))
        return goal, goal.status if goal is not None else ""

    def cancel_handled(self, goal: Goal | None, before: str) -> None:
        """A server has handled the request to cancel a goal that had this status before."""
        if goal is not None and (before in BEYOND_CANCEL or goal.at("canceling") is None):
            self._event(goal, CANCEL_REJECTED)

    def feedback_published(self, server: Any, goal_id: Any, message: Any) -> None:
        """A server published feedback on a goal."""
        goal, recorder = ACTION.of(server).goals.get(key(goal_id)), self._recorder
        if goal is not None and recorder.open:
            raw, type_ = encode(message), f"{goal.type}_Feedback"
            recorder.count(goal.server, len(raw))
            topic = f"{goal.action}/_action/feedback"
            raw = canonical(type_, raw)
            goal.feedback.append(Message(recorder.now, topic, type_, goal.server, raw, goal.served_by_course))

    def result_ready(self, server: Any, goal_id: Any, message: Any) -> None:
        """A server has the result of a goal, which clients can get."""
        goal = ACTION.of(server).goals.get(key(goal_id))
        if goal is not None and self._recorder.open:
            goal.raw_result = canonical(f"{goal.type}_Result", encode(message))
