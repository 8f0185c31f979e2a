"""The programs of a world as an ordinary ROS 2 process: in real time, visible to others on this machine."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from time import monotonic
from typing import Any

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter_service import ParameterService
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args

from sim import ros_environment
from sim.evidence import INFRASTRUCTURE_TOPICS
from sim.ros.messages.codec import type_name
from sim.ros.robots.world_programs import programs_of
from sim.world import Scene, World, simulate

MAX_GAP = 0.5  # s; a process that was stopped for longer continues from there instead of catching up
CHATTER = INFRASTRUCTURE_TOPICS - {"/clock"}
CHECK = 1.0  # s between two looks at the graph
SECOND_ROBOT = (
    "There is a second {name} on ROS domain {domain} of this machine: both obey the same commands, and their"
    " messages mix. End one of them, or start one with --domain {other}."
)
PATIENCE = 0.1  # s until a stop is noticed when nothing else happens


class ArgumentsError(Exception):
    """ROS can't read the arguments after --ros-args."""


def own_words(words: Sequence[str]) -> list[str]:
    """The words of a command line that are not ROS's. Raises ArgumentsError."""
    with _readable(words):
        return remove_ros_args(list(words))


@contextmanager
def _readable(words: Sequence[str]) -> Iterator[None]:
    try:
        yield
    except RuntimeError as error:  # of rcl, which has written more to stderr
        arguments = " ".join(words[words.index("--ros-args") :])
        raise ArgumentsError(f"ROS can't read {arguments}: {error}") from None


class _Executor(SingleThreadedExecutor):
    """Moves the world on before each callback."""

    def __init__(self, move_on: Callable[[], None]) -> None:
        super().__init__()
        self._move_on = move_on

    def wait_for_ready_callbacks(self, *arguments: Any, **keywords: Any) -> Any:
        """Work like rclpy's executors; what is ready finds the world where it is by now."""
        ready = super().wait_for_ready_callbacks(*arguments, **keywords)
        self._move_on()
        return ready


class RealTimeRun:
    """A world whose nodes other processes on this machine can see. Nothing is recorded, so nothing grows.

    Use as a context manager. `scene` may be looked at from other threads. Raises WorldError when the world
    can't be simulated, and ArgumentsError for words after --ros-args that can't be read.
    """

    def __init__(self, world: World, seed: int, domain: int, words: Sequence[str] = ()) -> None:
        self.scene: Scene = simulate(world, seed)
        self.domain, self._words = domain, list(words)
        self.nodes: list[Node] = []
        self._time, self._seen = 0.0, monotonic()  # the scene's, and when it was there
        self.warning = ""  # what the user should know; it is printed once

    def __enter__(self) -> RealTimeRun:
        ros_environment.open_to_this_machine(self.domain)
        # Its own handlers would shut ROS down in the middle of a callback.
        with _readable(self._words):
            rclpy.init(args=self._words, signal_handler_options=SignalHandlerOptions.NO)
        self._executor = _Executor(self._move_on)
        for process in programs_of(self.scene):
            self.add(process.target())
        self.every(CHECK, self._look_for_second_robot)
        return self

    def __exit__(self, *exception: object) -> None:
        self._executor.shutdown()
        for node in self.nodes:
            node.destroy_node()
        rclpy.try_shutdown()

    def _look_for_second_robot(self) -> None:
        """Warn once if another process on this domain has a node of the same name."""
        if self.warning:
            return
        names = Counter(self.nodes[0].get_node_names_and_namespaces())
        twice = sorted(f"{space.rstrip('/')}/{name}" for (name, space), count in names.items() if count > 1)
        found = [name for name in twice if name in {node.get_fully_qualified_name() for node in self.nodes}]
        if found:
            self.warning = SECOND_ROBOT.format(name=found[0], domain=self.domain, other=self.domain + 1)
            print(self.warning, file=sys.stderr, flush=True)

    def _move_on(self) -> None:
        """Advance the scene with the wall clock, whatever the nodes' clocks show: those may be set."""
        now = monotonic()
        self._time += min(now - self._seen, MAX_GAP)
        self._seen = now
        self.scene.advance(self._time)
        self.scene.discard_history()

    def add(self, node: Node) -> None:
        """Run one more node. Only here does a robot's node get parameter services, for `ros2 param`."""
        if not any(service.srv_name.endswith("/get_parameters") for service in node.services):
            ParameterService(node)
        self.nodes.append(node)
        self._executor.add_node(node)

    @property
    def takes(self) -> dict[str, str]:
        """The topics that the nodes take, each with its type, sorted by name."""
        return _topics(end for node in self.nodes for end in node.subscriptions)

    @property
    def gives(self) -> dict[str, str]:
        """The topics that only the nodes give, each with its type, sorted by name."""
        given = _topics(end for node in self.nodes for end in node.publishers)
        return {name: kind for name, kind in given.items() if name not in self.takes}

    def every(self, seconds: float, act: Callable[[], None]) -> None:
        """Have something done again and again, between the nodes' callbacks."""
        self.nodes[0].create_timer(seconds, act)

    def teleop(self) -> Callable[[float, float], None]:
        """Add a node that drives the first robot: forward and left, each in [-1, 1], from any thread."""
        from sim.ros.play.teleop import TeleopSettings, teleop_settings
        from sim.ros.robots.velocity import VelocityPublisher

        # Whatever --ros-args calls the robot's node, this one has its own name.
        node = Node("teleop", cli_args=["--ros-args", "-r", "__node:=teleop"])
        settings = teleop_settings(self.scene.world) or TeleopSettings()
        velocity = VelocityPublisher(node, settings.stamped, settings.topic)
        self.add(node)

        def drive(forward: float, left: float) -> None:
            velocity.send(forward * settings.speed, left * settings.turn)

        return drive

    def spin(self, stopped: Callable[[], bool]) -> None:
        """Run the nodes until `stopped()`."""
        while not stopped():
            self._executor.spin_once(timeout_sec=PATIENCE)


def _topics(ends: Iterable[Any]) -> dict[str, str]:
    kinds = {end.topic_name: type_name(end.msg_type) for end in ends}
    return {name: kind for name, kind in sorted(kinds.items()) if name not in CHATTER}
