"""Puppets: they stand in this process for the nodes of another one, and for what these have declared.

An action is made of what ROS makes it of: three services and two topics.
"""

from __future__ import annotations

import contextlib
from collections import Counter, defaultdict
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

from rclpy.exceptions import NameValidationException
from rclpy.qos import QoSProfile
from rclpy.validate_full_topic_name import validate_full_topic_name

from sim.ros.fibers.scheduler import outside_student_code
from sim.ros.remote.checked import MOST_NAME, Nonsense, interface, qos, text, whole
from sim.ros.remote.parts import (
    Part,
    PuppetClient,
    PuppetNode,
    PuppetPublisher,
    PuppetReader,
    PuppetService,
    PuppetSubscription,
    RCLError,
    destroy,
    parts_of_action,
)

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine


class PuppetAction:
    """One end of an action, for the records of goals."""

    def __init__(self, handle: Any) -> None:
        self._handle = handle  # where rclpy's action servers have theirs


KINDS: dict[str, type[Part]] = {
    "publisher": PuppetPublisher,
    "subscription": PuppetSubscription,
    "service": PuppetService,
    "client": PuppetClient,
}
INTERFACES = {"publisher": "msg", "subscription": "msg", "service": "srv", "client": "srv"}
ACTIONS = ("action server", "action client")
MOST_ENDS = 2_000  # alive at a time
ALL_ENDS = 5_000  # made in a run: some take 10 ms

Declared = tuple[str, PuppetNode, str, type, QoSProfile | None]  # kind, node, name, type, settings


