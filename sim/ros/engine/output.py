"""What the programs of a run print and log: shown to the user, passed to a launch file, and recorded."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from sim.ros.fibers.scheduler import Scheduler
from sim.ros.recorder.recorder import Recorder


class ProgramOutput:
    """The output of one run's programs. screen: shows text to the user.

    silent: text is dropped, because the last threads are being ended by force.
    """

    def __init__(self, scheduler: Scheduler, recorder: Recorder, screen: Callable[[str], None]) -> None:
        self._scheduler, self._recorder, self._screen = scheduler, recorder, screen
        self.silent = False

    def stdout(self, text: str) -> None:
        """The current program wrote to stdout."""
        self._write("stdout", text, self._recorder.add_stdout)

    def stderr(self, text: str) -> None:
        """The current program wrote to stderr."""
        self._write("stderr", text, self._recorder.add_stderr)

    def log(self, severity: Any, logger: str, text: str) -> None:
        """A node of the current program wrote a log line."""
        line = self._recorder.log(severity, logger, text)
        if line is not None:
            self._show("stderr", f"[{line.level}] [{line.stamp:.3f}] [{line.node}]: {line.text}\n")
        self._scheduler.count_call("lines")

    def _write(self, stream: str, text: str, record: Callable[[str], None]) -> None:
        if not self.silent:
            self._show(stream, text)
            record(text)
            if lines := text.count("\n"):
                self._scheduler.count_call("lines", lines)

    def _show(self, stream: str, text: str) -> None:
        self._screen(text)
        reader = self._scheduler.current.process.reader
        if reader is not None:
            reader(stream, text)
