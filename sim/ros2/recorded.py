"""The systems of a run: a recording, or a running player, in simulated time."""

from __future__ import annotations

import math
import select
from collections.abc import Callable, Collection, Iterator

import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile

from sim.evidence import Endpoint, Recording
from sim.evidence.qos import offer, refusal, settings
from sim.ros.engine.program import Process
from sim.ros.play.player import FRAME, Player
from sim.ros2.system import OWN_NAME, CliError, NodeTask, Output, ReceivedMessage, System, T, with_node

TIME_LIMIT = 5.0  # s of simulated time, in a cell, of a command that would not end in a terminal
MAX_MESSAGES = 10  # that a cell prints
TASK_TIMEOUT = 20.0  # s of simulated time
_NODE_TOPICS = {"/parameter_events": "rcl_interfaces/msg/ParameterEvent", "/rosout": "rcl_interfaces/msg/Log"}
TRANSITIONS = "transition_event", "lifecycle_msgs/msg/TransitionEvent"  # of a lifecycle node
_NODE_SERVICES = {
    "describe_parameters": "rcl_interfaces/srv/DescribeParameters",
    "get_parameter_types": "rcl_interfaces/srv/GetParameterTypes",
    "get_parameters": "rcl_interfaces/srv/GetParameters",
    "get_type_description": "type_description_interfaces/srv/GetTypeDescription",
    "list_parameters": "rcl_interfaces/srv/ListParameters",
    "set_parameters": "rcl_interfaces/srv/SetParameters",
    "set_parameters_atomically": "rcl_interfaces/srv/SetParametersAtomically",
}  # rclpy's services of each node, which a recording's graph leaves out


class RecordedSystem(System):
    """A run that has ended."""

    finished = True
    max_messages = MAX_MESSAGES

    def __init__(self, recording: Recording, print_line: Callable[[str], None] = print) -> None:
        super().__init__(print_line)
        self.recording, self.epoch = recording, recording.epoch

    @property
    def nodes(self) -> list[str]:
        """Work like `System`: all nodes of the run."""
        return [name for name in self.recording.graph.nodes if f"/{OWN_NAME}" not in name]

    @property
    def endpoints(self) -> list[Endpoint]:
        """Work like `System`."""
        nodes = self.nodes
        declared = [end for end in self.recording.graph.endpoints if end.node in nodes]
        for node in dict.fromkeys(nodes):
            declared += [Endpoint("publisher", node, topic, kind, {}) for topic, kind in _NODE_TOPICS.items()]
            declared += [
                Endpoint("service", node, f"{node}/{name}", kind, {}) for name, kind in _NODE_SERVICES.items()
            ]
        managed = [end.node for end in declared if end.type == "lifecycle_msgs/srv/GetState"]
        topic, kind = TRANSITIONS
        return declared + [Endpoint("publisher", node, f"{node}/{topic}", kind, {}) for node in managed]

    @property
    def now(self) -> float:
        """Work like `System`: the end of the run."""
        return self.recording.stamp

    def subscribe(
        self, topics: dict[str, str], profile: QoSProfile | None = None
    ) -> Iterator[ReceivedMessage | None]:
        """Work like `System`: all recorded messages, at once."""
        self._warn_of_incompatible(topics, profile)
        yield from self._published(0, topics, profile)

    def _published(
        self, first: int, topics: dict[str, str], profile: QoSProfile | None
    ) -> Iterator[ReceivedMessage]:
        incompatible = {(end.node, end.name) for end, _ in self._incompatible(profile)}
        for message in self.recording.published[first:]:
            stamp, topic, sender = message.stamp, message.topic, message.sender
            if topic in topics and (sender, topic) not in incompatible:
                yield ReceivedMessage(stamp, stamp, topic, message.type, message.raw, sender)

    def _incompatible(self, profile: QoSProfile | None) -> list[tuple[Endpoint, tuple[str, str, str]]]:
        """The publishers whose QoS does not match this profile, each with what `refusal` returns."""
        if profile is None:
            return []
        publishers, requested = self.recording.graph.publishers(), settings(profile)
        return [(end, found) for end in publishers if (found := refusal(end.qos, requested))]

    def _warn_of_incompatible(self, topics: Collection[str], profile: QoSProfile | None) -> None:
        """Print why nothing arrives from a publisher, as rclpy does for a live one."""
        for end, (policy, offered, requested) in self._incompatible(profile):
            if end.name in topics:
                self.print_line(
                    f"WARNING: {end.node} publishes {end.name} {offer(policy, offered)}, but this command "
                    f"requests {requested}: no messages will be received from it"
                )

    def run_with_node(self, task: NodeTask[T], seconds: float | None = None) -> T:
        """Always raises CliError, because no nodes are running."""
        raise CliError(
            "Nothing is running any more: this is the recording of the last run. Start one with play(...), "
            "and try again while it runs."
        )


