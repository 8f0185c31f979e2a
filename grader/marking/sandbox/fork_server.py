"""The warm process that forks the confined ones: `python -m grader.marking.sandbox.fork_server DESCRIPTOR`.

DESCRIPTOR is a socket to the Sandbox. The first message is a JSON object with what to prepare; the answer is
{}, {"failed": why} or {"forbidden": by what}. Each further message brings two sockets: the wire of a new
process and the socket for its reports. The fork server runs until the Sandbox closes its end.
"""

import gc
import importlib
import json
import os
import signal
import socket
import sys
import traceback
from typing import Any, NoReturn

from grader.marking.sandbox import linux
from grader.marking.sandbox.confinement import NONE, Confinement
from grader.marking.sandbox.resource_limits import ResourceLimits
from grader.marking.sandbox.supervisor import EntryFunction, supervise


class ForkServer:
    """Forks a supervisor, which forks a confined process, for each request of the Sandbox."""

    def __init__(self, control: socket.socket, order: dict[str, Any]) -> None:
        self._control = control
        limits = ResourceLimits(**order["limits"])
        self._confinement = Confinement(limits, order["kind"], order["visible"], order["hidden"])
        if self._confinement.kind != NONE:  # before imports, which may hang
            linux.die_with_parent(signal.SIGKILL)
            if _is_closed(control):  # the parent may have died before that
                os._exit(0)
        self._entry = _load(order)
        signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # supervisors report to the Sandbox, not here
        if self._confinement.kind != NONE:
            linux.set_dumpable(False)

    def fork(self, entry: EntryFunction, wire: socket.socket, report: socket.socket) -> None:
        """Fork a supervisor that gets `wire` and `report`, and close both here."""
        with wire, report:
            try:
                supervisor = os.fork()
            except OSError as error:  # too many processes, for now
                report.send(json.dumps({"failed": str(error)}).encode())
                return
            if not supervisor:
                self._control.close()
                supervise(entry, wire, report, self._confinement)

    def start_trial_process(self) -> None:
        """Start a confined process that does nothing. Raises OSError if this system does not allow it."""
        _, wire = socket.socketpair()
        parent_end, child_end = socket.socketpair(type=socket.SOCK_SEQPACKET)
        with parent_end:
            self.fork(lambda sock: None, wire, child_end)
            answer, descriptors, _, _ = socket.recv_fds(parent_end, 1 << 16, 1)
        for descriptor in descriptors:
            os.close(descriptor)
        if "failed" in (report := json.loads(answer or b'{"failed": "the supervisor died"}')):
            raise OSError(report["failed"])

    def serve(self) -> None:
        """Fork confined processes until the Sandbox closes its end."""
        while True:
            _, descriptors, _, _ = socket.recv_fds(self._control, 64, 2)
            if len(descriptors) != 2:
                return
            wire, report = (socket.socket(fileno=descriptor) for descriptor in descriptors)
            self.fork(self._entry, wire, report)


def _is_closed(control: socket.socket) -> bool:
    """Return whether the Sandbox has closed its end."""
    try:
        return not control.recv(1, socket.MSG_PEEK | socket.MSG_DONTWAIT)
    except BlockingIOError:
        return False


def _load(order: dict[str, Any]) -> EntryFunction:
    """Import what confined processes need, so that each is forked with it loaded; return their entry."""
    for name in order["preload"]:
        importlib.import_module(name)
    module, _, function = order["entry"].partition(":")
    entry: EntryFunction = getattr(importlib.import_module(module), function)
    # Bytecode of what was imported until here is cached; that of students' modules is not.
    sys.dont_write_bytecode, os.environ["PYTHONDONTWRITEBYTECODE"] = True, "1"
    gc.collect()
    gc.freeze()  # memory pages that are loaded now stay shared with all confined processes
    return entry


def main(descriptor: int) -> NoReturn:
    """Prepare, report that, and serve."""
    control = socket.socket(fileno=descriptor)
    control.set_inheritable(False)
    order = json.loads(control.recv(1 << 16))
    try:
        fork_server = ForkServer(control, order)
    except BaseException as error:
        _answer(control, failed="".join(traceback.format_exception_only(error)).strip())
    else:
        try:
            fork_server.start_trial_process()
        except OSError as error:
            _answer(control, forbidden=str(error))
        else:
            _answer(control)
            fork_server.serve()
    os._exit(0)  # and with it all processes in the sandbox


def _answer(control: socket.socket, **report: str) -> None:
    """Report the outcome of the preparations to the Sandbox, with a handle on this process."""
    socket.send_fds(control, [json.dumps(report).encode()], [os.pidfd_open(os.getpid())])


if __name__ == "__main__":
    main(int(sys.argv[1]))
