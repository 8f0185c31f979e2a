"""The process of one judge: receives one submission over a socket, marks it, sends the result and ends.

It sends {"student": true} to request a student's process, and receives a socket to it; {"build": true} does
the same for a process that builds a package. {"ending": "student"}, or "build", requests how the last of
these ended. Finally it sends {"result": text}, or {"failed": why} for an assignment that it can't mark.
"""

from __future__ import annotations

import contextlib
import functools
import socket

from grader.marking.build_process.build_request import request_build
from grader.marking.errors import NoVariants, UnknownTest
from grader.marking.judge.mark_submission import mark_submission, result_text
from grader.marking.judge.student_session import StudentSession
from grader.marking.task import MAX_RESULT_BYTES, receive_order
from grader.workspace.building import Built
from grader.workspace.sources import Sources
from sim.ros.remote import Wire, WireError

ANSWER_S = 300.0  # for an answer of the marker's, on a busy machine


def main(sock: socket.socket) -> None:
    """Mark the submission that `send_order` sends over the socket."""
    order = receive_order(sock)
    marker = Wire(sock, MAX_RESULT_BYTES)

    def describe_end(of: str) -> str:
        marker.send(ending=of)
        return str(marker.receive(ANSWER_S)["ending"])

    def socket_to(**process: bool) -> socket.socket:
        marker.send(**process)
        _, [descriptor], _, _ = socket.recv_fds(sock, 1, 1)
        return socket.socket(fileno=descriptor)

    @functools.cache  # an interface package is built for its own exercise, and for the one that uses it
    def built(files: tuple[tuple[str, bytes], ...]) -> Built:
        return request_build(socket_to(build=True), dict(files), lambda: describe_end("build"))

    def build(sources: Sources) -> Built:
        return built(tuple(sorted(sources.items())))

    def start_session() -> StudentSession:
        to_student = socket_to(student=True)
        return StudentSession(to_student, order.time_limits, lambda: describe_end("student"), build)

    with contextlib.suppress(WireError):  # the marker's process has ended
        try:
            marker.send(result=result_text(mark_submission(order.task, order.secret, start_session)))
        except (UnknownTest, NoVariants) as reason:
            marker.send(failed=str(reason))
