"""How the programs of a launch file are started: here as processes of their own."""

from __future__ import annotations

import asyncio
import contextlib
import sys
from collections.abc import Callable
from typing import Protocol

Message = Callable[[str, str], None]  # "stdout" or "stderr", and a line without its end


class Started(Protocol):
    """One program that was started."""

    pid: int

    def send_signal(self, number: int) -> None:
        """Send it a signal; nothing happens where it has ended."""

    async def wait(self) -> int:
        """Its exit status when it has ended; -N if signal N has ended it."""


class Processes(Protocol):
    """What starts programs."""

    def find(self, package: str, name: str) -> str | None:
        """The word for `start` that means a package's program which is not in its folder; None for none."""

    async def start(
        self, cmd: list[str], cwd: str | None, env: dict[str, str], shell: bool, heard: Message
    ) -> Started:
        """Start one. Raises OSError where that can't be."""


class RealProcesses:
    """Starts programs as processes of the system.

    elsewhere: gives the words that start a package's program which is not in its folder; None for none.
    """

    def __init__(self, elsewhere: Callable[[str, str], list[str] | None] | None = None) -> None:
        self._elsewhere, self._commands = elsewhere, {}

    def find(self, package: str, name: str) -> str | None:
        """As `Processes`. Raises what `elsewhere` raises."""
        words = None if self._elsewhere is None else self._elsewhere(package, name)
        if words is None:
            return None
        path = f"{sys.prefix}/lib/{package}/{name}"
        self._commands[path] = words
        return path

    async def start(
        self, cmd: list[str], cwd: str | None, env: dict[str, str], shell: bool, heard: Message
    ) -> Started:
        """As `Processes`."""
        cmd = [word for each in cmd for word in self._commands.get(each, [each])]
        pipes = {"stdin": asyncio.subprocess.PIPE, "stdout": asyncio.subprocess.PIPE}
        pipes |= {"stderr": asyncio.subprocess.PIPE}
        if shell:
            process = await asyncio.create_subprocess_shell(" ".join(cmd), cwd=cwd, env=env, **pipes)
        else:
            process = await asyncio.create_subprocess_exec(*cmd, cwd=cwd, env=env, **pipes)
        return RealProcess(process, heard)


class RealProcess:
    """A process of the system."""

    def __init__(self, process: asyncio.subprocess.Process, heard: Message) -> None:
        self.pid, self._process, self._heard = process.pid, process, heard

    def send_signal(self, number: int) -> None:
        """As `Started`."""
        with contextlib.suppress(ProcessLookupError):
            self._process.send_signal(number)

    async def wait(self) -> int:
        """As `Started`; all that it has written was heard by then, but for what its children keep open."""
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
                self._heard(name, line.decode(errors="replace"))
        if rest:
            self._heard(name, rest.decode(errors="replace"))
