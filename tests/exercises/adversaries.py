"""Nodes that know an exercise's card and none of its answers: what it takes, gives and says in a public run.

The card is drawn from the recording of a right node, so there is one for every exercise, also for those to
come. Each adversary tries one way to get points without doing the work, in a private world.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator
from typing import Any

from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.node import Node

from sim.evidence import Endpoint, LogLine, since_start
from sim.ros.messages.codec import encode, message_class, type_name
from tests.exercises.cards import Card, log, profile
from tests.exercises.changed_recordings import FLOATS, leaves, put

TICK = 0.1  # seconds
NUMBERS = range(-180, 181)
LEVELS = "DEBUG", "INFO", "WARN", "ERROR"


class Stub(Node):
    """Has all ends that the right node has; and there is nothing behind them."""

    def __init__(self, card: Card) -> None:
        space, _, name = card.name.rpartition("/")
        super().__init__(name, namespace=space or None)
        self.card = card
        self.outlets = {
            name: self.create_publisher(message_class(end.type), name, profile(end))
            for name, end in card.ends("publisher").items()
        }
        for name, end in card.ends("subscription").items():
            self.create_subscription(message_class(end.type), name, lambda msg: None, profile(end))
        for name, end in card.ends("service").items():
            self.create_service(message_class(end.type), name, self.serve)
        self.servers = [self.offer(end) for end in card.ends("action server").values()]
        self.asking = {
            name: self.create_client(message_class(end.type), name)
            for name, end in card.ends("client").items()
        }
        self.sending = {
            name: ActionClient(self, message_class(end.type), name)
            for name, end in card.ends("action client").items()
        }
        self.begin()

    def begin(self) -> None:
        """Whatever an adversary does more."""

    def offer(self, end: Endpoint) -> ActionServer:
        """Take every goal, agree to every cancel, and succeed at once with an empty result."""
        type_ = message_class(end.type)

        def execute(handle: Any) -> Any:
            handle.succeed()
            return self.result_of(end.name, handle.request) or type_.Result()

        agree = CancelResponse.ACCEPT
        return ActionServer(self, type_, end.name, execute, cancel_callback=lambda handle: agree)

    def serve(self, request: Any, response: Any) -> Any:
        """An empty answer."""
        return response

    def result_of(self, action: str, goal: Any) -> Any:
        """The result for a goal; None for an empty one."""


class Replays(Stub):
    """Does and says all that was published and logged in the public run, when it was."""

    from_course: tuple[bool, ...] = (False,)  # whose messages

    def begin(self) -> None:
        self.outlets |= {
            name: self.create_publisher(message_class(end.type), name, profile(end))
            for name, end in self.card.ends("publisher", from_course=True).items()
            if True in self.from_course
        }
        rows = [row for whose in self.from_course for row in self.card.published(from_course=whose)]
        self.rows = sorted([*rows, *self.card.lines], key=lambda row: row.stamp)[::-1]
        self.create_timer(0.01, self.replay)

    def replay(self) -> None:
        now = since_start(self.get_clock().now().to_msg())
        while self.rows and self.rows[-1].stamp <= now + 1e-6:
            row = self.rows.pop()
            if isinstance(row, LogLine):
                log(self, row.level, row.text)
            elif row.topic in self.outlets:
                self.outlets[row.topic].publish(row.raw)


class Stages(Replays):
    """As Replays; and stages the world of the public run, the robot's topics and the companions'."""

    from_course = (False, True)


class SendsNan(Replays):
    """As Replays; and each decimal number that it publishes or responds with is not a number."""

    def begin(self) -> None:
        super().begin()
        self.rows = [
            row if isinstance(row, LogLine) else row._replace(raw=encode(_with_nan(row.message)))
            for row in self.rows
        ]

    def serve(self, request: Any, response: Any) -> Any:
        return _with_nan(response)

    def result_of(self, action: str, goal: Any) -> Any:
        return _with_nan(message_class(self.card.ends("action server")[action].type).Result())


def _with_nan(message: Any) -> Any:
    """The message with NaN in each field for a decimal number."""
    for path, kind in leaves(type_name(type(message))):
        if kind in FLOATS:
            put(message, path, math.nan)
    return message


class Freezes(Stub):
    """Holds the world still on the course's topics, and answers what was right at first, all the time."""

    def begin(self) -> None:
        ends = self.card.ends("publisher", from_course=True)
        self.frozen = {
            name: self.create_publisher(message_class(end.type), name, profile(end))
            for name, end in ends.items()
        }
        self.empty = {name: encode(message_class(end.type)()) for name, end in ends.items()}
        self.first: dict[str, bytes] = {}
        for published in reversed(self.card.published(from_course=False)):
            self.first[published.topic] = published.raw
        self.create_timer(0.02, self.hold)

    def hold(self) -> None:
        for name, publisher in self.frozen.items():
            publisher.publish(self.empty[name])
        for name, raw in self.first.items():
            self.outlets[name].publish(raw)


