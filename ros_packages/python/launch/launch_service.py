"""Executes launch descriptions: visits their entities and passes events to event handlers."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import signal
import threading
import traceback
from collections.abc import Iterable
from typing import Any

from launch.event import Event
from launch.event_handler import BaseEventHandler
from launch.event_handlers import OnShutdown
from launch.events import IncludeLaunchDescription, Shutdown
from launch.launch_context import LaunchContext
from launch.launch_description import LaunchDescription
from launch.launch_description_entity import LaunchDescriptionEntity, as_list
from launch.located import add_place
from launch.logging import get_logger, launch_config, log_launch_config, redirect_log


class _OnInclude(BaseEventHandler):
    def __init__(self) -> None:
        super().__init__(matcher=lambda event: isinstance(event, IncludeLaunchDescription))

    def handle(self, event: Event, context: LaunchContext) -> LaunchDescription:
        super().handle(event, context)
        return event.launch_description


def _place_of(entity: LaunchDescriptionEntity, error: Exception) -> str | None:
    """Return where an entity is in a launch file; for Python, from tracebacks, but not for missing values."""
    place = getattr(entity, "place", None)
    if place is None and str(error).startswith("launch configuration"):
        place = getattr(entity, "place_in_python", None)
    return place


class LaunchService:
    """Executes launch descriptions until everything that was launched is complete."""

    def __init__(
        self, *, argv: Iterable[str] | None = None, noninteractive: bool = False, debug: bool = False
    ) -> None:
        launch_config.level = logging.DEBUG if debug else logging.INFO
        self.__logger = get_logger("launch")
        self.__context = LaunchContext(argv=argv, noninteractive=noninteractive)
        self.__context.register_event_handler(_OnInclude())
        self.__context.register_event_handler(OnShutdown(on_shutdown=self.__on_shutdown))
        self.__futures: set[asyncio.Future] = set()
        self.__shutting_down = self.__interrupted = False
        self.failure: Exception | None = None  # the first error
        self.__loop: asyncio.AbstractEventLoop | None = None
        self.__task: asyncio.Task | None = None

    @property
    def context(self) -> LaunchContext:
        """The context of the launch files."""
        return self.__context

    @property
    def event_loop(self) -> asyncio.AbstractEventLoop | None:
        """The event loop, while the service is running."""
        return self.__loop

    @property
    def task(self) -> asyncio.Task | None:
        """The task, while the service is running."""
        return self.__task

    def emit_event(self, event: Event) -> None:
        """Queue an event. May be called from any thread."""
        if self.__loop is None:
            self.__context.emit_event_sync(event)
        else:
            self.__loop.call_soon_threadsafe(self.__context.emit_event_sync, event)

    def include_launch_description(self, launch_description: LaunchDescription) -> None:
        """Execute another description."""
        self.emit_event(IncludeLaunchDescription(launch_description))

    def shutdown(self, force_sync: bool = False) -> None:
        """Shut down everything that was launched. May be called from any thread."""
        if self.__loop is not None:
            self.__loop.call_soon_threadsafe(self._shutdown, "LaunchService.shutdown() called")

    def run(self, *, shutdown_when_idle: bool = True) -> int:
        """Execute the descriptions. Returns 0, or 1 after an error.

        In the main thread, Ctrl-C shuts the processes down as in `ros2 launch`.
        """
        with asyncio.Runner() as runner:
            loop = runner.get_loop()
            if threading.current_thread() is threading.main_thread():
                loop.add_signal_handler(signal.SIGINT, self._on_sigint)
                for number in (signal.SIGTERM, signal.SIGQUIT):
                    loop.add_signal_handler(number, self._on_sigterm, number)
            return runner.run(self.run_async(shutdown_when_idle=shutdown_when_idle))

    async def run_async(self, *, shutdown_when_idle: bool = True) -> int:
        """Work like `run`, in the running event loop and without signal handlers."""
        write = self.__context.process_starter.write_log
        with contextlib.nullcontext() if write is None else redirect_log(write):
            return await self.__execute(shutdown_when_idle)

    async def __execute(self, shutdown_when_idle: bool) -> int:
        context, status = self.__context, 0
        self.__task, self.__loop = asyncio.current_task(), asyncio.get_running_loop()
        context.asyncio_loop = self.__loop
        log_launch_config(logger=self.__logger)
        try:
            while True:
                try:
                    if context._events:
                        self._process(context._events.popleft())
                    elif self.__futures or not (self.__shutting_down or shutdown_when_idle):
                        context._wake.clear()
                        await context._wake.wait()
                    elif self.__shutting_down:
                        return status
                    else:
                        self._shutdown("idle")
                except asyncio.CancelledError:
                    self.__logger.error("run task was canceled")
                    return 1
                except Exception as error:
                    text = f"Caught exception in launch (see debug for traceback): {error}"
                    self.__logger.debug(traceback.format_exc())
                    self.__logger.error(text)
                    self._shutdown(text)
                    self.failure, status = self.failure or error, 1
        finally:
            context._at_end.close()
            self.__loop = self.__task = context.asyncio_loop = None

    def _process(self, event: Event) -> None:
        context = self.__context
        for handler in tuple(context._handlers):
            if not handler.matches(event):
                continue
            context._push_locals()
            try:
                for entity in as_list(handler.handle(event, context)):
                    if entity is not None:
                        self._visit(entity)
            finally:
                context._pop_locals()

    def _visit(self, entity: Any) -> None:
        if not isinstance(entity, LaunchDescriptionEntity):
            raise RuntimeError(f"expected a LaunchDescriptionEntity from event_handler, got '{entity}'")
        try:
            inner = entity.visit(self.__context)
        except Exception as error:
            add_place(error, _place_of(entity, error))
            raise
        future = entity.get_asyncio_future()
        if future is not None and not future.done() and future not in self.__futures:
            self.__futures.add(future)
            future.add_done_callback(self._is_done)
        for each in as_list(inner):
            self._visit(each)

    def _is_done(self, future: asyncio.Future) -> None:
        self.__futures.discard(future)
        self.__context._wake.set()

    def _shutdown(self, reason: str, *, due_to_sigint: bool = False) -> None:
        if not self.__shutting_down:
            self.__context.emit_event_sync(Shutdown(reason=reason, due_to_sigint=due_to_sigint))
        self.__shutting_down = self.__context.is_shutdown = True

    def __on_shutdown(self, event: Event, context: LaunchContext) -> None:
        self.__shutting_down = context.is_shutdown = True

    def _on_sigint(self) -> None:
        text = "user interrupted with ctrl-c (SIGINT)"
        if self.__interrupted:
            self.__logger.warning(f"{text} again, ignoring...")
            return
        self.__interrupted = True
        self.__logger.warning(text)
        self._shutdown("ctrl-c (SIGINT)", due_to_sigint=True)

    def _on_sigterm(self, number: int) -> None:
        name = signal.Signals(number).name
        self.__logger.error(f"user interrupted with ctrl-\\ ({name}), terminating...")
        self.__logger.error(f"using {name} can result in orphaned processes")
        self.__logger.error("make sure no processes launched are still running")
        self.__task.cancel()