class Puppets:
    """All puppets of one run, found by what the events on the wire call them."""

    def __init__(self, engine: Engine) -> None:
        self._engine = engine
        self.nodes: dict[int, PuppetNode] = {}
        self._ends: dict[int, list[Part]] = {}
        # Services that no node of this side has looked for: their names, and what makes them.
        self._unsought: dict[int, tuple[str, Callable[[], None]]] = {}
        self.actions: dict[int, PuppetAction] = {}
        self.publishers: dict[str, list[PuppetPublisher]] = defaultdict(list)  # by topic
        self.services: list[PuppetService] = []
        self.clients: dict[str, list[PuppetClient]] = defaultdict(list)  # by service
        self.listening: list[PuppetSubscription] = []  # parts of actions: their messages are taken here
        self.wanted: Counter[str] = Counter()  # subscriptions of the other side, by topic
        self.arrivals: list[Any] = []  # events of what has come through a network, for the other side
        self._made = 0

    def __contains__(self, number: object) -> bool:
        return isinstance(number, int) and number in self._ends

    def __len__(self) -> int:
        return len(self._ends)

    @property
    def names(self) -> set[str]:
        """Of the other side's nodes."""
        return {node.name for node in self.nodes.values()}

    def declare(
        self, number: Any, node: Any, of: Any, kind: Any, name: Any, type_: Any, profile: Any
    ) -> Declared:
        """Make what stands for an end that the other side tells of. Raises Nonsense for what can't be."""
        number, node = whole(number, "a number"), whole(node, "a number")
        of, name = text(of, "a node's name", MOST_NAME), text(name, "a name", MOST_NAME)
        if kind not in (*INTERFACES, *ACTIONS):
            raise Nonsense("an end of no known kind")
        if number in self or not of.startswith("/") or not name.startswith("/"):
            raise Nonsense(f"the end {name!r} of {of!r}, which can't be")
        if len(self) >= MOST_ENDS:
            raise Nonsense(f"more than {MOST_ENDS} ends of topics, services and actions")
        self._made += 1
        if self._made > ALL_ENDS:
            raise Nonsense(f"more than {ALL_ENDS} ends of topics, services and actions, one after the other")
        cls = interface(text(type_, "a type", MOST_NAME), INTERFACES.get(kind, "action"))
        settings = None if kind in ACTIONS else qos(profile)
        namespace, _, short = of.rpartition("/")
        try:
            puppet = self._node(node, namespace or "/", short)
            if kind == "service" and not self._is_sought(name):
                self._make_later(number, puppet, cls, name, settings)
            else:
                self._make(number, puppet, kind, cls, name, settings)
        except (ValueError, NameValidationException):
            raise Nonsense(f"the name {name!r} or {of!r}, which ROS does not allow") from None
        return kind, puppet, name, cls, settings

    def _node(self, number: int, namespace: str, name: str) -> PuppetNode:
        """The node of this number; the first time it is made. Raises ValueError for an impossible name."""
        if number not in self.nodes:
            self.nodes[number] = PuppetNode(self._engine, namespace, name)
        return self.nodes[number]

    def _make(self, number: int, node: PuppetNode, kind: str, type_: type, name: str, profile: Any) -> None:
        """Make what stands for one end of a topic, service or action. Raises ValueError for a bad name."""
        asked = parts_of_action(kind, type_, name) if kind in ACTIONS else [(kind, type_, name, profile)]
        parts = self._ends[number] = []
        node.ends.add(number)
        for what, part_type, part_name, part_profile in asked:
            with contextlib.suppress(RCLError):  # the name has another type here: they don't hear each other
                part = KINDS[what](node, part_type, part_name, self._suited(what, part_name, part_profile))
                parts.append(part)
                self._enter(number, part)
        if kind in ACTIONS and parts:
            action = self.actions[number] = PuppetAction(parts[0].handle)
            serves = kind == "action server"
            self._engine.recorder.goals.end_made(action, node, name, type_, serves=serves)
        self._engine.endpoints_changed()

    def _make_later(self, number: int, node: PuppetNode, type_: type, name: str, profile: QoSProfile) -> None:
        """Each node has six services for its parameters: to make them takes a quarter of a short run."""
        validate_full_topic_name(name, is_service=True)
        self._ends[number] = []
        node.ends.add(number)
        self._unsought[number] = name, partial(self._make, number, node, "service", type_, name, profile)

    def _is_sought(self, service: str) -> bool:
        return any(end.kind == "client" and end.name == service for end in self._engine.recorder.ends)

    def seek(self, service: str | None = None) -> None:
        """A node of this side looks for services of this name, or for all that there are."""
        with outside_student_code():  # it doesn't make them
            for number, (name, make) in list(self._unsought.items()):
                if service in (None, name):
                    del self._unsought[number]
                    make()

    def _suited(self, kind: str, name: str, profile: QoSProfile) -> QoSProfile:
        if kind != "subscription" or "/_action/" in name:
            return profile
        short = QoSProfile(depth=1, reliability=profile.reliability, durability=profile.durability)
        short.liveliness, short.deadline = profile.liveliness, profile.deadline
        short.liveliness_lease_duration = profile.liveliness_lease_duration
        return short

    def _enter(self, number: int, part: Part) -> None:
        calls = self._engine.recorder.calls
        if isinstance(part, PuppetPublisher):
            self.publishers[part.name].append(part)
            part.writer = self._engine.topics.writer(
                part.node.handle,
                part.handle,
                part.type,
                topic=part.name,
                profile=part.qos_profile,
                sender=part.node.name,
            )
        elif isinstance(part, PuppetService):
            self.services.append(part)
            calls.service_made(part)
            part._sim.node = part.node.name
        elif isinstance(part, PuppetClient):
            self.clients[part.name].append(part)
            calls.client_made(part, part.node, part.name)
            self._engine.has_clients = True
        elif part.of_action:
            self.listening.append(part)
        else:
            self.wanted[part.name] += 1
            if self._engine.links is not None:
                self._open_way(number, part)

    def _open_way(self, number: int, part: PuppetSubscription) -> None:
        part.reader = self._engine.topics.reader(
            part.node.handle,
            part.handle,
            part.type,
            topic=part.name,
            kind=PuppetReader,
            profile=part.qos_profile,
            raw=True,
            listener=part.node.name,
            number=number,
            arrivals=self.arrivals,
        )

    def remove(self, number: int) -> None:
        """Destroy what stands for one end, and the node with its last one. Raises KeyError for none."""
        self._unsought.pop(number, None)
        for part in self._ends.pop(number):
            if isinstance(part, PuppetPublisher):
                self.publishers[part.name].remove(part)
                part.writer.close()
            elif isinstance(part, PuppetService):
                self.services.remove(part)
            elif isinstance(part, PuppetClient):
                self.clients[part.name].remove(part)
            elif part.of_action:
                self.listening.remove(part)
            else:
                self.wanted[part.name] -= 1
                if part.reader is not None:
                    part.reader.close()
            destroy(part.handle)
        self.actions.pop(number, None)
        for key, node in list(self.nodes.items()):
            node.ends.discard(number)
            if not node.ends:
                self.nodes.pop(key).destroy()
        self._engine.endpoints_changed()

    def publisher(self, node: str, topic: str, *, newest: bool = False) -> PuppetPublisher | None:
        """The oldest or newest publisher of this node on a topic; of any node, for a topic of an action."""
        found = [part for part in self.publishers.get(topic, ()) if part.of_action or part.node.name == node]
        return found[-newest] if found else None

    def client(self, node: str, service: str) -> PuppetClient | None:
        """The client of a service that this node has; of any node, for a service of an action."""
        found = [part for part in self.clients.get(service, ()) if part.of_action or part.node.name == node]
        return found[0] if found else None

    def action(self, node: str, name: str, type_: str) -> PuppetAction | None:
        """The end of an action that this node has."""
        wanted = name, type_, node
        found = (a for a in self.actions.values() if (a._sim.action, a._sim.type, a._sim.node) == wanted)
        return next(found, None)

    def close(self) -> None:
        """Destroy all."""
        for number in list(self._ends):
            self.remove(number)
