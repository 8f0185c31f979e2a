"""Starts confined processes: a warm interpreter inside bubblewrap forks them."""

import os
import platform
import socket
import threading
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any, Self

from grader.marking.errors import SandboxFailed, SandboxMissing
from grader.marking.sandbox import bubblewrap, landlock, separate_user
from grader.marking.sandbox.confined_process import ConfinedProcess
from grader.marking.sandbox.confinement import BUBBLEWRAP, NONE, USER
from grader.marking.sandbox.resource_limits import USUAL, ResourceLimits
from grader.marking.sandbox.warm_process import WarmProcess

ISOLATIONS = (BUBBLEWRAP, f"{USER} with Landlock", USER, NONE)
PRELOAD = ("sim", "grader.exercises", "numpy", "matplotlib.pyplot", "IPython.core.interactiveshell")


class Sandbox:
    """Starts students' processes, isolated from the machine and from each other. Thread-safe.

    entry: "module:function"; each confined process calls it with a unix socket, its only connection.
    preload: modules that are imported once, before any confined process. imports: folders with more modules.
    readable: files and folders that can be read inside, at the same paths as here. Besides those they see the
    system's programs, Python with its packages, and the packages sim and grader; nothing else.
    hidden: folders that are empty for the processes, or closed; what is in them can only be imported before.
    unsafe: no isolation. They are plain processes with the same limits and all rights of the user who marks:
    they can read and write all files, use the network and kill processes. For machines without bubblewrap,
    and for code that is trusted.
    """

    def __init__(
        self,
        entry: str = "grader.marking.student_process.cell_runner:main",
        preload: Sequence[str] = PRELOAD,
        readable: Sequence[Path] = (),
        unsafe: bool = False,
        limits: ResourceLimits = USUAL,
        imports: Sequence[Path] = (),
        hidden: Sequence[Path] = (),
    ) -> None:
        """Start the warm process, in the first kind of isolation that this machine allows.

        Raises SandboxMissing, SandboxFailed if what it imports fails, FileNotFoundError for what is readable.
        """
        if platform.machine() != "x86_64":
            raise SandboxMissing(
                "The sandbox filters system calls by their numbers on x86_64, and this machine is "
                f"{platform.machine()}: mark on a Linux x86_64 machine."
            )
        self._order: dict[str, Any] = {
            "entry": entry,
            "preload": list(preload),
            "imports": [str(path) for path in imports],
            "limits": asdict(limits),
            "kind": NONE if unsafe else BUBBLEWRAP,
            "hidden": list(map(str, hidden)),
            "visible": [] if unsafe else bubblewrap.visible_paths([*readable, *imports]),
        }
        self._lock = threading.Lock()
        self._warm: WarmProcess | None = self._start_warm()

    @property
    def isolation(self) -> str:
        """Return how the processes are isolated: one of ISOLATIONS."""
        kind: str = self._order["kind"]
        return f"{USER} with Landlock" if kind == USER and landlock.version() else kind

    def _start_warm(self) -> WarmProcess:
        """Where bubblewrap can't make a sandbox, use separate users, if that works. Raises SandboxMissing."""
        try:
            return WarmProcess(self._order)
        except SandboxMissing as reason:
            if os.geteuid():  # only root can have others
                raise
            closed = [*self._order["hidden"], os.getcwd()]
            if problem := separate_user.why_not(self._order["visible"], closed):
                raise SandboxMissing(f"{reason} {problem}") from None
        self._order["kind"] = USER
        return WarmProcess(self._order)

    def start(self, sock: socket.socket) -> ConfinedProcess:
        """Start a process that gets `sock`, which is closed here; `wait` for it. Raises SandboxFailed."""
        with sock:
            warm = self._current()
            try:
                return warm.start(sock)
            except SandboxFailed:
                if warm.alive(wait_s=1.0):
                    raise
            return self._current().start(sock)

    def _current(self) -> WarmProcess:
        """Return the warm process; a new one if it has died."""
        with self._lock:
            if self._warm is None:
                raise SandboxFailed("This sandbox is closed.")
            if not self._warm.alive():
                self._warm.end()
                self._warm = WarmProcess(self._order)
            return self._warm

    def close(self) -> None:
        """End the warm process and every confined process that still runs."""
        with self._lock:
            if self._warm:
                self._warm.end()
            self._warm = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
