"""The process of one judge: takes one submission over a socket, marks it, gives the result and ends.

It says {"student": true} when it needs a student's process, and gets a socket to it; {"build": true} does the
same for a process that builds a package. {"ending": "student"}, or "build", asks how the last of these ended.
At last comes {"result": text}, or {"failed": why} for an assignment that it can't mark.
"""

from __future__ import annotations

import contextlib
import socket

from grader.marking.build_process.build_request import request_build
from grader.marking.errors import UnknownTest
from grader.marking.judge.led_process import LedProcess
from grader.marking.judge.mark_submission import mark_submission, result_text
from grader.marking.task import RESULT, receive_order
from grader.workspace.building import Built
from grader.workspace.sources import Sources
from sim.ros.remote import Wire, WireError

ANSWER_S = 60.0  # for an answer of the marker's, on a busy machine


def main(sock: socket.socket) -> None:
    """Mark what comes over the socket, as `send_order` hands it over."""
    order = receive_order(sock)
    marker = Wire(sock, RESULT)

    def ending(whose: str) -> str:
        marker.send(ending=whose)
        return str(marker.receive(ANSWER_S)["ending"])

    def socket_to(**whose: bool) -> socket.socket:
        marker.send(**whose)
        _, [descriptor], _, _ = socket.recv_fds(sock, 1, 1)
        return socket.socket(fileno=descriptor)

    def build(sources: Sources) -> Built:
        return request_build(socket_to(build=True), sources, lambda: ending("build"))

    def start_process() -> LedProcess:
        to_student = socket_to(student=True)
        return LedProcess(to_student, order.time_limits, lambda: ending("student"), build)

    with contextlib.suppress(WireError):  # the marker is gone: nobody wants a result
        try:
            marker.send(result=result_text(mark_submission(order.task, order.secret, start_process)))
        except UnknownTest as reason:
            marker.send(failed=str(reason))
