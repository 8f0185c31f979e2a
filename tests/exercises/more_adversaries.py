"""More ways to get points without the work: python -m tests.exercises.more_adversaries [EXERCISE ...]

Publishing everything everywhere, receiving one message and no more, asking about everything, and a package
whose functions do nothing. Run as a program, it prints what these and the other adversaries earn in each
exercise, beside its points and what is given for being there.
"""

from __future__ import annotations

import ast
import collections
import copy
import dataclasses
import itertools
import sys
from typing import Any

import rclpy
from rclpy.node import Node
from rclpy.subscription import Subscription

from sim import Process
from sim.ros.messages.codec import message_class
from tests.exercises.adversaries import KINDS, Replays, Stub, adversary
from tests.exercises.at_times import _team
from tests.exercises.builds import kept_builds
from tests.exercises.cards import Card, log, profile
from tests.exercises.chance import card_of, earned, for_being_there, named_exercises
from tests.exercises.score_tables import students
from tests.exercises.seeds import right_nodes
from tests.students.teams import Team
from tests.students.workspaces import Workspace

STREAM = 5  # messages on a topic, from which on receiving one of them is too few
GRID = [0.25 * step for step in range(-24, 25)]  # m
LISTENS_ONCE, HOLLOW = "listens once", "functions that do nothing"


