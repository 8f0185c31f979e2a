"""The process of one judge: takes one submission over a socket, marks it, gives the result and ends.

It says {"student": true} when it needs a student's process, and gets a socket to it; {"ending": true} to hear
how that process ended; at last {"result": text}, or {"failed": why} for an assignment that it can't mark.
"""

from __future__ import annotations

import contextlib
import socket

from grader.marking.errors import UnknownTest
from grader.marking.judge.led_process import LedProcess
from grader.marking.judge.mark_submission import mark_submission, result_text
from grader.marking.task import RESULT, receive_order
from sim.ros.remote import Wire, WireError

ANSWER_S = 60.0  # for an answer of the marker's, on a busy machine


def main(sock: socket.socket) -> None:
    """Mark what comes over the socket, as `send_order` hands it over."""
    order = receive_order(sock)
    marker = Wire(sock, RESULT)

    def ending() -> str:
        marker.send(ending=True)
        return str(marker.receive(ANSWER_S)["ending"])

    def start_process() -> LedProcess:
        marker.send(student=True)
        _, [descriptor], _, _ = socket.recv_fds(sock, 1, 1)
        return LedProcess(socket.socket(fileno=descriptor), order.time_limits, ending)

    with contextlib.suppress(WireError):  # the marker is gone: nobody wants a result
        try:
            marker.send(result=result_text(mark_submission(order.task, order.secret, start_process)))
        except UnknownTest as reason:
            marker.send(failed=str(reason))
