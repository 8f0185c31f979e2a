"""Starts a launch file's processes as programs of the run: Python programs and ros2 commands."""

from __future__ import annotations

import asyncio
import contextlib
import os
import re
import shlex
import signal
import sys
from collections.abc import Callable
from itertools import count
from pathlib import Path
from typing import Any

from sim.ros.bundled_programs import command_in_a_run
from sim.ros.engine.program import Process
from sim.ros.fibers.exceptions import RunOver
from sim.ros.launching.respawned import interrupt, kill
from sim.ros.left_out import is_left_out, left_out
from sim.ros.packages import bundled_command, executable, forget_modules

PYTHON = re.compile(r"python(3(\.\d+)?)?")


class UnsupportedProgram(Exception):
    """A command that can't be a program of a run."""


def _unsupported(program: str) -> UnsupportedProgram:
    return UnsupportedProgram(
        f"In a run, launch starts only Python programs and ros2 commands, and {program} is neither: `ros2 "
        "launch` in a terminal starts anything."
    )


class SimProcessStarter:
    """Starts the processes of a launch file as programs of a run. error: of the first that can't be one.

    pid: a sequential number of the launch file. write_log: records launch's log lines.
    """

    def __init__(self, run: Any) -> None:
        self.run, self.error, self.write_log, self._numbers = run, None, self._log, count(1)
        self.pid = run.programs.index(run.current.process) + 1
        self._bundled: dict[str, Callable[[], None]] = {}

    def _log(self, *line: Any) -> None:
        """Record a line of launch's, but for the end of the run, which cancels launch's task."""
        if self.run.recorder.open:
            self.run.output.log(*line)

    def find_bundled(self, package: str, name: str) -> str | None:
        """Work like launch's `ProcessStarter`. Raises ExecutableNotFound."""
        path = f"{sys.prefix}/lib/{package}/{name}"
        if is_left_out(package, name):
            self._bundled[path] = left_out(package)
        elif bundled_command(package, name) is not None:
            self._bundled[path] = executable(package, name)
        return path if path in self._bundled else None

    async def start(
        self, cmd: list[str], cwd: str | None, env: dict[str, str], shell: bool, on_output: Callable
    ) -> SimProcess:
        """Work like launch's `ProcessStarter`."""
        try:
            command = shlex.split(" ".join(cmd)) if shell else cmd
            bundled = self._bundled.get(command[0]) if command else None
            main, arguments = (bundled, command[1:]) if bundled else _as_main(command, cwd or ".")
        except UnsupportedProgram as error:
            self.error = self.error or error
            raise
        others = {name for name, value in env.items() if os.environ.get(name) != value}
        if others:
            self.run.output.log(
                30,
                "launch",
                f"All programs of a run share one environment: {', '.join(sorted(others))} is not set.",
            )
        return SimProcess(self.run, main, arguments, next(self._numbers), on_output)


class SimProcess:
    """A process of a launch file that is a program of a run. Its pid is a sequential number."""

    def __init__(
        self, run: Any, main: Callable[[], None], arguments: list[str], pid: int, on_output: Callable
    ) -> None:
        self.pid, self._run, self._main, self._killed = pid, run, main, 0
        self._loop = asyncio.get_running_loop()
        self._status: asyncio.Future[int] = self._loop.create_future()

        def body() -> None:
            self._run_main()

        body.__name__, body.bundled = main.__name__, getattr(main, "bundled", False)  # type: ignore[attr-defined]
        launch = run.current.process
        spec = Process(body, arguments=arguments, host=launch.host, lenient=launch.spec.lenient)
        self._process = run.start(spec, from_course=launch.from_course)
        self._process.reader, self._on_output = self._read, on_output
        self._process.ended = self._ended
        self._partial_lines = {"stdout": "", "stderr": ""}

    async def wait(self) -> int:
        """Work like launch's `Process`."""
        return await self._status

    def send_signal(self, number: int) -> None:
        """Work like launch's `Process`: SIGINT is Ctrl-C, and every other signal kills it."""
        if number == signal.SIGINT:
            interrupt(self._process)
            return
        self._killed = number
        kill(self._run, self._process)

    def _read(self, stream: str, text: str) -> None:
        *lines, self._partial_lines[stream] = f"{self._partial_lines[stream]}{text}".split("\n")
        for line in lines:
            self._call_in_loop(self._on_output, stream, line)

    def _call_in_loop(self, function: Callable, *arguments: Any) -> None:
        with contextlib.suppress(RuntimeError):  # the loop is closed already
            self._loop.call_soon_threadsafe(function, *arguments)

    def _run_main(self) -> None:
        status = 1
        try:
            self._main()
            status = 0
        except SystemExit as exit_:
            status = exit_.code if isinstance(exit_.code, int) else int(exit_.code is not None)
            raise
        except KeyboardInterrupt:
            status = -signal.SIGINT
            raise
        except RunOver:
            status = -self._killed
            raise
        finally:
            self._call_in_loop(self._set_status, status)

    def _ended(self) -> None:
        """A signal may end it before its main() begins; otherwise its status is known already."""
        self._call_in_loop(self._set_status, -(self._killed or signal.SIGINT))

    def _set_status(self, status: int) -> None:
        if not self._status.done():  # canceled, when launch itself was interrupted
            self._status.set_result(status)


def _as_main(cmd: list[str], folder: str) -> tuple[Callable[[], None], list[str]]:
    """The main() function of a command, and its arguments. Raises UnsupportedProgram."""
    if not cmd:
        raise _unsupported("an empty command")
    first, *arguments = cmd
    name = os.path.basename(first)
    command = command_in_a_run(name)
    if command is not None:
        return command, arguments
    if PYTHON.fullmatch(name):
        arguments = arguments[1:] if arguments[:1] == ["-u"] else arguments
        if not arguments or arguments[0].startswith("-"):
            raise _unsupported(f"`{shlex.join(cmd)}`")
        first, *arguments = arguments
    path = Path(folder, first)
    if not path.is_file():
        if first == name and is_left_out(name, name):
            return left_out(name), arguments
        if first == name and not path.suffix:
            raise _unsupported(f"`{first}`")
        raise UnsupportedProgram(f"[Errno 2] No such file or directory: '{path}'")
    text = path.read_bytes()
    if path.suffix != ".py" and not (text.startswith(b"#!") and b"python" in text.split(b"\n", 1)[0]):
        raise _unsupported(f"`{path}`")

    def main() -> None:
        _prepare_imports(path)
        names = {"__name__": "__main__", "__file__": str(path)}
        exec(compile(text, str(path), "exec"), names)

    return _named(main, path.stem), arguments


def _named(function: Callable[[], None], name: str) -> Callable[[], None]:
    function.__name__ = name
    return function


def _prepare_imports(path: Path) -> None:
    """Let a program import the modules in its folder, and not those that another program has imported."""
    folder = path.parent.resolve()
    if str(folder) not in sys.path:
        sys.path.insert(0, str(folder))
    forget_modules()
    for name, module in list(sys.modules.items()):
        file = getattr(module, "__file__", None)
        if isinstance(file, str) and Path(file).parent == folder and name != "__main__":
            del sys.modules[name]
