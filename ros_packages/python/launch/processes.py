"""The processes of a launch file: what launch needs of them, and those of the operating system."""

from __future__ import annotations

import asyncio
import contextlib
import os
import sys
from collections.abc import Callable
from typing import Protocol

OnOutput = Callable[[str, str], None]  # called with "stdout" or "stderr", and a line without its newline


class Process(Protocol):
    """A process that was started."""

    pid: int

    def send_signal(self, number: int) -> None:
        """Send it a signal; does nothing if it has exited."""

    async def wait(self) -> int:
        """Wait until it has exited; returns its exit status, or -N if signal N killed it."""


class ProcessStarter(Protocol):
    """Starts the processes of a launch file.

    pid: of the process that launch itself runs in. write_log: receives launch's log lines (level, name of the
    logger, text), instead of the screen and the log file; None for these.
    """

    pid: int
    write_log: Callable[[int, str, str], None] | None

    def find_bundled(self, package: str, executable: str) -> str | None:
        """The path of an executable that is bundled for a package, for `start`; None if there is none.

        The path need not exist.
        """

    async def start(
        self, cmd: list[str], cwd: str | None, env: dict[str, str], shell: bool, on_output: OnOutput
    ) -> Process:
        """Start a process. Raises OSError if it can't be started."""


class SystemProcessStarter:
    """Starts processes of the operating system.

    bundled: returns the command that runs an executable which is bundled for a package, or None.
    """

    write_log = None

    def __init__(self, bundled: Callable[[str, str], list[str] | None] | None = None) -> None:
        self.pid, self._bundled, self._commands = os.getpid(), bundled, {}

    def find_bundled(self, package: str, executable: str) -> str | None:
        """Work like `ProcessStarter`. Raises what `bundled` raises."""
        command = None if self._bundled is None else self._bundled(package, executable)
        if command is None:
            return None
        path = f"{sys.prefix}/lib/{package}/{executable}"
        self._commands[path] = command
        return path

    async def start(
        self, cmd: list[str], cwd: str | None, env: dict[str, str], shell: bool, on_output: OnOutput
    ) -> Process:
        """Work like `ProcessStarter`."""
        cmd = [word for each in cmd for word in self._commands.get(each, [each])]
        pipes = {"stdin": asyncio.subprocess.PIPE, "stdout": asyncio.subprocess.PIPE}
        pipes |= {"stderr": asyncio.subprocess.PIPE}
        if shell:
            process = await asyncio.create_subprocess_shell(" ".join(cmd), cwd=cwd, env=env, **pipes)
        else:
            process = await asyncio.create_subprocess_exec(*cmd, cwd=cwd, env=env, **pipes)
        return SystemProcess(process, on_output)


class SystemProcess:
    """A process of the operating system."""

    def __init__(self, process: asyncio.subprocess.Process, on_output: OnOutput) -> None:
        self.pid, self._process, self._on_output = process.pid, process, on_output

    def send_signal(self, number: int) -> None:
        """Work like `Process`."""
        with contextlib.suppress(ProcessLookupError):
            self._process.send_signal(number)

    async def wait(self) -> int:
        """Work like `Process`. First passes on all of its output; its children's, for at most 1 s."""
        readers = [
            asyncio.ensure_future(self._read(self._process.stdout, "stdout")),
            asyncio.ensure_future(self._read(self._process.stderr, "stderr")),
        ]
        status = await self._process.wait()
        await asyncio.wait(readers, timeout=1.0)
        for reader in readers:
            reader.cancel()
        return status

    async def _read(self, stream: asyncio.StreamReader, name: str) -> None:
        rest = b""
        while block := await stream.read(2**16):
            *lines, rest = (rest + block).split(b"\n")
            for line in lines:
                self._on_output(name, line.decode(errors="replace"))
        if rest:
            self._on_output(name, rest.decode(errors="replace"))
