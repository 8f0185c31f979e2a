"""Fills the recording while the run goes on: the hooks report here what student code does."""

from __future__ import annotations

import contextlib
import os
import sysconfig
import traceback
from typing import Any, NamedTuple

import greenlet
from rclpy.action import ActionClient, ActionServer
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

from sim.exchanges import is_node_service
from sim.recording import (
    INFRASTRUCTURE_TOPICS,
    CallbackError,
    CallbackRun,
    Endpoint,
    Heard,
    LogLine,
    Recording,
    TimerInfo,
)
from sim.ros.callbacks import Running, callback_name
from sim.ros.calls import Calls
from sim.ros.cdr import canonical
from sim.ros.codec import type_name
from sim.ros.fibers import SECOND, Livelock, RunOver, Scheduler
from sim.ros.goals import Goals

MAX_MESSAGES_PER_INSTANT = 20_000
MAX_MESSAGES = 1_000_000  # of a run
MAX_MESSAGE_BYTES = 500_000_000  # of a run
MAX_LOG_LINES = 100_000
MAX_PRINTED = 1_000_000  # characters
LEVELS = {10: "DEBUG", 20: "INFO", 30: "WARN", 40: "ERROR", 50: "FATAL"}
NO_FAULT = (
    RunOver,
    KeyboardInterrupt,
    SystemExit,
    GeneratorExit,
    greenlet.GreenletExit,
    ExternalShutdownException,
)
# Code that is no student's: this package, installed libraries, Python's own.
_LIBRARIES = (os.path.dirname(os.path.dirname(__file__)), *sysconfig.get_paths().values(), "<frozen ")


class OwnEnd(NamedTuple):
    """One end of a topic, service or action that a node of this process has, with rclpy's own handles."""

    kind: str
    node: Any
    node_name: str
    name: str
    type: type
    qos: Any
    handle: Any


