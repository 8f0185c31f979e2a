"""Student processes: on a robot each `main()` is a program of its own, with its own rclpy.init() and ok().

In a run they share one thread and one real rcl context, because two contexts of one process don't hear each
other.
What each of them must have for itself is its default context and its global executor: those are swapped in
whenever one of its fibers runs, so that rclpy's own functions need no change.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import rclpy
import rclpy.utilities
from rclpy.context import Context
from rclpy.exceptions import NotInitializedException
from rclpy.node import Node

if TYPE_CHECKING:
    from sim.ros.engine import Engine
    from sim.ros.fibers import Fiber


@dataclass(frozen=True)
class Process:
    """One program to run, with the settings a launch file would give it. The names are launch_ros's.

    target: a Node class, a callable that returns a Node or a Process, or a main() function.
    remappings: pairs (from, to). parameters: name to value, or a list of such, as in a launch file.
    arguments: further command-line words.
    """

    target: Callable[..., Any]
    name: str | None = None
    namespace: str | None = None
    remappings: Sequence[tuple[str, str]] = ()
    parameters: Mapping[str, Any] | Sequence[Mapping[str, Any]] = field(default_factory=dict)
    arguments: Sequence[str] = ()

    def ros_arguments(self) -> list[str]:
        """The words after `--ros-args` that say the same."""
        rules = [("__node", self.name)] if self.name else []
        rules += [("__ns", self.namespace)] if self.namespace else []
        words = [word for left, right in (*rules, *self.remappings) for word in ("-r", f"{left}:={right}")]
        for group in [self.parameters] if isinstance(self.parameters, Mapping) else self.parameters:
            for name, value in group.items():
                words += ["-p", f"{name}:={_yaml(value)}"]
        return words + [word for word in self.arguments if word != "--ros-args"]


def _yaml(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(value, Iterable):
        return "[" + ", ".join(_yaml(item) for item in value) + "]"
    return repr(value)


def as_process(target: Any, caller: str = "run") -> Process:
    """Accept what `run` and `play` accept. Raises TypeError with a sentence for the student."""
    process = target if isinstance(target, Process) else Process(target)
    inner = process.target
    if isinstance(inner, Node):
        name = type(inner).__name__
        raise TypeError(
            f"{caller}() takes the class, not an object of it: "
            f"write {caller}({name}), not {caller}({name}())."
        )
    if isinstance(inner, type) and not issubclass(inner, Node):
        raise TypeError(f"{inner.__name__} is not a ROS node: write `class {inner.__name__}(Node):`.")
    if not callable(inner):
        raise TypeError(
            f"{caller}() takes Node classes, functions that return a node, or main() functions;"
            f" this is {inner!r}."
        )
    return process


def program_name(target: Any) -> str:
    """What a class or function is called, however a student's class answers that question."""
    try:
        return str(getattr(target, "__name__", None) or type(target).__name__)
    except Exception:
        return "program"


class SharedContext:
    """Stands where rclpy keeps its handle to a context; one per init(), over the run's one real context."""

    def __init__(self, process: StudentProcess, arguments: Sequence[str]) -> None:
        self.process, self.alive = process, True
        if process.borrowed_init is None:
            process.borrowed_init = False
        words = list(arguments)
        if "--ros-args" in words:
            process.global_arguments = words[words.index("--ros-args") + 1 :]

    def ok(self) -> bool:
        """As rcl's context."""
        return self.alive

    def shutdown(self) -> None:
        """As rcl's context, for this process alone."""
        self.alive = False
        self.process.engine.activity += 1

    def get_domain_id(self) -> int:
        """As rcl's context."""
        return self.process.engine.context.get_domain_id()

    def destroy_when_not_in_use(self) -> None:
        """As rcl's context, for this process alone."""
        self.alive = False

    def __enter__(self) -> SharedContext:
        return self

    def __exit__(self, *exception: object) -> None:
        return None


def shared_context(context: Context) -> SharedContext:
    """What a context that was initialised in a run holds in place of rcl's handle."""
    return context._Context__context


class StudentProcess:
    """The state of one program in a run."""

    loaded: StudentProcess | None = None  # whose default context rclpy sees at the moment

    def __init__(self, engine: Engine, spec: Process) -> None:
        self.engine = engine
        self._become(spec)
        self.context: Context | None = None
        self.executor: Any = None
        self.nodes: list[Node] = []
        # None: a function that has not called rclpy.init() yet; True: init() was lent to it; False: settled
        self.borrowed_init: bool | None = False
        self.main: Fiber | None = None

    def _become(self, spec: Process) -> None:
        self.spec, self.target, self.name = spec, spec.target, program_name(spec.target)
        self.global_arguments: list[str] = []

    def _read_settings(self) -> None:
        """Done as the program starts, so that what is wrong in them is the program's error."""
        self.global_arguments = self.spec.ros_arguments()
        self.argv = [self.name, "--ros-args", *self.global_arguments]

    def load(self) -> None:
        """Let rclpy's module-level state be this process's."""
        if StudentProcess.loaded is self:
            return
        if StudentProcess.loaded is not None:
            StudentProcess.loaded.unload()
        rclpy.utilities.g_default_context = self.context
        rclpy.__dict__["__executor"] = self.executor
        StudentProcess.loaded = self

    def unload(self) -> None:
        """Keep what rclpy's module-level state is now."""
        self.context = rclpy.utilities.g_default_context
        self.executor = rclpy.__dict__["__executor"]
        StudentProcess.loaded = None

    def run(self) -> None:
        """The body of the process's first fiber: what `python3 node.py` would do."""
        self._read_settings()
        target = self.target
        if isinstance(target, type):
            rclpy.init(args=self.argv)
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
            self.run()
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

    def lend_init(self) -> None:
        """Let a function that only makes a node do so without calling rclpy.init() itself."""
        if self.borrowed_init is None:
            self.borrowed_init = True
            rclpy.init(args=self.argv)

    def check_init(self) -> None:
        """Give a main() that forgot rclpy.init() what it would get on a robot, NotInitializedException."""
        if self.borrowed_init:
            raise NotInitializedException("cannot create node")
