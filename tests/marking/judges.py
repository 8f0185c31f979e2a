"""Judges that don't judge, for tests of the pool."""
import os
import socket

from grader.marking.task import receive_order
from sim.ros.remote import Wire


def _order(sock: socket.socket) -> Wire:
    receive_order(sock)
    return Wire(sock)


def nonsense(sock: socket.socket) -> None:
    _order(sock).send(result="{}")


def refusal(sock: socket.socket) -> None:
    _order(sock).send(failed="The test cell `x` can't be marked here.")


def silent(sock: socket.socket) -> None:
    _order(sock).receive()


def crash(sock: socket.socket) -> None:
    _order(sock)
    os.abort()
