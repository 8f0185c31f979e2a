"""Judges that don't judge, for tests of the pool."""
import os
import socket

from sim.ros.remote import Wire


def _order(sock: socket.socket) -> Wire:
    wire = Wire(sock)
    wire.receive()
    return wire


def nonsense(sock: socket.socket) -> None:
    _order(sock).send(result="{}")


def refusal(sock: socket.socket) -> None:
    _order(sock).send(failed="The test cell `x` can't be marked here.")


def silent(sock: socket.socket) -> None:
    _order(sock).receive()


def crash(sock: socket.socket) -> None:
    _order(sock)
    os.abort()
