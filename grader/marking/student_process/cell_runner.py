"""The student's side of marking: a process that runs the cells of one notebook on the judge's requests.

The student's code controls it, so the judge trusts nothing that it sends.
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
from grader.marking.student_process.course_modules import keep_only
from grader.marking.student_process.error_output import error_output
from grader.marking.student_process.exhausted import used_up
from grader.marking.student_process.interrupter import Interrupter
from grader.marking.student_process.output_sender import OutputSender
from grader.marking.student_process.shell import DescriptorCapture, Shell, start_shell
from sim.ros.remote import Wire, WireError, serve

NO_TEST = "Not graded here: when a class is marked, the test cells are."


def main(sock: socket.socket) -> None:
    """Serve the judge's requests over the socket until it closes the connection."""
    sys.path.insert(0, "")  # as in a notebook, where a cell may import a module that another one wrote
    wire = Wire(sock)
    with contextlib.suppress(WireError):
        CellRunner(wire, sock).serve_judge()


class CellRunner:
    """Runs cells.

    Receives {"files": {name: bytes}, "packages": [name, ...]} once, then {"run": source, "seconds": limit} or
    {"test": source, "seconds": limit} for each cell, until the judge closes the connection. Answers each with
    {"done": true}, and with "threads": whether threads of the notebook still run; "used_up": what later cells
    lack. Before that it sends the cell's outputs, as `CellOutputs.add` takes them, and {"grade": name} when a
    test cell calls `Exercise.grade`. If the answer to this is {"go": true}, the wire belongs to the run until
    it is over.
    """

    def __init__(self, wire: Wire, sock: socket.socket) -> None:
        self._wire, self._sock = wire, sock
        self._sender = OutputSender(wire)
        self._descriptors = DescriptorCapture(self._sender)
        self._shell: Shell = start_shell(self._sender)
        self._interrupter = Interrupter()
        self._threads = threading.active_count()

    def serve_judge(self) -> None:
        """Serve until a cell calls `quit()`. Raises WireError when the judge has closed the connection."""
        self._loop = asyncio.new_event_loop()
        asyncio.set_event_loop(self._loop)
        self._wire.send(ready=True)
        while not self._shell.exit_now:
            self._loop.run_until_complete(self._await_judge())
            match self._wire.receive():
                case {"run": str(source), "seconds": seconds}:
                    with graded_as(Grading(hand_over=_refuse)):
                        self._run(source, seconds)
                case {"test": str(source), "seconds": seconds}:
                    with graded_as(Grading(hand_over=self._hand_over)):
                        self._run(source, seconds)
                case {"files": dict(files), "packages": list(packages)}:
                    keep_only(packages)
                    for name, content in files.items():
                        Path(name).parent.mkdir(parents=True, exist_ok=True)
                        Path(name).write_bytes(content)
                    self._sender.done(threads=False)

    async def _await_judge(self) -> None:
        """Keep the event loop running between requests; the judge sends one only when idle."""
        readable = asyncio.Event()
        self._loop.add_reader(self._sock, readable.set)
        try:
            await readable.wait()
        finally:
            self._loop.remove_reader(self._sock)

    def _run(self, source: str, seconds: float) -> None:
        self._sender.begin()
        cell = self._loop.create_task(self._shell.execute(source))
        with self._interrupter.limit(seconds):
            while not cell.done():
                try:
                    self._loop.run_until_complete(asyncio.wait([cell]))
                except KeyboardInterrupt:  # while it awaited something
                    cell.cancel()
        self._descriptors.show()
        broken = None if cell.cancelled() else cell.exception()
        if broken is not None:  # a cell has broken IPython itself
            self._sender.show(output=error_output(broken, {}))
        self._sender.done(threads=threading.active_count() > self._threads, used_up=used_up())

    def _hand_over(self, exercise: str, nodes: Sequence[Any]) -> None:
        """Hand the nodes to the judge; see `Grading`."""
        self._interrupter.stop()  # from here on the judge limits the time
        with self._sender.paused():
            self._wire.send(grade=str(exercise))
            if self._wire.receive() == {"go": True}:
                serve(self._wire, nodes)


def _refuse(exercise: str, nodes: Sequence[Any]) -> None:
    """What `Exercise.grade` does in a cell that is no test."""
    print(NO_TEST)
