"""Judges that don't judge, for tests of the pool: what one does, the student's name says."""
import os
import socket

from grader.marking.task import receive_order
from sim.ros.remote import Wire


def main(sock: socket.socket) -> None:
    student, wire = receive_order(sock).task.student, Wire(sock)
    if student == "nonsense":
        wire.send(result="{}")
    elif student == "refusal":
        wire.send(failed="The test cell `x` can't be marked here.")
    elif student == "silent":
        wire.receive()
    elif student == "crash":
        os.abort()