class Recorder:
    """Writes into one recording, until it is closed."""

    def __init__(self, scheduler: Scheduler, recording: Recording) -> None:
        self.scheduler, self.recording = scheduler, recording
        self.open = True
        self.calls, self.goals = Calls(self), Goals(self)
        self.ends: list[OwnEnd] = []  # all that were made, ROS's own included
        self._names: dict[int, str] = {}  # id of a node -> its fully qualified name
        self._printed = self._bytes = self._all = 0
        self._known: list[BaseException] = []
        self._instant, self._messages = -1, 0  # the last publish's time, and how many there were then

    @property
    def now(self) -> float:
        """Simulated seconds since the start of the run."""
        return self.scheduler.now / SECOND

    def name_of(self, node: Any) -> str:
        """Fully qualified name of a node, or of the current process for None."""
        if node is not None:
            return self._names.get(id(node)) or node.get_fully_qualified_name()
        fiber = self.scheduler.current
        nodes = fiber.process.nodes if fiber is not None else []
        return self.name_of(nodes[0]) if nodes else f"/{fiber.process.name}" if fiber is not None else ""

    def node(self, node: Any) -> None:
        """A node was made."""
        name = self._names[id(node)] = node.get_fully_qualified_name()
        if self.open:
            self.recording.graph.nodes.append(name)

    def endpoint(
        self, kind: str, node: Any, name: str, type_: type, qos: Any = None, *, handle: Any = None
    ) -> None:
        """A node declared one end of a topic, service or action. handle: rclpy's, if it has one."""
        if not self.open:
            return
        of = self.name_of(node)
        if handle is not None:
            self.ends.append(OwnEnd(kind, node.handle, of, name, type_, qos, handle))
        if name not in INFRASTRUCTURE_TOPICS and not is_node_service(name):
            end = Endpoint(kind, of, name, type_name(type_), _qos(qos))
            self.recording.graph.endpoints.append(end)

    def timer(self, node: Any, timer: Any) -> None:
        """A node made a timer."""
        if self.open:
            info = TimerInfo(
                self.name_of(node), timer.timer_period_ns / SECOND, callback_name(timer.callback)
            )
            self.recording.graph.timers.append(info)

    def count(self, sender: str, size: int) -> None:
        """A node sent a message, request or the like, of so many bytes. Raises Livelock for too many."""
        now = self.scheduler.now
        if now != self._instant:
            self._instant, self._messages = now, 0
        self._messages += 1
        if self._messages > MAX_MESSAGES_PER_INSTANT:
            self.scheduler.refuse_to_go_on(
                f"{sender} sent {MAX_MESSAGES_PER_INSTANT} messages at t = {self.now:g} s"
                " without letting time move on"
            )
        self._all += 1
        if self._all > MAX_MESSAGES:
            self.scheduler.refuse_to_go_on(
                f"the nodes sent more than {MAX_MESSAGES} messages by t = {self.now:g} s"
            )
        self._bytes += size
        if self._bytes > MAX_MESSAGE_BYTES:
            self.scheduler.refuse_to_go_on(
                f"the nodes sent more than {MAX_MESSAGE_BYTES / 1e6:g} MB by t = {self.now:g} s"
            )

    def message(self, topic: str, type_: str, sender: str, raw: bytes) -> None:
        """A message was published. Raises Livelock for too many."""
        if not self.open:
            return
        self.count(sender, len(raw))
        self.recording.heard.append(Heard(self.now, topic, type_, sender, canonical(type_, raw)))

    def log(self, severity: int, logger: str, text: str) -> LogLine | None:
        """A node wrote a log line; None if it isn't kept."""
        if not self.open or len(self.recording.logs) >= MAX_LOG_LINES:
            return None
        line = LogLine(self.now, LEVELS.get(int(severity), "INFO"), logger, text)
        self.recording.logs.append(line)
        return line

    def printed(self, text: str) -> None:
        """Student code wrote to stdout."""
        self._printed += len(text)
        if self.open and self._printed < MAX_PRINTED:
            self.recording.prints.append((self.now, text))

    def complained(self, text: str) -> None:
        """Student code, or a library that it called, wrote to stderr."""
        if len(self.recording.stderr) < MAX_PRINTED:
            self.recording.stderr += text

    def callback(self, running: Running) -> None:
        """A callback has returned."""
        if self.open:
            began = running.began / SECOND
            duration = (self.scheduler.now - running.began) / SECOND
            self.recording.callbacks.append(
                CallbackRun(began, duration, running.node, running.name, running.kind)
            )

    def error(self, error: BaseException, callback: str, node: str | None = None) -> None:
        """An exception left a callback, a thread or a main(). The same one is kept once."""
        quiet = not self.open or isinstance(error, (*NO_FAULT, Livelock)) or _is_hang(error)
        if quiet or any(known is error for known in self._known):
            return
        self._known.append(error)
        frames = student_frames(error)
        text = "".join(traceback.format_list(frames) + traceback.format_exception_only(error))
        name = node if node is not None else self.name_of(None)
        self.recording.errors.append(
            CallbackError(self.now, name, callback, type(error).__name__, _text(error), text)
        )

    def close(self) -> None:
        """The run is over: what student code does while it is taken down is not evidence."""
        self.open = False
        self._known.clear()
        self.ends.clear()


def _text(error: BaseException) -> str:
    try:
        return str(error)
    except Exception:  # a student's class may raise here too
        return f"<{type(error).__name__} without text>"


def _is_hang(error: BaseException) -> bool:
    return bool(getattr(error, "stops_the_run", False))


def student_frames(error: BaseException) -> list[traceback.FrameSummary]:
    """The frames of an exception that are the student's own."""
    frames = traceback.extract_tb(error.__traceback__)
    return [frame for frame in frames if not is_library(frame.filename)]


def is_library(filename: str) -> bool:
    """Whether a source file is part of a library, this package or Python, and so not the student's."""
    return filename.startswith(_LIBRARIES)


def _qos(profile: Any) -> dict[str, Any]:
    if profile is None:
        return {}
    names = ("reliability", "durability", "history")
    return {name: getattr(profile, name).name.lower() for name in names} | {"depth": profile.depth}


def destroy(node: Any) -> None:
    """Free a node with all it holds; destroy_node() forgets action servers and clients.

    For that time it is a plain Node: what a student's class has made of rclpy's methods must not run here.
    """
    students_class = type(node)
    with contextlib.suppress(TypeError):  # a class with __slots__ has another layout, and stays what it is
        object.__setattr__(node, "__class__", Node)
    try:
        for waitable in list(node.waitables):
            if isinstance(waitable, ActionServer | ActionClient):
                waitable.destroy()
        node.destroy_node()
    except Exception:
        pass  # destroyed already, its __init__ never came to an end, or a method is a student's after all
    finally:
        object.__setattr__(node, "__class__", students_class)