class PlayedSystem(RecordedSystem):
    """A run that is being played. While a cell waits, simulated time advances at the player's speed."""

    finished = False
    time_limit = TIME_LIMIT

    def __init__(self, player: Player, print_line: Callable[[str], None] = print) -> None:
        super().__init__(player.recording, print_line)
        self._player = player

    @property
    def nodes(self) -> list[str]:
        """Work like `System`."""
        alive = self._player.nodes
        return [name for name in super().nodes if name in alive]

    @property
    def now(self) -> float:
        """Work like `System`."""
        return self._player.stamp

    def subscribe(
        self, topics: dict[str, str], profile: QoSProfile | None = None
    ) -> Iterator[ReceivedMessage | None]:
        """Work like `System`, but only for the time limit, because other cells wait."""
        first = len(self.recording.published)
        self._warn_of_incompatible(topics, profile)
        yield from self._latched(topics, profile)
        for _ in self._advance(TIME_LIMIT):
            messages = list(self._published(first, topics, profile))
            first = len(self.recording.published)
            yield from messages
            yield None

    def _latched(self, topics: dict[str, str], profile: QoSProfile | None) -> Iterator[ReceivedMessage]:
        """The earlier messages that a new subscription gets if its profile is transient local or None."""
        if profile is not None and profile.durability is not DurabilityPolicy.TRANSIENT_LOCAL:
            return
        for end in self.recording.graph.publishers():
            if end.name in topics and end.qos["durability"] == "transient_local":
                sent = self._published(0, {end.name: end.type}, profile)
                stored = [message._replace(stamp=self.now) for message in sent if message.sender == end.node]
                yield from stored[-end.qos["depth"] :]

    def run_with_node(self, task: NodeTask[T], seconds: float | None = None) -> T:
        """Work like `System`, with a node in the player's run."""
        lines: list[str] = []
        results: list[T] = []
        failures: list[CliError] = []
        output = Output(lines.append)

        def ros2() -> None:
            rclpy.init()
            try:
                results.append(with_node(task, output))
            except CliError as failure:
                failures.append(failure)
            finally:
                rclpy.try_shutdown()

        limit = TASK_TIMEOUT if seconds is None else seconds
        frames = self._advance(limit, lambda: bool(results or failures))
        next(frames)  # raises if the player is paused
        self._player.add(Process(ros2))
        try:
            for _ in frames:
                while lines:
                    self.print_line(lines.pop(0))
        finally:
            output.canceled = True
        if failures:
            raise failures[0]
        if not results:
            ended = "before the play ended" if self._player.over else f"within {limit:g} s of the play"
            raise CliError(f"Nothing came of it {ended}.")
        return results[0]

    def _advance(self, seconds: float, enough: Callable[[], bool] = lambda: False) -> Iterator[None]:
        """Play for a simulated time at most, and yield after each frame. Raises CliError if it is paused."""
        player, limit = self._player, self.now + seconds
        if player.paused:
            raise CliError("The play is paused, so nothing happens in it: resume it, and try again.")
        yield
        while not player.over and not enough() and self.now < limit - 1e-9:
            player.play_frame(limit, enough)
            yield
            if player.speed != math.inf:
                select.select((), (), (), FRAME)  # keeps to the wall clock
