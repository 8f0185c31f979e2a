"""The warm process that forks the inmates: `python -m grader.marking.sandbox.warden DESCRIPTOR`.

DESCRIPTOR is a socket to the Sandbox. First comes a JSON object with what to prepare; the answer is {},
{"failed": why} or {"forbidden": by what}. Then each message brings two sockets: the inmate's wire and the
place to report to. The warden lives until the Sandbox closes its end.
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
from grader.marking.sandbox.cell import Plan
from grader.marking.sandbox.keeper import Entry, keep
from grader.marking.sandbox.limits import Limits


class Warden:
    """Forks a keeper, and by it an inmate, whenever the Sandbox asks for one."""

    def __init__(self, control: socket.socket, order: dict[str, Any]) -> None:
        self._control = control
        self._plan = Plan(Limits(**order["limits"]), order["caged"], order["visible"])
        self._entry = _load(order)
        signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # keepers report to the Sandbox, not here
        if self._plan.caged:
            linux.die_with_parent(signal.SIGKILL)
            linux.set_dumpable(False)

    def fork(self, entry: Entry, wire: socket.socket, report: socket.socket) -> None:
        """Fork a keeper that gets `wire` and `report`, and close both here."""
        with wire, report:
            try:
                keeper = os.fork()
            except OSError as error:  # too many processes, for now
                report.send(json.dumps({"failed": str(error)}).encode())
                return
            if not keeper:
                self._control.close()
                keep(entry, wire, report, self._plan)

    def rehearse(self) -> None:
        """Start an inmate that does nothing. Raises OSError if this system does not allow it."""
        _, wire = socket.socketpair()
        ours, theirs = socket.socketpair(type=socket.SOCK_SEQPACKET)
        with ours:
            self.fork(lambda sock: None, wire, theirs)
            answer, descriptors, _, _ = socket.recv_fds(ours, 1 << 16, 1)
        for descriptor in descriptors:
            os.close(descriptor)
        if "failed" in (said := json.loads(answer or b'{"failed": "the keeper died"}')):
            raise OSError(said["failed"])

    def serve(self) -> None:
        """Fork inmates until the Sandbox closes its end."""
        while True:
            _, descriptors, _, _ = socket.recv_fds(self._control, 64, 2)
            if len(descriptors) != 2:
                return
            wire, report = (socket.socket(fileno=descriptor) for descriptor in descriptors)
            self.fork(self._entry, wire, report)


def _load(order: dict[str, Any]) -> Entry:
    """Import what inmates will need, so that each is born with it; return their entry."""
    for name in order["preload"]:
        importlib.import_module(name)
    module, _, function = order["entry"].partition(":")
    entry = getattr(importlib.import_module(module), function)
    gc.collect()
    gc.freeze()  # pages of what is warm stay shared with all inmates
    return entry


def main(descriptor: int) -> NoReturn:
    """Prepare, say so, and serve."""
    control = socket.socket(fileno=descriptor)
    control.set_inheritable(False)
    order = json.loads(control.recv(1 << 16))
    try:
        warden = Warden(control, order)
    except BaseException as error:
        _answer(control, failed="".join(traceback.format_exception_only(error)).strip())
    else:
        try:
            warden.rehearse()
        except OSError as error:
            _answer(control, forbidden=str(error))
        else:
            _answer(control)
            warden.serve()
    os._exit(0)  # and with it everybody in the cage


def _answer(control: socket.socket, **words: str) -> None:
    """Tell the Sandbox what became of the preparations, with a handle on this process."""
    socket.send_fds(control, [json.dumps(words).encode()], [os.pidfd_open(os.getpid())])


if __name__ == "__main__":
    main(int(sys.argv[1]))
