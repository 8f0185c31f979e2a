"""A small web server for one page: sends frames to browsers on this machine, receives commands."""

from __future__ import annotations

import base64
import json
import os
import socket
import sys
import threading
from collections.abc import Callable, Sequence
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from importlib.resources import files
from pathlib import Path
from typing import Any

from sim.view.javascript import script
from sim.view.live_view import parse_command

ADDRESS = "127.0.0.1"  # loopback only
MAX_VIEWERS = 8
MAX_BYTES = 2000  # of a command
COMMANDS = {"drive", "topic", "shown"}
TIMEOUT = 5.0  # s, to wait for a frame or for a browser to receive it
POLICY = "default-src 'none'; script-src 'self'; style-src 'unsafe-inline'; connect-src 'self'; img-src data:"
_HERE = files("sim.standalone")


class PageServer:
    """Serves the page in its own threads until it is closed.

    initial: the first data for the page, as JSON: {"world": ..., "status": ...}.
    on_command: called with {"drive": [forward, left]}, each in [-1, 1], {"topic": name}, the topic to show,
    or {"shown": names}, topics to draw. graph: its result is sent to the page as JSON. Both are called in the
    server's threads.

    Raises OSError if the port is in use.
    """

    def __init__(
        self,
        port: int,
        initial: dict[str, Any],
        on_command: Callable[[dict[str, Any]], None],
        graph: Callable[[], dict[str, Any]],
    ) -> None:
        self.on_command, self.graph = on_command, graph
        self.viewers = threading.BoundedSemaphore(MAX_VIEWERS)
        self.pages = {
            "/": ("text/html; charset=utf-8", _HERE.joinpath("page.html").read_bytes()),
            "/page.js": ("text/javascript; charset=utf-8", _HERE.joinpath("page.js").read_bytes()),
            "/live.js": ("text/javascript; charset=utf-8", script("live.js").encode()),
            "/world": ("application/json", json.dumps(initial).encode()),
        }
        self._changed = threading.Condition()
        self._frame, self._number, self._open = b"", 0, True
        self._status = b""
        self._http = _Http((ADDRESS, port), _Handler)
        self._http.owner = self
        self.port = self._http.server_address[1]
        self.hosts = {f"{name}:{self.port}" for name in ("localhost", ADDRESS)}
        self._thread = threading.Thread(target=self._http.serve_forever, daemon=True)
        self._thread.start()

    def show(self, frame: bytes, layers: Sequence[dict[str, Any]] = ()) -> None:
        """Send a frame and the layers over it to every page; a slow one gets the newest when it is ready."""
        data = json.dumps([base64.b64encode(frame).decode(), list(layers)]).encode()
        with self._changed:
            self._frame, self._number = data, self._number + 1
            self._changed.notify_all()

    def send_status(self, status: dict[str, Any]) -> None:
        """Send a changed status to every page, with its next frame."""
        self._status = json.dumps(status).encode()

    @property
    def status(self) -> bytes:
        """The latest status, as JSON; b"" before the first."""
        return self._status

    def next_frame(self, seen: int) -> tuple[bytes | None, int]:
        """Wait for a frame other than number `seen`; returns it, or None after the last, and its number."""
        with self._changed:
            available = self._changed.wait_for(lambda: self._number != seen or not self._open, TIMEOUT)
            return (self._frame if available and self._open else None), self._number

    def close(self) -> None:
        """Disconnect all pages and close the port."""
        with self._changed:
            self._open = False
            self._changed.notify_all()
        self._http.shutdown()
        self._http.server_close()
        self._thread.join()


def user_of_connection(
    client: tuple[str, int], server: tuple[str, int], table: Path = Path("/proc/net/tcp")
) -> int | None:
    """The number of the user whose program connected from this machine; None if Linux doesn't say."""
    hosts = (int.from_bytes(socket.inet_aton(end[0]), sys.byteorder) for end in (client, server))
    ends = [f"{host:08X}:{end[1]:04X}" for host, end in zip(hosts, (client, server), strict=True)]
    try:
        lines = table.read_text(encoding="ascii").splitlines()[1:]
    except OSError:
        return None
    rows = (line.split() for line in lines)
    return next((int(row[7]) for row in rows if row[1:3] == ends), None)


