"""The programs of a run: on a robot each `main()` is a process, with its own rclpy.init() and ok().

In a run they share one thread and one real rcl context, because two contexts of one process don't discover
each other. What each of them must have for itself is its default context and its global executor: those are
swapped in whenever one of its fibers runs, so that rclpy's own functions need no change.
"""

from __future__ import annotations

import contextlib
import inspect
import sys
from collections import Counter
from collections.abc import Callable, Sequence
from inspect import getattr_static
from itertools import count, pairwise
from typing import Any

import rclpy
import rclpy.utilities
from rclpy.action import ActionClient, ActionServer
from rclpy.context import Context
from rclpy.exceptions import NotInitializedException
from rclpy.logging import LoggingSeverity, set_logger_level
from rclpy.node import Node

from sim.network import LAPTOP, ROBOT
from sim.ros.engine.keyboard import keyboard
from sim.ros.engine.process_state import RclpyState
from sim.ros.engine.program import Process, as_process, program_name
from sim.ros.fibers.fiber import Fiber
from sim.ros.fibers.scheduler import Scheduler
from sim.ros.messages.lenient import lenient_fields
from sim.ros.rclpy_cpp import cpp


class SharedContext:
    """Replaces rclpy's handle to a context; one per init(), over the run's one real context."""

    def __init__(self, process: RunningProgram, arguments: Sequence[str]) -> None:
        self.process, self.alive = process, True
        process.contexts.append(self)
        if process.borrowed_init is None:
            process.borrowed_init = False
        words = list(arguments)
        cpp.rclpy_remove_ros_args(words)  # refuses what ROS can't read
        process.global_arguments = words[words.index("--ros-args") :] if "--ros-args" in words else []
        process.set_log_levels()

    def ok(self) -> bool:
        """Work like rcl's context."""
        return self.alive

    def shutdown(self) -> None:
        """Work like rcl's context, for this process alone."""
        if not self.alive:
            raise cpp.RCLError("failed to shutdown: rcl_shutdown already called on the given context")
        self.alive = False
        self.process.scheduler.wake_all()

    def get_domain_id(self) -> int:
        """Work like rcl's context."""
        return self.process.rclpy.context.get_domain_id()

    def destroy_when_not_in_use(self) -> None:
        """Work like rcl's context, for this process alone."""
        self.alive = False

    def __enter__(self) -> SharedContext:
        return self

    def __exit__(self, *exception: object) -> None:
        return None


def shared_context(context: Context) -> SharedContext:
    """Return what a context that was initialized in a run has in place of rcl's handle."""
    return context._Context__context  # type: ignore[attr-defined]