class PublishesEverywhere(Stub):
    """Publishes all values of the public run and all places on every topic; one log line has all words."""

    def begin(self) -> None:
        both = ("publisher", "subscription")
        ends = {name: end for kind in both for name, end in self.card.ends(kind, from_course=True).items()}
        for name, end in ends.items():
            if name not in self.outlets:
                self.outlets[name] = self.create_publisher(message_class(end.type), name, profile(end))
        self.values: dict[str, list[Any]] = collections.defaultdict(list)
        for from_course in (False, True):
            for row in self.card.published(from_course=from_course):
                if row.topic in self.outlets and len(self.values[row.topic]) < 40:
                    self.values[row.topic].append(row.message)
        self.line = " ".join(dict.fromkeys(line.text for line in self.card.lines))[:4000]
        self.create_timer(0.1, self.say)

    def say(self) -> None:
        now = self.get_clock().now().to_msg()
        for topic, messages in self.values.items():
            union = everything_of(messages)
            for message in [*messages[:: max(1, len(messages) // 8)], union]:
                if hasattr(message, "header"):
                    message.header.stamp = now
                self.outlets[topic].publish(message)
        for level in ("INFO", "WARN"):
            log(self, level, self.line)


def everything_of(messages: list[Any]) -> Any:
    """A message whose lists hold what is in those of all messages; of poses there is one at each place."""
    made = copy.deepcopy(messages[0])
    for field, kind in type(made).get_fields_and_field_types().items():
        if not (kind.startswith("sequence<") and "/" in kind):
            continue
        parts = [part for message in messages for part in getattr(message, field)][:500]
        if kind == "sequence<geometry_msgs/Pose>" and parts:
            parts = [copy.deepcopy(parts[0]) for _ in range(len(GRID) ** 2)]
            for pose, (x, y) in zip(parts, itertools.product(GRID, GRID), strict=True):
                pose.position.x, pose.position.y = x, y
        setattr(made, field, parts)
    return made


class AsksEverything(Replays):
    """As Replays; and asks all that can be asked, again and again, and passes on whatever it receives."""

    def begin(self) -> None:
        super().begin()
        run = self.card.run
        self.requests = [(call.service, call.request) for call in run.calls if call.service in self.asking]
        self.goals = [(goal.action, goal.request) for goal in run.goals if goal.action in self.sending]
        self.values: dict[str, list[bytes]] = collections.defaultdict(list)
        for row in self.card.published(from_course=False):
            if row.topic in self.outlets and row.raw not in self.values[row.topic]:
                self.values[row.topic].append(row.raw)
        for name, end in self.card.ends("subscription").items():
            same = [topic for topic, other in self.card.ends("publisher").items() if other.type == end.type]
            relay = self.relay_to(same)
            self.create_subscription(message_class(end.type), name, relay, profile(end))
        self.create_timer(0.2, self.ask)

    def relay_to(self, topics: list[str]) -> Any:
        def relay(message: Any) -> None:
            for topic in topics:
                self.outlets[topic].publish(message)

        return relay

    def ask(self) -> None:
        for name, request in self.requests[:10]:
            self.asking[name].call_async(request)
        for name, goal in self.goals[:3]:
            self.sending[name].send_goal_async(goal)
        for topic, values in self.values.items():
            for raw in values[:10]:
                self.outlets[topic].publish(raw)


def listening_once(target: Any, card: Card) -> Any:
    """The program with a node that destroys each subscription to a stream after its first message.

    None where it is no class of a node with such a subscription.
    """
    if isinstance(target, Team):
        return _team(listening_once(program, card) or program for program in target.programs)
    if isinstance(target, Process):
        inner = listening_once(target.target, card)
        return inner and dataclasses.replace(target, target=inner)
    if not (isinstance(target, type) and issubclass(target, Node)):
        return None
    counts = collections.Counter(row.topic for row in card.run.messages() if row.from_course)
    streams = {topic for topic, count in counts.items() if count >= STREAM}
    if not streams & {end.name for end in card.run.graph.ends("subscription") if not end.from_course}:
        return None

    def main(args: list[str] | None = None) -> None:
        rclpy.init(args=args)
        node = target()
        for subscription in [one for one in node.subscriptions if one.topic_name in streams]:
            subscription.callback = _once(node, subscription, subscription.callback)
        rclpy.spin(node)

    return main


def _once(node: Node, subscription: Subscription, callback: Any) -> Any:
    def receive(message: Any) -> Any:
        node.destroy_subscription(subscription)
        return callback(message)

    return receive


class _Hollow(ast.NodeTransformer):
    """Leaves a function its name, and nothing to do."""

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.FunctionDef:
        node.body = [ast.Pass()]
        return node

    visit_AsyncFunctionDef = visit_FunctionDef


def hollow(workspace: Workspace) -> Workspace:
    """A package of which only names are left: those of files, imports, classes and functions."""

    def emptied(path: str, text: str | bytes) -> str | bytes:
        if not path.endswith(".py") or path.endswith("/setup.py"):
            return text
        return ast.unparse(_Hollow().visit(ast.parse(text)))

    return Workspace(__name__, {path: emptied(path, text) for path, text in workspace.files.items()})


MORE_KINDS: dict[str, type[Stub]] = {
    "publishes everywhere": PublishesEverywhere,
    "asks everything": AsksEverything,
}


def more_adversary(kind: str, topic: str, name: str) -> Any:
    """A program of this kind; None where there can be none."""
    card = card_of(topic, name)
    if kind == LISTENS_ONCE:
        nodes = students(topic, name)
        programs = (listening_once(nodes[right], card) for right in right_nodes(topic, name))
        return next(filter(None, programs), None)
    make = MORE_KINDS[kind]
    return lambda: make(card)


def main(words: list[str]) -> None:
    """Print the table."""
    kinds = [*KINDS, *MORE_KINDS, LISTENS_ONCE, HOLLOW]
    print(f"{'':20}{'points':>8}{'there':>8}", *(f"{kind:>24}" for kind in kinds))
    with kept_builds():
        for topic, own, exercise in named_exercises(words):
            scores = []
            for kind in kinds:
                program = None
                if kind == HOLLOW and exercise.package:
                    program = hollow(students(topic, own)[right_nodes(topic, own)[0]])
                elif kind in KINDS:
                    program = adversary(kind, card_of(topic, own))
                elif kind != HOLLOW and not exercise.package:
                    program = more_adversary(kind, topic, own)
                scores.append("-" if program is None else f"{float(earned(exercise, kind, program)):g}")
            begin = f"{exercise.name:20}{exercise.points:8g}{for_being_there(exercise):8g}"
            print(begin, *(f"{score:>24}" for score in scores), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
