"""The action that starts a program, looks after it, and ends it."""

from __future__ import annotations

import asyncio
import os
import signal
import traceback
from collections.abc import Callable, Iterable
from typing import Any

from launch.actions.flow import OpaqueFunction
from launch.actions.preparing import Texts, prepared
from launch.entities import Action, EventHandler, LaunchDescriptionEntity, SomeSubstitutionsType, as_list
from launch.event_handlers import OnProcessExit
from launch.events import Shutdown
from launch.events.process import ProcessExited, ProcessIO, ProcessStarted, ShutdownProcess, SignalProcess
from launch.launch_context import LaunchContext
from launch.logging import get_logger, output_destinations
from launch.processes import Started
from launch.substitutions import LaunchConfiguration
from launch.utilities import normalize_to_list_of_substitutions, text_of, value_of

_SIGTERM = LaunchConfiguration("sigterm_timeout", default=5)
_SIGKILL = LaunchConfiguration("sigkill_timeout", default=5)


class ExecuteProcess(Action):
    """Starts a program.

    cmd: its words. prefix: words before these. name: what launch calls it. cwd: its folder. env: its whole
    environment; additional_env: more of it. output: "screen", "log" or "both"; "log" shows stderr only.
    on_exit: entities for when it has ended. respawn: it is started again whenever it ends, `respawn_delay`
    seconds later, `respawn_max_retries` times at most. When all is to end it gets SIGINT, SIGTERM
    `sigterm_timeout` seconds later, and SIGKILL `sigkill_timeout` seconds after that.
    """

    def __init__(
        self,
        *,
        cmd: Iterable[SomeSubstitutionsType],
        prefix: SomeSubstitutionsType | None = None,
        name: SomeSubstitutionsType | None = None,
        cwd: SomeSubstitutionsType | None = None,
        env: Texts | None = None,
        additional_env: Texts | None = None,
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
        if cached_output:
            raise NotImplementedError("launch's cached_output is not supported here: write output='screen'.")
        self.__cmd = [normalize_to_list_of_substitutions(word) for word in cmd]
        self.__prefix, self.__name, self.cwd = prefix, name, cwd
        self.env, self.additional_env = env, additional_env
        self.shell, self.__log_cmd, self.__emulate_tty = shell, log_cmd, emulate_tty
        self.__patience = {"sigterm": sigterm_timeout, "sigkill": sigkill_timeout}
        self.output = os.environ.get("OVERRIDE_LAUNCH_PROCESS_OUTPUT", output)
        self.__format = output_format
        self.__on_exit, self.__respawn = on_exit, respawn
        self.__respawn_delay, self.__respawn_max_retries = respawn_delay, respawn_max_retries
        self.__details: dict[str, Any] | None = None
        self.__process: Started | None = None
        self.__done: asyncio.Future | None = None
        self.__ending: asyncio.Future | None = None
        self.__escalation: asyncio.Task | None = None

    # -- what it is ----------------------------------------------------------------------------------

    @property
    def process_description(self) -> ExecuteProcess:
        """What has `final_name` and `final_cmd`."""
        return self

    @property
    def final_name(self) -> str | None:
        """What launch calls it, with its number; None before it is executed."""
        return None if self.__details is None else self.__details["name"]

    @property
    def final_cmd(self) -> list[str] | None:
        """Its words; None before it is executed."""
        return None if self.__details is None else self.__details["cmd"]

    @property
    def name(self) -> Any:
        """What launch calls it."""
        return self.final_name or self.__name

    @property
    def cmd(self) -> list:
        """Its words."""
        return self.final_cmd or self.__cmd

    @property
    def process_details(self) -> dict[str, Any] | None:
        """Name, words, folder, environment and process id; None before it is executed."""
        return self.__details

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """As `Action`."""
        return [] if callable(self.__on_exit) else as_list(self.__on_exit)

    def get_asyncio_future(self) -> asyncio.Future | None:
        """As `LaunchDescriptionEntity`."""
        return self.__done

    # -- what it does --------------------------------------------------------------------------------

    def execute(self, context: LaunchContext) -> None:
        """As `Action`. Raises RuntimeError the second time."""
        if self.__done is not None:
            raise RuntimeError(
                f"ExecuteLocal action '{self.final_name}': executed more than once: {self.describe()}"
            )
        self.__prepare(context)
        if context.is_shutdown:
            return
        self.__done = context.asyncio_loop.create_future()
        self.__ending = context.asyncio_loop.create_future()
        for kind, handle in (
            (ShutdownProcess, self.__on_shutdown_process),
            (SignalProcess, self.__on_signal_process),
            (Shutdown, self.__on_shutdown),
        ):
            matcher = lambda event, kind=kind: isinstance(event, kind)  # noqa: E731
            context.register_event_handler(
                EventHandler(matcher=matcher, entities=OpaqueFunction(function=_of_event(handle)))
            )
        if self.__on_exit is not None:
            context.register_event_handler(OnProcessExit(target_action=self, on_exit=self.__on_exit))
        self.__task = context.asyncio_loop.create_task(self.__run(context))

    def __prepare(self, context: LaunchContext) -> None:
        self.__details = {"action": self} | prepared(
            context, self.__cmd, self.__prefix, self.__name, self.cwd, self.env, self.additional_env
        )
        self.__respawn = value_of(context, self.__respawn, bool)
        output = self.output if isinstance(self.output, dict) else text_of(context, self.output)
        self.__to = output_destinations(output)
        self.__logger = get_logger(self.final_name)

    async def __run(self, context: LaunchContext) -> None:
        try:
            retries = 0
            while await self.__run_once(context):
                spent = 0 <= self.__respawn_max_retries <= retries
                if context.is_shutdown or self.__ending.done() or not self.__respawn or spent:
                    break
                retries += 1
                if self.__respawn_delay:
                    await asyncio.wait((self.__ending,), timeout=self.__respawn_delay)
                if self.__ending.done():
                    break
        finally:
            if self.__escalation is not None:
                self.__escalation.cancel()
            if not self.__done.done():
                self.__done.set_result(None)

    async def __run_once(self, context: LaunchContext) -> bool:
        """Start the program, and wait for its end; whether it could be started."""
        details = self.__details
        cmd = " ".join(word for word in details["cmd"] if word.strip())
        if self.__log_cmd:
            self.__logger.info(f"process details: cmd='{cmd}', cwd='{details['cwd']}', custom_env?=True")
        try:
            how = (details["cmd"], details["cwd"], details["env"], self.shell)
            process = await context.processes.start(*how, lambda *said: self.__heard(context, *said))
        except Exception as error:
            self.__logger.error(f"exception occurred while executing process: {error}")
            self.__logger.debug(traceback.format_exc())  # upstream shows it always
            return False
        self.__process, details["pid"] = process, process.pid
        self.__logger.info(f"process started with pid [{process.pid}]")
        context.emit_event_sync(ProcessStarted(**details))
        status = await process.wait()
        self.__process = None
        if status == 0:
            self.__logger.info(f"process has finished cleanly [pid {process.pid}]")
        else:
            self.__logger.error(f"process has died [pid {process.pid}, exit code {status}, cmd '{cmd}'].")
        context.emit_event_sync(ProcessExited(returncode=status, **details))
        return True

    def __heard(self, context: LaunchContext, stream: str, line: str) -> None:
        fd = ("stdin", "stdout", "stderr").index(stream)
        context.emit_event_sync(ProcessIO(text=f"{line}\n".encode(), fd=fd, **self.__details))
        for destination in self.__to[stream]:
            destination(self.__format.format(line=line, this=self))

    # -- how it ends ---------------------------------------------------------------------------------

    def __on_shutdown_process(self, event: ShutdownProcess, context: LaunchContext) -> None:
        if event.process_matcher(self):
            self.__shut_down(context, send_sigint=True)

    def __on_shutdown(self, event: Shutdown, context: LaunchContext) -> None:
        self.__shut_down(context, send_sigint=not event.due_to_sigint or context.noninteractive)

    def __on_signal_process(self, event: SignalProcess, context: LaunchContext) -> None:
        if event.process_matcher(self):
            self.__send(event.signal)

    def __shut_down(self, context: LaunchContext, *, send_sigint: bool) -> None:
        if self.__ending.done():
            return
        self.__ending.set_result(None)
        if not self.__done.done():
            patience = {name: float(text_of(context, value)) for name, value in self.__patience.items()}
            texts = [text_of(context, self.__patience["sigterm"]), str(sum(patience.values()))]
            self.__escalation = context.asyncio_loop.create_task(
                self.__escalate(send_sigint, *patience.values(), texts)
            )

    async def __escalate(self, send_sigint: bool, sigterm: float, sigkill: float, told: list[str]) -> None:
        while self.__process is None:  # it is just being started
            await asyncio.sleep(0)
        if send_sigint:
            self.__send(signal.SIGINT)
        text = f"process[{self.final_name}] failed to terminate '{{}}' seconds after receiving '{{}}', "
        text += "escalating to '{}'"
        await asyncio.sleep(sigterm)
        self.__logger.error(text.format(told[0], "SIGINT", "SIGTERM"))
        self.__send(signal.SIGTERM)
        await asyncio.sleep(sigkill)
        self.__logger.error(text.format(told[1], "SIGTERM", "SIGKILL"))
        self.__send(signal.SIGKILL)

    def __send(self, number: signal.Signals) -> None:
        if self.__process is None:
            return
        self.__logger.info(f"sending signal '{number.name}' to process[{self.final_name}]")
        self.__process.send_signal(number)


def _of_event(handle: Callable[[Any, LaunchContext], None]) -> Callable[[LaunchContext], None]:
    return lambda context: handle(context.locals.event, context)
