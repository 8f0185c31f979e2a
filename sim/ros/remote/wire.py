"""A wire between two processes: messages, one after the other, over a connected unix stream socket.

A message is a dictionary of plain data (texts, numbers, bytes, lists, dictionaries), packed by MessagePack.
"""

from __future__ import annotations

import socket
import struct
from time import monotonic
from typing import Any, NoReturn

import msgpack

_LENGTH = struct.Struct(">I")  # before each message, the number of its bytes
HALVES = "surrogatepass"  # half a character, as in "\\ud83d", may be in what a student prints
_PIECE = 1 << 16  # bytes asked for at a time: a false length must not cost memory


class WireError(Exception):
    """The wire is of no use any more, or for now."""


class WireClosed(WireError):
    """The other side has gone."""


class WireTimeout(WireError):
    """The other side did nothing in time."""


class WireBroken(WireError):
    """What came is no message, or what is to be sent can't be one."""


class Wire:
    """One end of the wire. Not for several threads.

    limit: the largest message that is sent or accepted, in bytes.
    patience: wall seconds that the other side may take to make room for a message that is sent.
    """

    def __init__(self, sock: socket.socket, limit: int = 64_000_000, patience: float = 60.0) -> None:
        self._socket, self._limit, self._patience = sock, limit, patience
        self._packer = msgpack.Packer(unicode_errors=HALVES)
        self._received = bytearray()  # of the message under way, and what came behind it

    def send(self, **message: Any) -> None:
        """Send one message.

        Raises WireBroken for what is no plain data and for too long a message, WireClosed, WireTimeout.
        """
        try:
            body = self._packer.pack(message)
        except (TypeError, ValueError, OverflowError) as error:
            raise WireBroken(f"this can't be sent: {error}") from None
        if len(body) > self._limit:
            raise WireBroken(f"a message of {len(body)} bytes is too long: {self._limit} are allowed")
        try:
            self._socket.settimeout(self._patience)
            self._socket.sendall(_LENGTH.pack(len(body)) + body)
        except TimeoutError:
            raise WireTimeout(f"the other side took no message for {self._patience:g} s") from None
        except OSError:
            self._gone()

    def receive(self, timeout: float | None = None) -> dict[str, Any]:
        """The next message. timeout: wall seconds until all of it must be there; None waits for ever.

        Raises WireTimeout, after which the rest can still be received; WireClosed; WireBroken.
        """
        deadline = None if timeout is None else monotonic() + timeout
        self._fill(_LENGTH.size, deadline, timeout)
        size = _LENGTH.unpack_from(self._received)[0]
        if size > self._limit:
            raise WireBroken(f"a message of {size} bytes is too long: {self._limit} are allowed")
        self._fill(_LENGTH.size + size, deadline, timeout)
        body = bytes(self._received[_LENGTH.size : _LENGTH.size + size])
        del self._received[: _LENGTH.size + size]
        try:
            message = msgpack.unpackb(body, unicode_errors=HALVES)
        except ValueError:
            raise WireBroken("what came is no message") from None
        if not isinstance(message, dict):
            raise WireBroken(f"what came is no message but a {type(message).__name__}")
        return message

    def close(self) -> None:
        """Hang up: the other side gets WireClosed."""
        self._socket.close()

    def _fill(self, size: int, deadline: float | None, timeout: float | None) -> None:
        """Receive until there are `size` bytes of the message under way."""
        while len(self._received) < size:
            left = None if deadline is None else deadline - monotonic()
            try:
                if left is not None and left <= 0:
                    raise TimeoutError
                self._socket.settimeout(left)
                piece = self._socket.recv(_PIECE)
            except TimeoutError:
                raise WireTimeout(f"nothing whole came for {timeout:g} s") from None
            except OSError:
                self._gone()
            if not piece:
                self._gone()
            self._received += piece

    def _gone(self) -> NoReturn:
        raise WireClosed("the other side has hung up") from None
