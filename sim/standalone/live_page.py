"""Brings a robot in real time and its page together."""

from __future__ import annotations

from typing import Any

from sim.standalone.server import PageServer
from sim.view.geometry import world_data
from sim.view.live import packed

FRAME = 1 / 30  # s


class LivePage:
    """The page of a `RealTimeRun`, until it is closed. Raises OSError if the port can't be had."""

    def __init__(self, run: Any, port: int) -> None:
        self._scene = run.scene
        topics = [{"name": name, "type": kind, "rate": 0} for name, kind in (run.takes | run.gives).items()]
        status = {"speed": 1, "pace": 1, "topics": topics}
        facts = {"world": world_data(run.scene.world), "status": status}
        self._server = PageServer(port, facts, run.teleop())
        run.every(FRAME, self._show)

    @property
    def address(self) -> str:
        """Where a browser finds it."""
        return f"http://localhost:{self._server.port}"

    def close(self) -> None:
        """Let go of the port."""
        self._server.close()

    def _show(self) -> None:
        scene = self._scene
        self._server.show(packed(scene.time, scene.poses, scene.last_scan))
