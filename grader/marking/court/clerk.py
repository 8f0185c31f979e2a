"""The process of one judge: takes one submission over a socket, marks it, gives the result and ends.

It says {"pupil": true} when it needs a student's process, and gets a socket to it; {"ending": true} to hear
how that process ended; at last {"result": text}, or {"failed": why} for an assignment that it can't mark.
"""

from __future__ import annotations

import contextlib
import socket

from grader.marking.court.judge import as_text, mark
from grader.marking.court.pupil import Pupil
from grader.marking.court.testcells import NotOurs
from grader.marking.orders import ANSWER_S, RESULT, taken
from sim.ros.remote import Wire, WireError


def main(sock: socket.socket) -> None:
    """Mark what comes over the socket, as `given` makes it."""
    marker = Wire(sock, RESULT)
    task, secret, patience = taken(marker.receive(ANSWER_S))

    def ending() -> str:
        marker.send(ending=True)
        return str(marker.receive(ANSWER_S)["ending"])

    def pupil() -> Pupil:
        marker.send(pupil=True)
        _, [descriptor], _, _ = socket.recv_fds(sock, 1, 1)
        return Pupil(socket.socket(fileno=descriptor), patience, ending)

    with contextlib.suppress(WireError):  # the marker is gone: nobody wants a result
        try:
            marker.send(result=as_text(mark(task, secret, pupil)))
        except NotOurs as reason:
            marker.send(failed=str(reason))
