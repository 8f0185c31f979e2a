"""The ROS system that ros2 commands inspect and use: nodes, endpoints, messages, and calls of its services.

Stamps are seconds: of the wall clock in a terminal, since the start of the run in a notebook.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from itertools import count
from typing import Any, NamedTuple, TypeVar

import rclpy
from rclpy.exceptions import NameValidationException
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.task import Future

from sim.evidence import Endpoint
from sim.evidence.rows import CLI_NAME
from sim.nanoseconds import SECOND, Nanoseconds
from sim.suggestions import closest_match

HIDDEN = "_"  # prefix of hidden names, which are shown only on request
OWN_NAME = CLI_NAME  # of these commands' own nodes
_numbers = count(1)
SERVICE_TIMEOUT = 5.0  # s until a service must be available, as in the official tools
POLL = 0.1  # s
T = TypeVar("T")
Known = TypeVar("Known", bound=Collection[str])


class CliError(Exception):
    """A command failed. The message is printed for the user; if it is empty, only the exit status says so."""


class ReceivedMessage(NamedTuple):
    """A message that was received by a subscription."""

    stamp: float  # s, when it was received
    sent: float  # s, when it was sent
    topic: str
    type: str
    raw: bytes
    sender: str = ""  # the node, if it is known


class Output:
    """Prints the lines of a command. canceled: set once the command is to end early."""

    def __init__(self, print_line: Callable[[str], None]) -> None:
        self.print_line, self.canceled = print_line, False


NodeTask = Callable[[Node, Output], T]


class System(ABC):
    """The system that a command inspects and uses. print_line: prints a line of the output."""

    finished = False  # True for a recording: no time passes any more
    time_limit: float | None = None  # s, of commands that would not end by themselves
    max_messages: int | None = None  # that are printed
    epoch: Nanoseconds = 0  # the nodes' clock at time 0 s

    def __init__(self, print_line: Callable[[str], None] = print) -> None:
        self.print_line = print_line

    @property
    @abstractmethod
    def nodes(self) -> list[str]:
        """Full names of all nodes, hidden ones and namesakes included."""

    @property
    @abstractmethod
    def endpoints(self) -> list[Endpoint]:
        """All endpoints of topics, services and actions, including ROS's own."""

    @property
    @abstractmethod
    def now(self) -> float:
        """The time in seconds."""

    @abstractmethod
    def subscribe(
        self, topics: dict[str, str], profile: QoSProfile | None = None
    ) -> Iterator[ReceivedMessage | None]:
        """Yield the messages of these topics as they arrive, and None from time to time while none does.

        topics: name to type. profile: of the subscriptions; None matches each topic's publishers.
        """

    @abstractmethod
    def run_with_node(self, task: NodeTask[T], seconds: float | None = None) -> T:
        """Run a task with a new node of this command, and return its result.

        seconds: time limit. Raises CliError if no nodes are running.
        """

    def uninterrupted(self) -> AbstractContextManager[Sequence[int]]:
        """A block that Ctrl-C doesn't leave in the middle; gives what isn't empty once it was pressed."""
        return nullcontext(())

    def call(self, kind: type, service: str, request: Any) -> Any:
        """The response of a service. Raises CliError if the service is not available."""
        return self.run_with_node(lambda node, _: call_service(node, kind, service, request))

    def look_up(self, name: str, find: Callable[[], Known], seconds: float | None = None) -> Known:
        """Return what `find` returns; during discovery, `find` is retried until its result contains the name.

        seconds: so long at most; None for the usual time.
        """
        return find()

    def names(self, *kinds: str, hidden: bool = False) -> dict[str, list[str]]:
        """Name to types of all topics, services or actions with an endpoint of these kinds, sorted."""
        found: dict[str, set[str]] = {}
        for end in self.endpoints:
            if end.kind in kinds and (hidden or not is_hidden(end.name)):
                found.setdefault(end.name, set()).add(end.type)
        return {name: sorted(types) for name, types in sorted(found.items())}

    def topics(self, *, hidden: bool = False) -> dict[str, list[str]]:
        """Name to types of all topics, sorted."""
        return self.names("publisher", "subscription", hidden=hidden)

    def node(self, name: str, *, hidden: bool = True, seconds: float | None = None) -> str:
        """The full name of an existing node, after a wait for it as in `look_up`. Raises CliError."""
        full = name if name.startswith("/") else f"/{name}"

        def shown() -> list[str]:
            return [node for node in self.nodes if hidden or not is_hidden(node)]

        known = self.look_up(full, shown, seconds)
        if full not in known:
            raise CliError(f"Node not found{suggestion(full, known)}")
        return full


def is_hidden(name: str) -> bool:
    """Return whether a name is hidden by ROS's convention."""
    return any(part.startswith(HIDDEN) for part in name.split("/"))


def suggestion(name: str, known: Iterator[str] | list[str] | dict[str, list[str]]) -> str:
    """The end of an error message that suggests the closest known name, or an empty text."""
    near = closest_match(name, known)
    return f". Did you mean {near}?" if near else ""


def with_node(task: NodeTask[T], output: Output) -> T:
    """Run a task with a hidden node, which is destroyed afterwards. rclpy must be initialized."""
    node = rclpy.create_node(f"{OWN_NAME}_{next(_numbers)}", start_parameter_services=False)
    try:
        return task(node, output)
    except (NameValidationException, ValueError) as error:  # an invalid name
        raise CliError(" ".join(str(error).split())) from None
    finally:
        node.destroy_node()


def wait_for(node: Node, future: Future) -> Any:
    """The result of a future. Raises its exception."""
    while not future.done():
        rclpy.spin_once(node, timeout_sec=POLL)
    return future.result()


def call_service(node: Node, kind: type, service: str, request: Any) -> Any:
    """The response of a service. Raises CliError if the service is not available in time."""
    client = node.create_client(kind, service)
    clock, began = node.get_clock(), node.get_clock().now()
    while not client.service_is_ready():
        rclpy.spin_once(node, timeout_sec=POLL)
        if (clock.now() - began).nanoseconds > SERVICE_TIMEOUT * SECOND:
            raise CliError(f"Wait for service timed out waiting for {service}")
    return wait_for(node, client.call_async(request))