class SaysEverything(Stub):
    """Logs all words and numbers and all lines of the public run, and publishes all values, all the time.

    It agrees to each request, and each text of its responses and results has all words and numbers, too.
    """

    def begin(self) -> None:
        lines = list(dict.fromkeys((line.level, line.text) for line in self.card.lines))[:40]
        numbers = [*map(str, NUMBERS), *(f"{0.001 * number:.3f}" for number in range(-200, 201))]
        self.words = " ".join([*dict.fromkeys(text for _, text in lines), *numbers])
        self.lines = [*lines, *((level, self.words) for level in LEVELS)]
        self.values = [(name, raw) for name, end in self.card.ends("publisher").items()
                       for raw in self.all_values(name, end)]  # fmt: skip
        self.create_timer(0.25, self.say)

    def serve(self, request: Any, response: Any) -> Any:
        return self.with_all_words(response)

    def result_of(self, action: str, goal: Any) -> Any:
        return self.with_all_words(message_class(self.card.ends("action server")[action].type).Result())

    def with_all_words(self, message: Any) -> Any:
        for field, kind in message.get_fields_and_field_types().items():
            if kind in ("boolean", "string"):
                setattr(message, field, True if kind == "boolean" else self.words)
        return message

    def all_values(self, topic: str, end: Endpoint) -> Iterator[bytes]:
        reported = [row.raw for row in self.card.published(from_course=False) if row.topic == topic]
        yield from list(dict.fromkeys(reported))[:: max(1, len(reported) // 30)]
        fields = message_class(end.type).get_fields_and_field_types()
        if list(fields) == ["data"] and fields["data"] in ("double", "float"):
            for number in NUMBERS:
                yield encode(message_class(end.type)(data=float(number)))

    def say(self) -> None:
        for level, text in self.lines:
            log(self, level, text)
        for topic, raw in self.values:
            self.outlets[topic].publish(raw)


class Constant(Stub):
    """Publishes one value on each topic that is wanted, ten times a second: one of the middle of the run."""

    def begin(self) -> None:
        self.value: dict[str, bytes] = {}
        for topic in self.outlets:
            reported = [row.raw for row in self.card.published(from_course=False) if row.topic == topic]
            if reported:
                self.value[topic] = reported[len(reported) // 2]
        self.create_timer(TICK, self.say)

    def say(self) -> None:
        for topic, raw in self.value.items():
            self.outlets[topic].publish(raw)


class Guesses(Stub):
    """Says and answers any of what was right somewhere in the public run, drawn by lot."""

    def begin(self) -> None:
        self.lot = random.Random(1)
        run, published = self.card.run, self.card.published(from_course=False)
        self.values = {name: [each.raw for each in published if each.topic == name] for name in self.outlets}
        self.answers = [call.response for call in run.calls if call.raw_response]
        self.results = [(goal.action, goal.result) for goal in run.goals if goal.raw_result]
        self.create_timer(TICK, self.say)
        self.create_timer(5 * TICK, self.tell)

    def say(self) -> None:
        for topic, reported in self.values.items():
            if reported:
                self.outlets[topic].publish(self.lot.choice(reported))

    def tell(self) -> None:
        if self.card.lines:
            line = self.lot.choice(self.card.lines)
            log(self, line.level, line.text)

    def serve(self, request: Any, response: Any) -> Any:
        return self.lot.choice([it for it in self.answers if type(it) is type(response)] or [response])

    def result_of(self, action: str, goal: Any) -> Any:
        return self.lot.choice([result for name, result in self.results if name == action] or [None])


class AnswersItself(Replays):
    """As Replays; and asks its own servers, and serves its own clients, as was done in the public run."""

    def begin(self) -> None:
        super().begin()
        run = self.card.run
        self.answers = {call.raw_request: call.response for call in run.calls if call.raw_response}
        self.results = {goal.raw_request: goal.result for goal in run.goals if goal.raw_result}
        for name, end in self.card.ends("client").items():
            self.create_service(message_class(end.type), name, self.serve)
        self.servers += [self.offer(end) for end in self.card.ends("action client").values()]
        for name, end in self.card.ends("service").items():
            self.asking[name] = self.create_client(message_class(end.type), name)
        for name, end in self.card.ends("action server").items():
            self.sending[name] = ActionClient(self, message_class(end.type), name)
        self.requests = [(call.service, call.request) for call in run.calls_of()][:20]
        self.goals = [(goal.action, goal.request) for goal in run.goals][:20]
        self.create_timer(0.5, self.ask)

    def ask(self) -> None:
        if self.requests and self.requests[0][0] in self.asking:
            name, request = self.requests[0]
            self.asking[name].call_async(request)
        self.requests = self.requests[1:]
        if self.goals and self.goals[0][0] in self.sending:
            name, goal = self.goals[0]
            self.sending[name].send_goal_async(goal).add_done_callback(self.follow)
        self.goals = self.goals[1:]

    def follow(self, future: Any) -> None:
        if future.result().accepted:
            future.result().get_result_async()

    def serve(self, request: Any, response: Any) -> Any:
        return self.answers.get(encode(request), response)

    def result_of(self, action: str, goal: Any) -> Any:
        return self.results.get(encode(goal))


KINDS: dict[str, type[Stub]] = {
    "does nothing": Stub,
    "stages its world": Stages,
    "freezes its world": Freezes,
    "says everything": SaysEverything,
    "sends NaN": SendsNan,
    "answers itself": AnswersItself,
    "answers constantly": Constant,
    "answers by chance": Guesses,
    "a list of timed commands": Replays,
}


def adversary(kind: str, card: Card) -> Callable[[], Node]:
    """A program of this kind, for `grade`."""
    make = KINDS[kind]
    return lambda: make(card)
