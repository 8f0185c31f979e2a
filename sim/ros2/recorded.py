"""The words of ros2 about a run: a recording, or a play that is going on, in its time."""

from __future__ import annotations

import math
import select
from collections.abc import Callable, Iterator

import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile

from sim.evidence import Endpoint, Recording
from sim.evidence.qos import refusal, settings
from sim.nanoseconds import EPOCH
from sim.ros.engine.program import Process
from sim.ros.play.player import FRAME, Player
from sim.ros2.system import OWN_NAME, Arrived, System, T, Voice, Work, Wrong, with_node

WINDOW = 5.0  # s of a play; what goes on without end in a terminal does so for this long in a cell
SHOWN = 10  # messages; a cell that shows all of a run is no help
PATIENCE = 20.0  # s of a play, until an answer comes
_NODE_TOPICS = {"/parameter_events": "rcl_interfaces/msg/ParameterEvent", "/rosout": "rcl_interfaces/msg/Log"}
TRANSITIONS = "transition_event", "lifecycle_msgs/msg/TransitionEvent"  # of a node with a lifecycle
_NODE_SERVICES = {
    "describe_parameters": "rcl_interfaces/srv/DescribeParameters",
    "get_parameter_types": "rcl_interfaces/srv/GetParameterTypes",
    "get_parameters": "rcl_interfaces/srv/GetParameters",
    "get_type_description": "type_description_interfaces/srv/GetTypeDescription",
    "list_parameters": "rcl_interfaces/srv/ListParameters",
    "set_parameters": "rcl_interfaces/srv/SetParameters",
    "set_parameters_atomically": "rcl_interfaces/srv/SetParametersAtomically",
}  # what rclpy gives each node; the graph of a recording leaves it out


class Recorded(System):
    """A run that is over."""

    over = True
    most = SHOWN
    epoch = EPOCH

    def __init__(self, recording: Recording, say: Callable[[str], None] = print) -> None:
        super().__init__(say)
        self.recording = recording

    @property
    def nodes(self) -> list[str]:
        """As `System`; all that there were at any time."""
        return [name for name in self.recording.graph.nodes if f"/{OWN_NAME}" not in name]

    @property
    def ends(self) -> list[Endpoint]:
        """As `System`."""
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
        """As `System`: when it ended."""
        return self.recording.stamp

    def listen(self, topics: dict[str, str], profile: QoSProfile | None = None) -> Iterator[Arrived | None]:
        """As `System`: all that was sent, at once."""
        yield from self._heard(0, topics, profile)

    def _heard(self, first: int, topics: dict[str, str], profile: QoSProfile | None) -> Iterator[Arrived]:
        deaf = self._unheard(profile)
        for heard in self.recording.published[first:]:
            if heard.topic in topics and (heard.sender, heard.topic) not in deaf:
                yield Arrived(heard.stamp, heard.stamp, heard.topic, heard.type, heard.raw, heard.sender)

    def _unheard(self, profile: QoSProfile | None) -> set[tuple[str, str]]:
        """The senders, with their topics, whom a subscription with this profile doesn't hear."""
        if profile is None:
            return set()
        publishers, wanted = self.recording.graph.publishers(), settings(profile)
        return {(end.node, end.name) for end in publishers if refusal(end.qos, wanted)}

    def act(self, work: Work[T], seconds: float | None = None) -> T:
        """As `System`: nothing can be done any more."""
        raise Wrong(
            "Nothing runs any more: this is the recording of the last run. Start one with play(...), and try"
            " again while it goes on."
        )


class Played(Recorded):
    """A run that is going on. Time goes on while a cell waits, at the speed of the play."""

    over = False
    window = WINDOW

    def __init__(self, player: Player, say: Callable[[str], None] = print) -> None:
        super().__init__(player.recording, say)
        self._player = player

    @property
    def nodes(self) -> list[str]:
        """As `System`."""
        alive = self._player.nodes
        return [name for name in super().nodes if name in alive]

    @property
    def now(self) -> float:
        """As `System`."""
        return self._player.stamp

    def listen(self, topics: dict[str, str], profile: QoSProfile | None = None) -> Iterator[Arrived | None]:
        """As `System`, but for no longer than a while, as other cells wait."""
        first = len(self.recording.published)
        yield from self._latched(topics, profile)
        for _ in self._go_on(WINDOW):
            arrived = list(self._heard(first, topics, profile))
            first = len(self.recording.published)
            yield from arrived
            yield None

    def _latched(self, topics: dict[str, str], profile: QoSProfile | None) -> Iterator[Arrived]:
        """What a late joiner gets of transient_local publishers, if it asks for that or leaves it open."""
        if profile is not None and profile.durability is not DurabilityPolicy.TRANSIENT_LOCAL:
            return
        for end in self.recording.graph.publishers():
            if end.name in topics and end.qos["durability"] == "transient_local":
                sent = self._heard(0, {end.name: end.type}, profile)
                kept = [one._replace(stamp=self.now) for one in sent if one.sender == end.node]
                yield from kept[-end.qos["depth"] :]

    def act(self, work: Work[T], seconds: float | None = None) -> T:
        """As `System`: the node takes part in the play."""
        said: list[str] = []
        results: list[T] = []
        failures: list[Wrong] = []
        voice = Voice(said.append)

        def ros2() -> None:
            rclpy.init()
            try:
                results.append(with_node(work, voice))
            except Wrong as failure:
                failures.append(failure)
            finally:
                rclpy.try_shutdown()

        limit = PATIENCE if seconds is None else seconds
        course = self._go_on(limit, lambda: bool(results or failures))
        next(course)  # raises where the play doesn't go on
        self._player.add(Process(ros2))
        try:
            for _ in course:
                while said:
                    self.say(said.pop(0))
        finally:
            voice.stopped = True
        if failures:
            raise failures[0]
        if not results:
            ended = "before the play ended" if self._player.over else f"within {limit:g} s of the play"
            raise Wrong(f"Nothing came of it {ended}.")
        return results[0]

    def _go_on(self, seconds: float, enough: Callable[[], bool] = lambda: False) -> Iterator[None]:
        """Let the play go on for so long at most, and rest after each of its frames."""
        player, limit = self._player, self.now + seconds
        if player.paused:
            raise Wrong("The play is paused, so nothing happens in it: let it go on, and try again.")
        yield
        while not player.over and not enough() and self.now < limit - 1e-9:
            player.play_frame(limit, enough)
            yield
            if player.speed != math.inf:
                select.select((), (), (), FRAME)  # a play goes along with the clock on the wall