class RunningProgram:
    """One program in a run, with its state.

    rclpy: the state of rclpy that all programs of the run share. from_course: it is the course's, not the
    student's. number: among the programs of its kind.
    """

    loaded: RunningProgram | None = None  # whose state is the module-level one at the moment

    def __init__(
        self, scheduler: Scheduler, rclpy: RclpyState, spec: Process, from_course: bool, number: int
    ) -> None:
        self.scheduler, self.rclpy, self.from_course = scheduler, rclpy, from_course
        self._become(spec)
        self.number = number
        self.key, self.fibers_started, self.fibers_alive = f"{self.name} {number}", 0, 0  # as in `Program`
        self.visits: Counter[tuple[str, int]] = Counter()
        self.context: Context | None = None
        self.executor: Any = None
        self.nodes: list[Node] = []
        self.steps = 0  # as in `Program`
        self.reader: Callable[[str, str], Any] | None = None  # called with "stdout" or "stderr", and text
        self.ended: Callable[[], None] = lambda: None  # called at its end, even if it never began
        # None: a function that has not called rclpy.init() yet; True: init() was lent to it; False: settled
        self.borrowed_init: bool | None = False
        self.main: Fiber | None = None
        self.contexts: list[SharedContext] = []  # of each init()
        self.handles_interrupt = False  # rclpy's own handler of SIGINT is installed
        self.log_level: int | None = None
        self.thread_numbers, self.pool_numbers = count(1), count()  # for names, as Python counts them

    def _become(self, spec: Process) -> None:
        self.spec, self.target, self.name = spec, spec.target, program_name(spec.target)
        self.bundled = getattr_static(spec.target, "bundled", False) is True  # see `bundled_programs`
        self.host = spec.host or (ROBOT if self.from_course else LAPTOP)
        self.global_arguments: list[str] = []  # those of init() that are ROS's
        self.argv, self.stdin = [self.name], keyboard(self.spec.stdin)

    def _read_settings(self) -> None:
        """Done as the program starts, so that a mistake in them is the program's error."""
        sys.argv, sys.stdin = [self.name, *self.spec.command_line()], self.stdin

    def set_log_levels(self) -> None:
        """Follow each `--log-level LEVEL` or `--log-level LOGGER:=LEVEL` of the arguments."""
        for word, value in pairwise(self.global_arguments):
            if word == "--log-level":
                logger, _, level = value.rpartition(":=")
                severity = LoggingSeverity[level.upper()]
                if logger:
                    set_logger_level(logger, severity)
                else:
                    self.log_level = severity
        self.rclpy.set_default_level(self.log_level)

    def load(self) -> None:
        """Make this program's state the module-level state of rclpy and `sys`."""
        if RunningProgram.loaded is self:
            return
        if RunningProgram.loaded is not None:
            RunningProgram.loaded.unload()
        rclpy.utilities.g_default_context = self.context
        rclpy.__dict__["__executor"] = self.executor
        self.rclpy.set_default_level(self.log_level)
        sys.argv, sys.stdin = self.argv, self.stdin
        RunningProgram.loaded = self

    def unload(self) -> None:
        """Store what that state is now."""
        self.context = rclpy.utilities.g_default_context
        self.executor = rclpy.__dict__["__executor"]
        self.argv, self.stdin = sys.argv, sys.stdin
        RunningProgram.loaded = None

    def run(self) -> None:
        """The body of the program's first fiber: what `python3 node.py` would do."""
        try:
            self._wait_for_start()
            with lenient_fields() if self.spec.lenient else contextlib.nullcontext():
                self._run()
        finally:
            self.ended()

    def _wait_for_start(self) -> None:
        """In another order than the usual one, a program may start later, unless another process has it."""
        scheduler = self.scheduler
        here = not (self.from_course or getattr_static(self.target, "runs_elsewhere", False) is True)
        if scheduler.choices is not None and here:
            delay = scheduler.choices.start_delay(self)
            if delay:
                scheduler.wait("the start", until=scheduler.now + delay)
                if scheduler.choices is not None:  # the run is not over
                    scheduler.choices.started_late(self)

    def _run(self) -> None:
        self._read_settings()
        target = self.target
        if isinstance(target, type):
            rclpy.init()
            self._spin(target())
            return
        # A function may be a main() or make a node: init() is lent until that is known.
        self.borrowed_init = None
        try:
            result = target(**self._main_arguments(target))
        except RuntimeError:
            self.check_init()
            raise
        if inspect.iscoroutine(result):
            result.close()
            raise TypeError(
                f"{self.name} is an `async def`, which nothing here awaits: write `def {self.name}(...):`."
            )
        if isinstance(result, Process):
            self._become(as_process(result))
            self._run()
        elif isinstance(result, Node):
            self.borrowed_init = False
            self._spin(result)
        self.check_init()

    def _main_arguments(self, target: Callable[..., Any]) -> dict[str, Any]:
        try:
            parameters = inspect.signature(target).parameters
        except (TypeError, ValueError):
            return {}
        return {"args": None} if "args" in parameters else {}

    def _spin(self, node: Node) -> None:
        rclpy.spin(node)
        node.destroy_node()
        rclpy.try_shutdown()

    def shut_down(self) -> None:
        """Do what rclpy's handler of SIGINT does before Python's own one raises KeyboardInterrupt.

        As there, no callback of `Context.on_shutdown` is called.
        """
        if self.handles_interrupt:
            for context in self.contexts:
                context.alive = False

    def lend_init(self) -> None:
        """Let a function that only makes a node do so without calling rclpy.init() itself."""
        if self.borrowed_init is None:
            self.borrowed_init = True
            rclpy.init()

    def check_init(self) -> None:
        """Give a main() that forgot rclpy.init() what it would get on a robot, NotInitializedException."""
        if self.borrowed_init:
            raise NotInitializedException("cannot create node")


def destroy(node: Any) -> None:
    """Destroy a node with all its entities; destroy_node() leaves out action servers and clients.

    For that time it is a plain Node: rclpy's methods as a student's class overrides them must not run here.
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
