"""What an action knows of the process that it started."""

from __future__ import annotations

from typing import Any

from launch.action import Action


class ProcessRecord(Action):
    """The base class of actions that start a process: its details, its exit status and its output."""

    _details: dict[str, Any] | None = None
    _return_code: int | None = None
    _cached: dict[str, str] | None = None

    @property
    def process_description(self) -> ProcessRecord:
        """The object that has `final_name` and `final_cmd`."""
        return self

    @property
    def final_name(self) -> str | None:
        """The name in the log, with its number; None before the action is executed."""
        return None if self._details is None else self._details["name"]

    @property
    def final_cmd(self) -> list[str] | None:
        """The command with all substitutions performed; None before the action is executed."""
        return None if self._details is None else self._details["cmd"]

    @property
    def process_details(self) -> dict[str, Any] | None:
        """Name, command, working directory, environment and process id; None before it is executed."""
        return self._details

    @property
    def return_code(self) -> int | None:
        """The exit status, or -N if signal N killed it; None while the process has not exited."""
        return self._return_code

    def get_stdout(self) -> str:
        """Return what the process has written to stdout. Raises RuntimeError without cached_output=True."""
        return self._output("stdout")

    def get_stderr(self) -> str:
        """Return what the process has written to stderr. Raises RuntimeError without cached_output=True."""
        return self._output("stderr")

    def _cache_output(self, wanted: bool) -> None:
        self._cached = {"stdout": "", "stderr": ""} if wanted else None

    def _add_output(self, stream: str, line: str) -> None:
        if self._cached is not None:
            self._cached[stream] += f"{line}\n"

    def _output(self, stream: str) -> str:
        if self._cached is None:
            raise RuntimeError(
                f"the output of {self.describe()} is not stored: create the action with cached_output=True."
            )
        return self._cached[stream]