class _Http(ThreadingHTTPServer):
    daemon_threads = True
    block_on_close = False
    server_address: tuple[str, int]
    owner: PageServer

    def verify_request(self, request: Any, client_address: tuple[str, int]) -> bool:
        """Answer this user's programs and those of root; on a shared machine, others connect in vain."""
        return user_of_connection(client_address, self.server_address) in (None, 0, os.geteuid())

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Ignore aborted connections of browsers."""


class _Handler(BaseHTTPRequestHandler):
    timeout = TIMEOUT
    server: _Http

    def do_GET(self) -> None:
        """Serve the page, its files, the graph, or the stream of frames."""
        owner = self.server.owner
        same_origin = self.headers.get("Sec-Fetch-Site", "none") in ("same-origin", "none")
        if self.headers["Host"] not in owner.hosts or (self.path != "/" and not same_origin):
            self.respond_error(HTTPStatus.FORBIDDEN)
        elif self.path == "/frames":
            self.stream(owner)
        elif self.path == "/graph":
            self.respond("application/json", json.dumps(owner.graph()).encode())
        elif self.path in owner.pages:
            self.respond(*owner.pages[self.path])
        else:
            self.respond_error(HTTPStatus.NOT_FOUND)

    def do_POST(self) -> None:
        """Receive a command, only from this server's own page."""
        owner, host = self.server.owner, self.headers["Host"]
        length = self.headers["Content-Length"] or ""
        if host not in owner.hosts or self.headers["Origin"] != f"http://{host}":
            self.respond_error(HTTPStatus.FORBIDDEN)
        elif self.path != "/command" or not length.isdecimal() or int(length) > MAX_BYTES:
            self.respond_error(HTTPStatus.BAD_REQUEST)
        else:
            self.execute(self.rfile.read(int(length)))

    def execute(self, body: bytes) -> None:
        """Forward a command, if it is valid."""
        try:
            parsed = parse_command(json.loads(body))
        except (ValueError, RecursionError):
            parsed = None
        if parsed is None or not parsed.keys() <= COMMANDS:
            self.respond_error(HTTPStatus.BAD_REQUEST)
            return
        self.server.owner.on_command(parsed)
        self.respond("text/plain", b"")

    def stream(self, owner: PageServer) -> None:
        """Send frames as server-sent events until one side disconnects."""
        if not owner.viewers.acquire(blocking=False):
            self.respond_error(HTTPStatus.SERVICE_UNAVAILABLE)
            return
        try:
            self.send_response(HTTPStatus.OK)
            self.send_header("Content-Type", "text/event-stream")
            self.end_headers()
            frame, seen = owner.next_frame(0)
            status = b""
            while frame is not None:
                if owner.status != status:
                    status = owner.status
                    self.wfile.write(b"event: status\ndata: " + status + b"\n\n")
                self.wfile.write(b"data: " + frame + b"\n\n")
                frame, seen = owner.next_frame(seen)
        finally:
            owner.viewers.release()

    def respond(self, kind: str, body: bytes, status: HTTPStatus = HTTPStatus.OK) -> None:
        """Send a complete response."""
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def respond_error(self, status: HTTPStatus) -> None:
        """Send an HTTP error."""
        self.respond("text/plain", f"{status.phrase}\n".encode(), status)

    def end_headers(self) -> None:
        """Add the headers of every response."""
        for name, value in (
            ("Cache-Control", "no-store"),
            ("Content-Security-Policy", POLICY),
            ("X-Content-Type-Options", "nosniff"),
            ("X-Frame-Options", "DENY"),
        ):
            self.send_header(name, value)
        super().end_headers()

    def log_message(self, *arguments: Any) -> None:
        """Log nothing: the terminal is for the robot's output."""
