"""The action `ExecuteProcess`."""

from __future__ import annotations

import asyncio
import os
import signal
import traceback
from collections.abc import Callable, Iterable
from typing import Any

from launch.actions.opaque_function import OpaqueFunction
from launch.actions.process_details import EnvironmentVariables, expand_process_details
from launch.actions.process_record import ProcessRecord
from launch.actions.signal_escalation import escalate_signals
from launch.event_handler import EventHandler, OnActionEventBase
from launch.events import Shutdown
from launch.events.process import ProcessExited, ProcessIO, ProcessStarted, ShutdownProcess, SignalProcess
from launch.launch_context import LaunchContext
from launch.launch_description_entity import LaunchDescriptionEntity, as_list
from launch.logging import get_logger, output_destinations
from launch.processes import Process
from launch.substitution import SomeSubstitutionsType
from launch.substitutions import LaunchConfiguration
from launch.utilities import normalize_to_list_of_substitutions, text_of, value_of

_SIGTERM = LaunchConfiguration("sigterm_timeout", default=5)
_SIGKILL = LaunchConfiguration("sigkill_timeout", default=5)


class ExecuteProcess(ProcessRecord):
    """Starts a process.

    cmd: the command. prefix: put before it. name: its name in the log. cwd: its working directory. env: its
    whole environment; additional_env: variables added to it. output: "screen", "log" or "both"; "log" shows
    stderr only. cached_output: get_stdout() and get_stderr() return it. on_exit: entities to visit when it
    has exited. respawn: it is restarted whenever it exits, `respawn_delay` seconds later, at most
    `respawn_max_retries` times. On shutdown it gets SIGINT, SIGTERM `sigterm_timeout` seconds later, and
    SIGKILL `sigkill_timeout` seconds after that.
    """

    def __init__(
        self,
        *,
        cmd: Iterable[SomeSubstitutionsType],
        prefix: SomeSubstitutionsType | None = None,
        name: SomeSubstitutionsType | None = None,
        cwd: SomeSubstitutionsType | None = None,
        env: EnvironmentVariables | None = None,
        additional_env: EnvironmentVariables | None = None,
        shell: bool = False,
        sigterm_timeout: SomeSubstitutionsType = _SIGTERM,
        sigkill_timeout: SomeSubstitutionsType = _SIGKILL,
        emulate_tty: bool = False,
        output: Any = "log",
        output_format: str = "[{this.process_description.final_name}] {line}",
        cached_output: bool = False,
        log_cmd: bool = False,
        on_exit: Any = None,
        respawn: bool | SomeSubstitutionsType = False,
        respawn_delay: float | None = None,
        respawn_max_retries: int = -1,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self._cache_output(cached_output)
        self.__cmd = [normalize_to_list_of_substitutions(word) for word in cmd]
        self.__prefix, self.__name, self.cwd = prefix, name, cwd
        self.env, self.additional_env = env, additional_env
        self.shell, self.__log_cmd = shell, log_cmd  # emulate_tty is ignored
        self.__timeouts = sigterm_timeout, sigkill_timeout
        self.output = os.environ.get("OVERRIDE_LAUNCH_PROCESS_OUTPUT", output)
        self.__format = output_format
        self.__on_exit, self.__respawn = on_exit, respawn
        self.__respawn_delay, self.__respawn_max_retries = respawn_delay, respawn_max_retries
        self.__process: Process | None = None
        self.__completed: asyncio.Future | None = None
        self.__shutdown: asyncio.Future | None = None
        self.__escalation: asyncio.Task | None = None

    @property
    def name(self) -> Any:
        """The name in the log."""
        return self.final_name or self.__name

    @property
    def cmd(self) -> list:
        """The command."""
        return self.final_cmd or self.__cmd

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Work like `Action`."""
        return [] if callable(self.__on_exit) else as_list(self.__on_exit)

    def get_asyncio_future(self) -> asyncio.Future | None:
        """Work like `LaunchDescriptionEntity`."""
        return self.__completed

    # -- execution -----------------------------------------------------------------------------------

    def execute(self, context: LaunchContext) -> None:
        """Work like `Action`. Raises RuntimeError the second time."""
        if self.__completed is not None:
            raise RuntimeError(
                f"ExecuteLocal action '{self.final_name}': executed more than once: {self.describe()}"
            )
        self.__prepare(context)
        if context.is_shutdown:
            return
        self.__completed = context.asyncio_loop.create_future()
        self.__shutdown = context.asyncio_loop.create_future()
        _register(context, ShutdownProcess, self.__on_shutdown_process)
        _register(context, SignalProcess, self.__on_signal_process)
        _register(context, Shutdown, self.__on_shutdown)
        if self.__on_exit is not None:
            context.register_event_handler(
                OnActionEventBase(
                    action_matcher=self,
                    on_event=self.__on_exit,
                    target_event_cls=ProcessExited,
                    target_action_cls=ExecuteProcess,
                )
            )
        self.__task = context.asyncio_loop.create_task(self.__run(context))

    def __prepare(self, context: LaunchContext) -> None:
        self._details = {"action": self} | expand_process_details(
            context, self.__cmd, self.__prefix, self.__name, self.cwd, self.env, self.additional_env
        )
        self.__respawn = value_of(context, self.__respawn, bool)
        output = self.output if isinstance(self.output, dict) else text_of(context, self.output)
        self.__destinations = output_destinations(output)
        self.__logger = get_logger(self.final_name)

    async def __run(self, context: LaunchContext) -> None:
        try:
            retries = 0
            while await self.__run_once(context):
                exhausted = 0 <= self.__respawn_max_retries <= retries
                if context.is_shutdown or self.__shutdown.done() or not self.__respawn or exhausted:
                    break
                retries += 1
                if self.__respawn_delay:
                    await asyncio.wait((self.__shutdown,), timeout=self.__respawn_delay)
                if self.__shutdown.done():
                    break
        finally:
            if self.__escalation is not None:
                self.__escalation.cancel()
            if not self.__completed.done():
                self.__completed.set_result(None)

    async def __run_once(self, context: LaunchContext) -> bool:
        """Start the process and wait until it has exited. Returns False if it could not be started."""
        details = self._details
        cmd = " ".join(word for word in details["cmd"] if word.strip())
        if self.__log_cmd:
            self.__logger.info(f"process details: cmd='{cmd}', cwd='{details['cwd']}', custom_env?=True")
        try:
            process = await context.process_starter.start(
                *(details["cmd"], details["cwd"], details["env"], self.shell),
                lambda stream, line: self.__on_output(context, stream, line),
            )
        except Exception as error:
            self.__logger.error(f"exception occurred while executing process: {error}")
            self.__logger.debug(traceback.format_exc())  # upstream logs it at any level
            return False
        self.__process, details["pid"] = process, process.pid
        self.__logger.info(f"process started with pid [{process.pid}]")
        context.emit_event_sync(ProcessStarted(**details))
        status = await process.wait()
        self.__process, self._return_code = None, status
        if status == 0:
            self.__logger.info(f"process has finished cleanly [pid {process.pid}]")
        else:
            self.__logger.error(f"process has died [pid {process.pid}, exit code {status}, cmd '{cmd}'].")
        context.emit_event_sync(ProcessExited(returncode=status, **details))
        return True

    def __on_output(self, context: LaunchContext, stream: str, line: str) -> None:
        self._add_output(stream, line)
        fd = ("stdin", "stdout", "stderr").index(stream)
        context.emit_event_sync(ProcessIO(text=f"{line}\n".encode(), fd=fd, **self._details))
        for write in self.__destinations[stream]:
            write(self.__format.format(line=line, this=self))

    # -- shutdown ------------------------------------------------------------------------------------

    def __on_shutdown_process(self, event: ShutdownProcess, context: LaunchContext) -> None:
        if event.process_matcher(self):
            self.__shut_down(context, send_sigint=True)

    def __on_shutdown(self, event: Shutdown, context: LaunchContext) -> None:
        self.__shut_down(context, send_sigint=not event.due_to_sigint or context.noninteractive)

    def __on_signal_process(self, event: SignalProcess, context: LaunchContext) -> None:
        if event.process_matcher(self):
            self.__send_signal(event.signal)

    def __shut_down(self, context: LaunchContext, *, send_sigint: bool) -> None:
        if self.__shutdown.done():
            return
        self.__shutdown.set_result(None)
        if not self.__completed.done():
            texts = [text_of(context, timeout) for timeout in self.__timeouts]
            delays = [float(text) for text in texts]
            termination = self.__terminate(send_sigint, delays, elapsed=[texts[0], str(sum(delays))])
            self.__escalation = context.asyncio_loop.create_task(termination)

    async def __terminate(self, send_sigint: bool, delays: list[float], elapsed: list[str]) -> None:
        while self.__process is None:  # it is being started
            await asyncio.sleep(0)
        if send_sigint:
            self.__send_signal(signal.SIGINT)
        await escalate_signals(self.__send_signal, self.__logger, self.final_name, delays, elapsed)

    def __send_signal(self, number: signal.Signals) -> None:
        if self.__process is None:
            return
        self.__logger.info(f"sending signal '{number.name}' to process[{self.final_name}]")
        self.__process.send_signal(number)


def _register(context: LaunchContext, kind: type, handle: Callable[[Any, LaunchContext], None]) -> None:
    function = OpaqueFunction(function=lambda context: handle(context.locals.event, context))
    matches = lambda event: isinstance(event, kind)  # noqa: E731
    context.register_event_handler(EventHandler(matcher=matches, entities=function))
