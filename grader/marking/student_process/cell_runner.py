"""The student's side of marking: a process that runs the cells of one notebook as it is told.

It belongs to the student, whose code may do with it what it likes. The judge trusts nothing that it says.
"""

from __future__ import annotations

import asyncio
import contextlib
import socket
import sys
import threading
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from grader.grading import Grading, graded_as
from grader.marking.student_process.error_output import error_output
from grader.marking.student_process.interrupts import Interrupter
from grader.marking.student_process.outlet import Outlet
from grader.marking.student_process.shell import Descriptors, Shell, start_shell
from sim.ros.remote import Wire, WireError, serve


def main(sock: socket.socket) -> None:
    """Do what the judge says over the socket, until it hangs up."""
    sys.path.insert(0, "")  # as in a notebook, where a cell may import a module that another one wrote
    wire = Wire(sock)
    with contextlib.suppress(WireError):
        CellRunner(wire, sock).serve_judge()


class CellRunner:
    """Runs cells.

    Hears {"files": {name: bytes}} once, then {"run": source, "seconds": limit} or
    {"test": source, "seconds": limit} for each cell, until the judge hangs up; says {"done": true} after
    each of these, and with "threads" whether threads of the notebook go on. Before that it says what a cell
    shows, as `CellOutputs.add` takes it, and in a test cell {"grade": name} when that calls `Exercise.grade`.
    If the answer is {"go": true}, the wire is the run's until that is over.
    """

    def __init__(self, wire: Wire, sock: socket.socket) -> None:
        self._wire, self._sock = wire, sock
        self._outlet = Outlet(wire)
        self._descriptors = Descriptors(self._outlet)
        self._shell: Shell = start_shell(self._outlet)
        self._interrupter = Interrupter()
        self._threads = threading.active_count()

    def serve_judge(self) -> None:
        """Answer until a cell says `quit()`. Raises WireError when the judge has hung up."""
        self._loop = asyncio.new_event_loop()
        asyncio.set_event_loop(self._loop)
        self._wire.send(ready=True)
        while not self._shell.exit_now:
            self._loop.run_until_complete(self._await_judge())
            match self._wire.receive():
                case {"run": str(source), "seconds": seconds}:
                    self._run(source, seconds)
                case {"test": str(source), "seconds": seconds}:
                    with graded_as(Grading(hand_over=self._hand_over)):
                        self._run(source, seconds)
                case {"files": dict(files)}:
                    for name, content in files.items():
                        Path(name).parent.mkdir(parents=True, exist_ok=True)
                        Path(name).write_bytes(content)
                    self._outlet.done(threads=False)

    async def _await_judge(self) -> None:
        """Let what cells have left running go on until the judge speaks, who speaks when nothing is open."""
        speaks = asyncio.Event()
        self._loop.add_reader(self._sock, speaks.set)
        try:
            await speaks.wait()
        finally:
            self._loop.remove_reader(self._sock)

    def _run(self, source: str, seconds: float) -> None:
        self._outlet.begin()
        cell = self._loop.create_task(self._shell.execute(source))
        with self._interrupter.limit(seconds):
            while not cell.done():
                try:
                    self._loop.run_until_complete(asyncio.wait([cell]))
                except KeyboardInterrupt:  # while it awaited something
                    cell.cancel()
        self._descriptors.show()
        if not cell.cancelled() and cell.exception() is not None:  # the student has broken IPython itself
            self._outlet.show(output=error_output(cell.exception(), {}))
        self._outlet.done(threads=threading.active_count() > self._threads)

    def _hand_over(self, exercise: str, nodes: Sequence[Any]) -> None:
        """Hand the nodes to the judge; see `Grading`."""
        self._interrupter.end()  # the judge looks at the clock now
        with self._outlet.closed():
            self._wire.send(grade=str(exercise))
            if self._wire.receive() == {"go": True}:
                serve(self._wire, nodes)
