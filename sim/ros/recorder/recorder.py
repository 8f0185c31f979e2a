"""Fills the recording during the run: the hooks report here what programs do."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from typing import Any

import greenlet
from rclpy.executors import ExternalShutdownException

from sim.evidence import (
    BUNDLED,
    CALLS_PUBLISH,
    INFRASTRUCTURE_TOPICS,
    WATCHES,
    BusyLoop,
    CallbackError,
    CallbackRun,
    Crossing,
    Endpoint,
    LogLine,
    Message,
    NodeFact,
    ParameterName,
    Recording,
    TimerInfo,
    UndeliveredMessage,
    is_node_service,
)
from sim.evidence.qos import settings
from sim.nanoseconds import SECOND
from sim.network import LAPTOP
from sim.ros.fibers.exceptions import Hang, Livelock, RunOver
from sim.ros.fibers.fiber import Fiber
from sim.ros.fibers.scheduler import Scheduler
from sim.ros.messages.codec import type_name
from sim.ros.recorder.action_goals import Goals
from sim.ros.recorder.base import RecorderBase
from sim.ros.recorder.calls import Calls
from sim.ros.recorder.expected_errors import is_expected
from sim.ros.recorder.publish_calls import calls_publish
from sim.ros.recorder.records import DeclaredEndpoint
from sim.ros.recorder.running import RunningCallback, callback_name
from sim.ros.recorder.tracebacks import is_raised_by_student, student_traceback, text_of

CLOCK = "/clock"
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
    Livelock,
    Hang,
)


class Recorder(RecorderBase):
    """Writes into one recording, until it is closed."""

    def __init__(self, scheduler: Scheduler, recording: Recording) -> None:
        super().__init__(scheduler, recording)
        self.calls, self.goals = Calls(self), Goals(self)
        self.ending = False  # the run is over, and programs end as after Ctrl-C
        self.declared: list[DeclaredEndpoint] = []  # all endpoints, ROS's own included
        self._course_nodes: set[str] = set()  # names
        self._student_nodes: set[str] = set()
        self._printed = 0
        self._known: list[BaseException] = []
        self._undelivered: set[tuple[str, str]] = set()  # nodes and topics
        self._busy: set[tuple[str, str]] = set()  # nodes and callbacks with a loop without a pause
        self._facts: set[tuple[str, str]] = set()  # nodes, and what is known of them

    def node_created(self, node: Any) -> None:
        """A node was created."""
        name = self.node_names[id(node)] = node.get_fully_qualified_name()
        if not self.open:
            return
        fiber = self.scheduler.current
        self.node_named(
            name, from_course=self.is_course_node(), host=LAPTOP if fiber is None else fiber.process.host
        )
        if fiber is not None and fiber.process.bundled:
            self.node_fact(node, BUNDLED)

    def node_named(self, name: str, *, from_course: bool, host: str = LAPTOP) -> None:
        """There is a node of this full name, of a program of the course or of the student."""
        self.recording.graph.nodes.append(name)
        if self.recording.network is not None:
            self.recording.hosts[name] = host
        (self._course_nodes if from_course else self._student_nodes).add(name)
        self.recording.course_nodes = self._course_nodes - self._student_nodes
        self.recording.shared = self._course_nodes & self._student_nodes

    def endpoint(
        self, kind: str, node: Any, name: str, type_: type, qos: Any = None, *, handle: Any = None
    ) -> None:
        """A node created an endpoint of a topic, service or action. handle: rclpy's, if it has one."""
        if not self.open:
            return
        of = self.name_of(node)
        if handle is not None:
            self.declared.append(DeclaredEndpoint(kind, node.handle, of, name, type_, qos, handle))
        if name not in INFRASTRUCTURE_TOPICS and not is_node_service(name):
            chosen = {} if qos is None else settings(qos)
            end = Endpoint(kind, of, name, type_name(type_), chosen, self.is_course_node())
            self.recording.graph.endpoints.append(end)
            if kind == "publisher" and self._is_students() and calls_publish(sys._getframe(1)):
                self.node_fact(node, CALLS_PUBLISH)

        elif kind == "subscription" and name in INFRASTRUCTURE_TOPICS - {CLOCK} and self._is_students():
            self.node_fact(node, WATCHES)

    def _is_students(self) -> bool:
        """Return whether a program of the student's is running in this process."""
        fiber = self.scheduler.current
        return fiber is not None and not fiber.process.from_course

    def node_fact(self, node: Any, fact: str) -> None:
        """Something is known of a node: one of FACTS; recorded once."""
        self.fact(self.name_of(node), fact)

    def fact(self, name: str, fact: str) -> None:
        """Work like `node_fact`, of the node with this full name."""
        if self.open and (name, fact) not in self._facts:
            self._facts.add((name, fact))
            self.recording.node_facts.append(NodeFact(self.now, name, fact))

    def timer_created(self, node: Any, timer: Any) -> None:
        """A node created a timer."""
        if self.open:
            info = TimerInfo(
                self.name_of(node), timer.timer_period_ns / SECOND, callback_name(timer.callback)
            )
            self.recording.graph.timers.append(info)

    def message(
        self, topic: str, type_: str, sender: str, raw: bytes, from_course: bool, early: bool
    ) -> None:
        """A message was published; its bytes are canonical. Raises Livelock for too many."""
        if not self.open:
            return
        self.count(sender, len(raw))
        self.recording.published.append(Message(self.now, topic, type_, sender, raw, from_course, early))

    def log(self, severity: int, logger: str, text: str) -> LogLine | None:
        """A node wrote a log line; None if it isn't recorded."""
        lines = self.recording.end_logs if self.ending else self.recording.logs
        if not (self.open or self.ending) or len(lines) >= MAX_LOG_LINES:
            return None
        line = LogLine(self.now, LEVELS.get(int(severity), "INFO"), logger, text, self.is_course_node())
        lines.append(line)
        return line

    def add_stdout(self, text: str) -> None:
        """Student code wrote to stdout."""
        self._printed += len(text)
        if self._printed < MAX_PRINTED and (self.open or self.ending):
            (self.recording.end_prints if self.ending else self.recording.prints).append((self.now, text))

    def add_stderr(self, text: str) -> None:
        """Student code, or a library that it called, wrote to stderr."""
        if len(self.recording.stderr) < MAX_PRINTED:
            self.recording.stderr += text

    def callback_returned(self, running: RunningCallback) -> None:
        """A callback has returned."""
        if self.open:
            began = running.began / SECOND
            duration = (self.scheduler.now - running.began) / SECOND
            self.recording.callbacks.append(
                CallbackRun(began, duration, running.node, running.name, running.kind)
            )

    def error(self, error: BaseException, callback: str, node: str | None = None) -> None:
        """An exception left a callback, a thread or a main(). The same one is recorded once.

        One that a callback raises to end `spin()`, and that is caught there by its name, is not recorded.
        """
        fiber = self.scheduler.current
        main = None if fiber is None else fiber.process.main
        spins = None if main is None else main.greenlet.gr_frame  # of another thread, as of a pool's
        if not isinstance(error, NO_FAULT) and not is_expected(error, sys._getframe(1), spins):
            self._record(error, callback, node)

    def end_error(self, error: BaseException, program: str, *, has_main: bool) -> None:
        """An exception left a program after the Ctrl-C at the end, or its main() for a Ctrl-C of its own."""
        own = has_main and isinstance(error, KeyboardInterrupt) and is_raised_by_student(error)
        if own or (self.ending and not isinstance(error, NO_FAULT)):
            self.recording.end_errors.append(self._row(error, program, None))

    def undelivered(self, sender: str, topic: str) -> None:
        """A message was sent before a subscription was discovered; recorded once for a node and topic."""
        if (sender, topic) not in self._undelivered:
            self._undelivered.add((sender, topic))
            if self.open and topic not in INFRASTRUCTURE_TOPICS:
                self.recording.undelivered.append(UndeliveredMessage(self.now, sender, topic))

    def parameters(self, node: Any, names: Iterable[str], *, declared: bool) -> None:
        """A node was given these parameters as it started, or declares them."""
        if self.open:
            of = self.name_of(node)
            self.recording.parameters += [ParameterName(self.now, of, name, declared) for name in names]

    def crossing(self, topic: str, sender: str, listener: str) -> Crossing:
        """The counts of what happens to messages on the network from this node to that one."""
        row = Crossing(topic, sender, listener)
        if self.open and topic not in INFRASTRUCTURE_TOPICS:
            self.recording.crossings.append(row)
        return row

    def busy_loop(self, fiber: Fiber, line: str) -> None:
        """A fiber loops without a pause; recorded once. line: where, as the end of a sentence."""
        if not self.open or fiber.process.from_course:
            return
        running = fiber.callbacks[-1] if fiber.callbacks else None
        node, what = (running.node, running.name) if running else (self.name_of(None), f"{fiber.name}()")
        if (node, what) not in self._busy:
            self._busy.add((node, what))
            self.recording.busy_loops.append(BusyLoop(self.now, node, f"{what}{line}"))

    def program_exited(self, exit_: SystemExit, program: str) -> None:
        """A program ended itself; as for a shell, every status except 0 is a failure."""
        if exit_.code:
            self._record(exit_, program, None)

    def _record(self, error: BaseException, callback: str, node: str | None) -> None:
        if not self.open or any(known is error for known in self._known):
            return
        self._known.append(error)
        row = self._row(error, callback, node)
        self.recording.errors.append(row)
        if self.is_course_node():
            self.recording.course_errors.append(row)

    def _row(self, error: BaseException, callback: str, node: str | None) -> CallbackError:
        name = node if node is not None else self.name_of(None)
        text, traceback = text_of(error), student_traceback(error)
        return CallbackError(self.now, name, callback, type(error).__name__, text, traceback)

    def close(self) -> None:
        """The run is over: only what programs still print, log and raise is kept, and is no evidence."""
        self.open, self.ending = False, True
        self._known.clear()
        self.declared.clear()
