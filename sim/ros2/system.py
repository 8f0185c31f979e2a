"""What the words of ros2 ask: which nodes there are and how they are connected, what they send, what they do.

Stamps are seconds: of the wall clock in a terminal, since the start of the run in a notebook.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Iterator
from itertools import count
from typing import Any, NamedTuple, TypeVar

import rclpy
from rclpy.exceptions import NameValidationException
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.task import Future

from sim.evidence import Endpoint
from sim.nanoseconds import SECOND, Nanoseconds
from sim.suggestions import closest_match

HIDDEN = "_"  # a name with a part that begins with this is left out unless one asks for it
OWN_NAME = "_ros2cli"  # what nodes of these tools are called
_numbers = count(1)
PATIENCE = 5.0  # s, until a service that should be there is given up, as by the official tools
POLL = 0.1  # s between two looks at whether something has come
T = TypeVar("T")
Known = TypeVar("Known", bound=Collection[str])


class Wrong(Exception):
    """What the user asked for can't be done; its words are for the user. Without words, just the status."""


class Arrived(NamedTuple):
    """One message as a listener gets it."""

    stamp: float  # s, when it arrived
    sent: float  # s, when it was sent
    topic: str
    type: str
    raw: bytes
    sender: str = ""  # where it is known, the node


class Voice:
    """How work that is done with a node shows lines, and hears that nobody waits for it any more."""

    def __init__(self, say: Callable[[str], None]) -> None:
        self.say, self.stopped = say, False


Work = Callable[[Node, Voice], T]


class System(ABC):
    """What the words are about. `say` shows a line."""

    over = False  # whether all has happened already, and no time passes any more
    window: float | None = None  # s; what has no end of its own goes on for so long at most
    most: int | None = None  # so many messages are shown at most
    epoch: Nanoseconds = 0  # what the nodes' clocks show when the time is 0 s

    def __init__(self, say: Callable[[str], None] = print) -> None:
        self.say = say

    @property
    @abstractmethod
    def nodes(self) -> list[str]:
        """Full names of all nodes, hidden ones and namesakes included."""

    @property
    @abstractmethod
    def ends(self) -> list[Endpoint]:
        """All ends of topics, services and actions, ROS's own included."""

    @property
    @abstractmethod
    def now(self) -> float:
        """The time in seconds."""

    @abstractmethod
    def listen(self, topics: dict[str, str], profile: QoSProfile | None = None) -> Iterator[Arrived | None]:
        """Yield the messages of these topics as they come, and None now and then while none does.

        topics: name to type. profile: of the subscriptions; None takes what each topic has.
        """

    @abstractmethod
    def act(self, work: Work[T], seconds: float | None = None) -> T:
        """Do something with a node of one's own; what it returns.

        seconds: it may take so long. Raises Wrong where nothing runs.
        """

    def look_for(self, name: str, look: Callable[[], Known]) -> Known:
        """What a look finds; where things are found one by one, the last of some looks for this name."""
        return look()

    def names(self, *kinds: str, hidden: bool = False) -> dict[str, list[str]]:
        """Name to types of all topics, services or actions that have an end of these kinds, sorted."""
        found: dict[str, set[str]] = {}
        for end in self.ends:
            if end.kind in kinds and (hidden or not is_hidden(end.name)):
                found.setdefault(end.name, set()).add(end.type)
        return {name: sorted(types) for name, types in sorted(found.items())}

    def topics(self, *, hidden: bool = False) -> dict[str, list[str]]:
        """Name to types of all topics, sorted."""
        return self.names("publisher", "subscription", hidden=hidden)

    def node(self, name: str, *, hidden: bool = True) -> str:
        """The full name of a node that there is. Raises Wrong for none."""
        full = name if name.startswith("/") else f"/{name}"
        known = self.look_for(full, lambda: [node for node in self.nodes if hidden or not is_hidden(node)])
        if full not in known:
            raise Wrong(f"Node not found{guess(full, known)}")
        return full


def is_hidden(name: str) -> bool:
    """Whether a name is for tools rather than for people."""
    return any(part.startswith(HIDDEN) for part in name.split("/"))


def guess(name: str, known: Iterator[str] | list[str] | dict[str, list[str]]) -> str:
    """A question to end a message with, where a name that isn't there is nearly one that is; or nothing."""
    near = closest_match(name, known)
    return f". Did you mean {near}?" if near else ""


def with_node(work: Work[T], voice: Voice) -> T:
    """What some work with a hidden node returns. rclpy has been initialised; the node is gone afterwards."""
    node = rclpy.create_node(f"{OWN_NAME}_{next(_numbers)}", start_parameter_services=False)
    try:
        return work(node, voice)
    except (NameValidationException, ValueError) as error:  # a name that none can have
        raise Wrong(" ".join(str(error).split())) from None
    finally:
        node.destroy_node()


def answer(node: Node, future: Future) -> Any:
    """What comes of a future. Raises what it raises."""
    while not future.done():
        rclpy.spin_once(node, timeout_sec=POLL)
    return future.result()


def ask(node: Node, kind: type, service: str, request: Any) -> Any:
    """The answer of a service. Raises Wrong where it isn't there for a while."""
    client = node.create_client(kind, service)
    clock, began = node.get_clock(), node.get_clock().now()
    while not client.service_is_ready():
        rclpy.spin_once(node, timeout_sec=POLL)
        if (clock.now() - began).nanoseconds > PATIENCE * SECOND:
            raise Wrong(f"Wait for service timed out waiting for {service}")
    return answer(node, client.call_async(request))
