"""Delivers what the six systems receive, with delays: with a student's, and with others."""

from __future__ import annotations

import contextlib
import functools
import heapq
import itertools
import json
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.task import Future
from std_msgs.msg import Bool, Float64, Int32, String
from std_srvs.srv import Trigger

from grader.exercises.systems.audit.delays import TICK, Delays, delay_of, read_delays
from grader.exercises.systems.audit.scripts import PlayScript, draw_delays, script_of
from grader.exercises.systems.audit.six_systems import SYSTEMS, Labeler
from sim import Process

QUESTION, ANSWERS, GIVEN = "/audit/question", "/audit/answers", "given"
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
BEGIN, ASKS, LASTS, PLAYS = 150, 100, 200, 5  # ticks; the first play is with the student's delays
RESPONDS, DOORS, STAYS = 11, 33, 30  # ticks: after a call; after a call of a lift; in the dock
TYPES = {"path_sizes": Int32, "joystick": Float64, "close": Bool, "open_gate": Trigger, "call_lift": Trigger,
         "start_job": Trigger}  # fmt: skip


class Agenda:
    """Functions that are called at their ticks."""

    def __init__(self) -> None:
        self.now = 0
        self._due: list[tuple[int, int, Callable[[], Any]]] = []
        self._count = itertools.count()

    def at(self, tick: int, function: Callable[[], Any]) -> None:
        """Call a function at a tick."""
        heapq.heappush(self._due, (tick, next(self._count), function))

    def advance(self) -> None:
        """Call those of the next tick."""
        self.now += 1
        while self._due and self._due[0][0] <= self.now:
            heapq.heappop(self._due)[2]()


class SystemInputs:
    """The topics to one system and its service. prefix: of their names."""

    def __init__(self, node: Node, agenda: Agenda, name: str, prefix: str) -> None:
        self.agenda, self.name = agenda, name
        self.play(PlayScript([]), {})
        names = [each for each in SYSTEMS[name].delayed if TYPES.get(each) is not Trigger]
        self.publishers = {
            each: node.create_publisher(TYPES.get(each, String), f"{prefix}{each}", 20) for each in names
        }
        group = ReentrantCallbackGroup()
        for each in set(SYSTEMS[name].delayed) - {*names}:
            serve = functools.partial(self.serve, each)
            node.create_service(Trigger, f"{prefix}{each}", serve, callback_group=group)
        if name == "dock":
            self.publishers["departures"] = node.create_publisher(String, f"{prefix}departures", 20)
            node.create_subscription(String, f"{prefix}admitted", self.on_admitted, 20)

    def play(self, script: PlayScript, delays: Delays) -> None:
        """Begin a play: deliver what is in a script, with delays."""
        self.script, self.delays = script, delays
        self.numbers = dict.fromkeys(SYSTEMS[self.name].delayed, 0)
        self.last: dict[str, int] = {}
        for delivery in sorted(script.deliveries, key=lambda each: each.tick):
            self.deliver(delivery.topic, delivery.message, self.agenda.now + delivery.tick)

    def deliver(self, topic: str, message: Any, tick: int) -> None:
        """Publish a message at a tick or later; those of a topic stay in their order."""
        self.agenda.at(self.late(topic, tick), lambda: self.publishers[topic].publish(message))

    def late(self, name: str, tick: int, apart: int = 0) -> int:
        """Return when the next message of a topic or response of a service arrives.

        apart: the fewest ticks between two of them.
        """
        number = self.numbers.get(name, 0)
        self.numbers[name] = number + 1
        self.last[name] = max(tick + delay_of(self.delays, name, number), self.last.get(name, 0) + apart)
        return self.last[name]

    async def serve(self, name: str, request: Trigger.Request, response: Trigger.Response) -> Any:
        """Respond later."""
        done, called = Future(), self.agenda.now
        self.agenda.at(self.late(name, called + RESPONDS, apart=1), lambda: done.set_result(None))
        if name == "call_lift":
            lift, other = String(data=self.script.response), String(data=self.script.other)
            for message, ticks in ((other, DOORS - 10), (lift, DOORS), (other, DOORS + 2)):
                self.deliver("open_doors", message, called + ticks)
        response.success, response.message = True, self.script.response
        await done
        return response

    def on_admitted(self, msg: String) -> None:
        """Let the robot leave after a while."""
        leaves = functools.partial(self.publishers["departures"].publish, msg)
        self.agenda.at(self.agenda.now + STAYS, leaves)


