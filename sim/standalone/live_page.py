"""Brings a robot in real time and its page together."""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from typing import Any

from sim.standalone.connections import Connections
from sim.standalone.server import PageServer
from sim.view.live_view import pack_frame
from sim.view.strokes import visible_strokes
from sim.view.world_data import world_data

FRAME = 1 / 30  # s
FRAMES_PER_STATUS = 8


class LivePage:
    """The page of a `RealTimeRun`, until it is closed, on the first of some ports that is free.

    Raises OSError where none is.
    """

    def __init__(self, run: Any, ports: Sequence[int]) -> None:
        self._scene = run.scene
        self._run, self._frames = run, 0
        facts = {"world": world_data(run.scene.world), "status": self._status()}
        self._server = served(ports, facts, run.teleop(), Connections(run))
        run.every(FRAME, self._show)

    @property
    def address(self) -> str:
        """Where a browser finds it."""
        return f"http://localhost:{self._server.port}"

    def close(self) -> None:
        """Let go of the port."""
        self._server.close()

    def _status(self) -> dict[str, Any]:
        """How it goes; turtles come with topics of their own, and draw."""
        run = self._run
        topics = [{"name": name, "type": kind, "rate": 0} for name, kind in (run.takes | run.gives).items()]
        drawn = {} if run.scene.drawing is None else {"drawn": visible_strokes(run.scene.drawing)}
        return {"speed": 1, "pace": 1, "topics": topics, **drawn}

    def _show(self) -> None:
        scene = self._scene
        if scene.drawing is not None and self._frames % FRAMES_PER_STATUS == 0:
            self._server.tell(self._status())
        self._frames += 1
        self._server.show(pack_frame(scene.time, scene.poses, scene.last_scan))


def served(ports: Sequence[int], *what: Any) -> PageServer:
    """A PageServer of all this, on the first of some ports that is free. Raises OSError where none is."""
    *others, last = ports
    for port in others:
        with contextlib.suppress(OSError):
            return PageServer(port, *what)
    return PageServer(last, *what)
