"""Connects a robot in real time with its page."""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from typing import Any

from sim.standalone.live_graph import LiveGraph
from sim.standalone.server import PageServer
from sim.view.live_view import pack_frame
from sim.view.strokes import visible_strokes
from sim.view.world_data import world_data

FRAME = 1 / 30  # s
FRAMES_PER_STATUS = 8


class LivePage:
    """The page of a `RealTimeRun`, served on the first free port of several until it is closed.

    Raises OSError if no port is free.
    """

    def __init__(self, run: Any, ports: Sequence[int]) -> None:
        self._scene = run.scene
        self._run, self._frames = run, 0
        facts = {"world": world_data(run.scene.world), "status": self._status()}
        self._server = open_server(ports, facts, run.teleop(), LiveGraph(run))
        run.every(FRAME, self._show)

    @property
    def address(self) -> str:
        """The URL for browsers."""
        return f"http://localhost:{self._server.port}"

    def close(self) -> None:
        """Stop the server."""
        self._server.close()

    def _status(self) -> dict[str, Any]:
        """The status: topics, which change with turtles, and their drawing."""
        run = self._run
        topics = [{"name": name, "type": kind, "rate": 0} for name, kind in (run.takes | run.gives).items()]
        drawn = {} if run.scene.drawing is None else {"drawn": visible_strokes(run.scene.drawing)}
        return {"speed": 1, "pace": 1, "topics": topics, **drawn}

    def _show(self) -> None:
        scene = self._scene
        if scene.drawing is not None and self._frames % FRAMES_PER_STATUS == 0:
            self._server.send_status(self._status())
        self._frames += 1
        self._server.show(pack_frame(scene.time, scene.poses, scene.last_scan))


def open_server(ports: Sequence[int], *arguments: Any) -> PageServer:
    """A PageServer with these arguments, on the first free port. Raises OSError if none is free."""
    *others, last = ports
    for port in others:
        with contextlib.suppress(OSError):
            return PageServer(port, *arguments)
    return PageServer(last, *arguments)