class Deliveries(Node):
    """Delivers messages and responses to systems, play after play."""

    def __init__(self) -> None:
        super().__init__("deliveries")
        self.agenda = Agenda()
        self.create_timer(TICK, self.agenda.advance)


class OneSystem(Deliveries):
    """Delivers to one system what it receives in a play, which begins after 0.5 s."""

    def __init__(self, name: str, delays: Delays) -> None:
        super().__init__()
        inputs = SystemInputs(self, self.agenda, name, "")
        self.agenda.at(50, lambda: inputs.play(script_of(name, 0, 0), delays))


class Trials(Deliveries):
    """Tries the student's systems in five plays, and the given ones in the first, with a student's delays."""

    def __init__(self, seed: int) -> None:
        super().__init__()
        self.seed = seed
        self.answers: dict[str, Delays] = {}
        self.own = {name: SystemInputs(self, self.agenda, name, "") for name in SYSTEMS}
        self.given = {name: SystemInputs(self, self.agenda, name, f"{GIVEN}/") for name in SYSTEMS}
        self.question = self.create_publisher(Int32, QUESTION, LATCHED)
        self.create_subscription(String, ANSWERS, self.on_answers, LATCHED)
        self.agenda.at(ASKS, lambda: self.question.publish(Int32(data=question_of(seed))))
        for number in range(PLAYS):
            self.agenda.at(BEGIN + LASTS * number, functools.partial(self.begin, number))

    def on_answers(self, msg: String) -> None:
        """Store the delays for each system."""
        for name, answer in read_answers(msg.data, question_of(self.seed)).items():
            with contextlib.suppress(ValueError):
                self.answers.setdefault(name, read_delays(name, answer.get("delays")))

    def begin(self, number: int) -> None:
        """Begin a play of all systems."""
        for name in SYSTEMS:
            script, drawn = script_of(name, number, self.seed), draw_delays(name, number, self.seed)
            delays = drawn if number else self.answers.get(name, {})
            self.own[name].play(script, delays)
            if number == 0 and name in self.answers:
                self.given[name].play(script, delays)


def question_of(seed: int) -> int:
    """Return the number that the answers have to repeat, so that they belong to this run."""
    return 1 + seed % 999_983


def read_answers(text: str, question: int) -> dict[str, dict[str, Any]]:
    """Return the answer for each system that has one; {} for None."""
    try:
        found = json.loads(text)
        answers = found["answers"] if found["question"] == question else {}
        return {name: answers[name] or {} for name in SYSTEMS if isinstance(answers.get(name), dict | None)
                and name in answers}  # fmt: skip
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        return {}


def deliveries(name: str, delays: Mapping[str, Any] | None = None) -> Sequence[Any]:
    """Return the companions that deliver to one of the six systems what it receives, with delays.

    Raises ValueError for a name or delays that can't be.
    """
    if name not in SYSTEMS:
        raise ValueError(f"There is no system {name!r}, only {', '.join(SYSTEMS)}.")
    try:
        return [functools.partial(OneSystem, name, read_delays(name, delays) if delays else {})]
    except ValueError as error:
        raise ValueError(f"The delays have {error}.") from None


class TolerantLabeler(Labeler):
    """The given one, which leaves out what another program publishes on its topics."""

    def store(self, kind: str, *words: str) -> None:
        """Store what has the right form."""
        if len(words) == 2:
            super().store(kind, *words)


def trials(seed: int) -> Sequence[Any]:
    """Return the companions that try all systems, first with the student's delays, then with others.

    The given systems are among them, in the namespace /given.
    """
    given = {name: parts.node for name, parts in SYSTEMS.items()} | {"labeler": TolerantLabeler}
    return [functools.partial(Trials, seed), *(Process(node, namespace=GIVEN) for node in given.values())]
