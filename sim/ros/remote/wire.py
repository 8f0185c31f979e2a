"""Messages between two processes, over a connected Unix stream socket.

A message is a dictionary of plain data (texts, numbers, bytes, lists, dictionaries), packed by MessagePack.
"""

from __future__ import annotations

import socket
import struct
from time import monotonic
from typing import Any, NoReturn

import msgpack

_LENGTH = struct.Struct(">I")  # length prefix of each message, in bytes
HALVES = "surrogatepass"  # a student may print a lone surrogate such as "\\ud83d"
_CHUNK = 1 << 16  # bytes received at a time, so that a false length can't cost memory


class WireError(Exception):
    """Sending or receiving has failed."""


class WireClosed(WireError):
    """The other process has closed the connection."""


class WireTimeout(WireError):
    """The other process did not send or receive in time."""


class WireBroken(WireError):
    """Received bytes are no message, or a value can't be sent as one."""


class Wire:
    """One end of a connection; not thread-safe.

    limit: the largest message that is sent or accepted, in bytes.
    patience: wall seconds until the other process must have accepted a message.
    """

    def __init__(self, sock: socket.socket, limit: int = 64_000_000, patience: float = 60.0) -> None:
        self._socket, self._limit, self._patience = sock, limit, patience
        self._packer = msgpack.Packer(unicode_errors=HALVES)
        self._received = bytearray()  # of the current message and those after it

    def send(self, **message: Any) -> None:
        """Send one message.

        Raises WireBroken if the value is no plain data or the message too long, WireClosed, WireTimeout.
        """
        try:
            body = self._packer.pack(message)
        except (TypeError, ValueError, OverflowError) as error:
            raise WireBroken(f"the message can't be sent: {error}") from None
        if len(body) > self._limit:
            raise WireBroken(f"a message of {len(body)} bytes is too long: {self._limit} are allowed")
        try:
            self._socket.settimeout(self._patience)
            self._socket.sendall(_LENGTH.pack(len(body)) + body)
        except TimeoutError:
            raise WireTimeout(f"the other process accepted no message for {self._patience:g} s") from None
        except OSError:
            self._raise_closed()

    def receive(self, timeout: float | None = None) -> dict[str, Any]:
        """The next message. timeout: wall seconds until it must be complete; None waits forever.

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
            raise WireBroken("the received bytes are no message") from None
        if not isinstance(message, dict):
            raise WireBroken(f"the received message is not a dictionary but a {type(message).__name__}")
        return message

    def close(self) -> None:
        """Close the connection: the other process gets WireClosed."""
        self._socket.close()

    def _fill(self, size: int, deadline: float | None, timeout: float | None) -> None:
        """Receive until `size` bytes are buffered."""
        while len(self._received) < size:
            left = None if deadline is None else deadline - monotonic()
            try:
                if left is not None and left <= 0:
                    raise TimeoutError
                self._socket.settimeout(left)
                chunk = self._socket.recv(_CHUNK)
            except TimeoutError:
                raise WireTimeout(f"no complete message came for {timeout:g} s") from None
            except OSError:
                self._raise_closed()
            if not chunk:
                self._raise_closed()
            self._received += chunk

    def _raise_closed(self) -> NoReturn:
        raise WireClosed("the other process has closed the connection") from None
