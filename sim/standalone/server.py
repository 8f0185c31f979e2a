"""A small web server for one page: frames go to browsers on this machine, commands to drive come back."""

from __future__ import annotations

import base64
import json
import threading
from collections.abc import Callable
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from importlib.resources import files
from typing import Any

from sim.view.javascript import script
from sim.view.live_view import parse_command

ADDRESS = "127.0.0.1"  # nobody else's machine
MOST_VIEWERS = 8
MOST_BYTES = 200  # of a command
PATIENCE = 5.0  # s for a frame to come, or for a browser to take it
POLICY = "default-src 'none'; script-src 'self'; style-src 'unsafe-inline'; connect-src 'self'; img-src data:"
_HERE = files("sim.standalone")


class PageServer:
    """Serves the page in threads of its own until it is closed.

    facts: what the page gets first, as JSON: {"world": ..., "status": ...}.
    on_drive: called with (forward, left), each in [-1, 1], in one of the server's threads.
    graph: called there, too; what it returns goes to the page as JSON.

    Raises OSError if the port is taken.
    """

    def __init__(
        self,
        port: int,
        facts: dict[str, Any],
        on_drive: Callable[[float, float], None],
        graph: Callable[[], dict[str, Any]],
    ) -> None:
        self.on_drive, self.graph = on_drive, graph
        self.viewers = threading.BoundedSemaphore(MOST_VIEWERS)
        self.pages = {
            "/": ("text/html; charset=utf-8", _HERE.joinpath("page.html").read_bytes()),
            "/page.js": ("text/javascript; charset=utf-8", _HERE.joinpath("page.js").read_bytes()),
            "/live.js": ("text/javascript; charset=utf-8", script("live.js").encode()),
            "/world": ("application/json", json.dumps(facts).encode()),
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

    def show(self, frame: bytes) -> None:
        """Send a frame to every page that looks; a slow one gets the newest when it is ready."""
        with self._changed:
            self._frame, self._number = base64.b64encode(frame), self._number + 1
            self._changed.notify_all()

    def tell(self, status: dict[str, Any]) -> None:
        """Send facts that have changed to every page, with its next frame."""
        self._status = json.dumps(status).encode()

    @property
    def status(self) -> bytes:
        """What was told last, as JSON; b"" before."""
        return self._status

    def next_frame(self, seen: int) -> tuple[bytes | None, int]:
        """The newest frame, once it is another than number `seen`, and its number; None for no more."""
        with self._changed:
            came = self._changed.wait_for(lambda: self._number != seen or not self._open, PATIENCE)
            return (self._frame if came and self._open else None), self._number

    def close(self) -> None:
        """Let go of all pages and of the port."""
        with self._changed:
            self._open = False
            self._changed.notify_all()
        self._http.shutdown()
        self._http.server_close()
        self._thread.join()


class _Http(ThreadingHTTPServer):
    daemon_threads = True
    block_on_close = False
    owner: PageServer

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Browsers come and go; what breaks off is nothing to talk about."""


class _Handler(BaseHTTPRequestHandler):
    timeout = PATIENCE
    server: _Http

    def do_GET(self) -> None:
        """The page, its parts, or the stream of frames."""
        owner = self.server.owner
        from_course = self.headers.get("Sec-Fetch-Site", "none") in ("same-origin", "none")
        if self.headers["Host"] not in owner.hosts or (self.path != "/" and not from_course):
            self.refuse(HTTPStatus.FORBIDDEN)
        elif self.path == "/frames":
            self.stream(owner)
        elif self.path == "/graph":
            self.answer("application/json", json.dumps(owner.graph()).encode())
        elif self.path in owner.pages:
            self.answer(*owner.pages[self.path])
        else:
            self.refuse(HTTPStatus.NOT_FOUND)

    def do_POST(self) -> None:
        """A command to drive, from this server's own page and no other."""
        owner, host = self.server.owner, self.headers["Host"]
        length = self.headers["Content-Length"] or ""
        if host not in owner.hosts or self.headers["Origin"] != f"http://{host}":
            self.refuse(HTTPStatus.FORBIDDEN)
        elif self.path != "/drive" or not length.isdecimal() or int(length) > MOST_BYTES:
            self.refuse(HTTPStatus.BAD_REQUEST)
        else:
            self.drive(self.rfile.read(int(length)))

    def drive(self, body: bytes) -> None:
        """Pass on a command, if it is one."""
        try:
            command = parse_command(json.loads(body))
        except (ValueError, RecursionError):
            command = None
        if command is None or "drive" not in command:
            self.refuse(HTTPStatus.BAD_REQUEST)
            return
        self.server.owner.on_drive(*command["drive"])
        self.answer("text/plain", b"")

    def stream(self, owner: PageServer) -> None:
        """Frames as server-sent events, until one side has gone."""
        if not owner.viewers.acquire(blocking=False):
            self.refuse(HTTPStatus.SERVICE_UNAVAILABLE)
            return
        try:
            self.send_response(HTTPStatus.OK)
            self.send_header("Content-Type", "text/event-stream")
            self.end_headers()
            frame, seen = owner.next_frame(0)
            told = b""
            while frame is not None:
                if owner.status != told:
                    told = owner.status
                    self.wfile.write(b"event: status\ndata: " + told + b"\n\n")
                self.wfile.write(b"data: " + frame + b"\n\n")
                frame, seen = owner.next_frame(seen)
        finally:
            owner.viewers.release()

    def answer(self, kind: str, body: bytes, status: HTTPStatus = HTTPStatus.OK) -> None:
        """One whole answer."""
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def refuse(self, status: HTTPStatus) -> None:
        """Say no in the words of HTTP."""
        self.answer("text/plain", f"{status.phrase}\n".encode(), status)

    def end_headers(self) -> None:
        """What every answer says."""
        for name, value in (
            ("Cache-Control", "no-store"),
            ("Content-Security-Policy", POLICY),
            ("X-Content-Type-Options", "nosniff"),
            ("X-Frame-Options", "DENY"),
        ):
            self.send_header(name, value)
        super().end_headers()

    def log_message(self, *arguments: Any) -> None:
        """Nothing: the terminal is for the robot."""
