"""What may happen to a program that was launched, and what it may be told."""

from __future__ import annotations

import signal
from collections.abc import Callable
from typing import Any

from launch.entities import Action, Event


class RunningProcessEvent(Event):
    """Something happened to a program."""

    name = "launch.events.process.RunningProcessEvent"

    def __init__(
        self, *, action: Action, name: str, cmd: list[str], cwd: str | None, env: dict[str, str], pid: int
    ) -> None:
        self.action: Any = action
        self.process_name, self.cmd, self.cwd, self.env, self.pid = name, cmd, cwd, env, pid


class ProcessStarted(RunningProcessEvent):
    """A program was started."""

    name = "launch.events.process.ProcessStarted"


class ProcessExited(RunningProcessEvent):
    """A program has ended. returncode: its exit status, -N if signal N has ended it."""

    name = "launch.events.process.ProcessExited"

    def __init__(self, *, returncode: int, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.returncode = returncode


class ProcessIO(RunningProcessEvent):
    """A program has written something. text: a line, with its end. fd: 1 for stdout, 2 for stderr."""

    name = "launch.events.process.ProcessIO"

    def __init__(self, *, text: bytes, fd: int, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.text = text
        self.from_stdin, self.from_stdout, self.from_stderr = fd == 0, fd == 1, fd == 2


class ProcessTargetedEvent(Event):
    """Programs are told something: those whose action `process_matcher` is true of."""

    name = "launch.events.process.ProcessTargetedEvent"

    def __init__(self, *, process_matcher: Callable[[Any], bool]) -> None:
        self.process_matcher = process_matcher


class ShutdownProcess(ProcessTargetedEvent):
    """Programs are to end."""

    name = "launch.events.process.ShutdownProcess"


class SignalProcess(ProcessTargetedEvent):
    """Programs get a signal."""

    name = "launch.events.process.SignalProcess"

    def __init__(
        self, *, signal_number: str | signal.Signals | int, process_matcher: Callable[[Any], bool]
    ) -> None:
        super().__init__(process_matcher=process_matcher)
        named = isinstance(signal_number, str)
        self.signal = signal.Signals[signal_number] if named else signal.Signals(signal_number)

    @property
    def signal_name(self) -> str:
        """Such as SIGINT."""
        return self.signal.name
