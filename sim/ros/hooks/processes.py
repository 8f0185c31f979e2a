"""The programs of a run: each has its own rclpy.init(), ok() and shutdown(), over one real context."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import rclpy
from rclpy.context import Context
from rclpy.lifecycle import LifecycleNodeMixin
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

from sim.ros.engine.running_program import SharedContext
from sim.ros.fibers.scheduler import engine
from sim.ros.hooks.table import hook
from sim.ros.parameter_sources import competing_values
from sim.ros.rclpy_cpp import cpp


@hook(cpp, "Context", "two real contexts of one process would not discover each other")
def make_context(original: Callable) -> Callable:
    def make(arguments: Sequence[str], domain_id: int) -> Any:
        run = engine()
        if run is None:
            return original(arguments, domain_id)
        if domain_id not in (0, cpp.RCL_DEFAULT_DOMAIN_ID):
            raise ValueError(
                "All programs of a run share one ROS domain and receive each other's messages: "
                f"leave out domain_id={domain_id}."
            )
        return SharedContext(run.current.process, arguments)

    return make


@hook(Context, "handle", "rclpy's C++ code needs the real context")
def context_handle(original: property) -> property:
    def handle(self: Context) -> Any:
        own = original.fget(self)
        return own.process.rclpy.context.handle if isinstance(own, SharedContext) else own

    return property(handle, doc=original.__doc__)


@hook(rclpy, "ok", "`while rclpy.ok():` without a wait must take time, as on a robot")
def ok(original: Callable) -> Callable:
    def ok(**keywords: Any) -> bool:
        run = engine()
        if run is not None:
            run.count_call("looks at a clock")
        return original(**keywords)

    return ok


@hook(rclpy, "install_signal_handlers", "at its end, a run does what rclpy's handler does on Ctrl-C")
def install_signal_handlers(original: Callable) -> Callable:
    def install_signal_handlers(options: SignalHandlerOptions = SignalHandlerOptions.ALL) -> None:
        run = engine()
        if run is None:
            return original(options)
        if options in (SignalHandlerOptions.ALL, SignalHandlerOptions.SIGINT):
            run.current.process.handles_interrupt = True
        return None

    return install_signal_handlers


@hook(rclpy, "uninstall_signal_handlers", "as for their installation")
def uninstall_signal_handlers(original: Callable) -> Callable:
    def uninstall_signal_handlers() -> None:
        run = engine()
        if run is None:
            return original()
        run.current.process.handles_interrupt = False
        return None

    return uninstall_signal_handlers


@hook(Node, "__init__", "a node gets its program's arguments, and is destroyed when that ends")
def node_init(original: Callable) -> Callable:
    def __init__(self: Node, node_name: str, **keywords: Any) -> None:
        run = engine()
        if run is None:
            return original(self, node_name, **keywords)
        process = run.current.process
        if keywords.get("context") is None and not rclpy.ok():
            process.lend_init()
        if process.global_arguments and keywords.get("use_global_arguments", True):
            # The node's own come first and last: the first remapping wins, and the last parameter.
            own = ["--ros-args", *(keywords.get("cli_args") or ())]
            keywords["cli_args"] = [*own, *process.global_arguments, *own]
        if "--disable-rosout-logs" in process.global_arguments:
            keywords["enable_rosout"] = False
        original(self, node_name, **keywords)
        process.nodes.append(self)
        run.recorder.node_created(self)
        if not self._allow_undeclared_parameters:
            run.recorder.parameters(self, self._parameter_overrides, declared=False)
        if not process.from_course:
            taken = {name: parameter.value for name, parameter in self._parameter_overrides.items()}
            full_name = self.get_fully_qualified_name()
            for level, line in competing_values(process.global_arguments, full_name, taken):
                run.output.log(level, "parameters", line)
        return None

    return __init__


@hook(
    LifecycleNodeMixin,
    "_LifecycleNodeMixin__register_callback",
    "rclpy swallows what the callback of a transition raises; the recording has it",
)
def register_callback(original: Callable) -> Callable:
    def __register_callback(self: LifecycleNodeMixin, state_id: int, callback: Callable) -> bool:
        run = engine()
        return original(self, state_id, callback if run is None else run.callbacks.recorded(callback, self))

    return __register_callback


@hook(cpp, "rclpy_logging_set_logger_level", "a level set in one run must not last until the next")
def set_logger_level(original: Callable) -> Callable:
    def set_level(name: str, level: Any, *more: Any) -> Any:
        run = engine()
        if run is not None:
            run.rclpy.level_is_set(name)
        return original(name, level, *more)

    return set_level
