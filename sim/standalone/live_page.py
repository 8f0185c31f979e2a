"""Brings a robot in real time and its page together."""

from __future__ import annotations

import itertools
from array import array
from typing import Any

from sim.standalone.server import PageServer
from sim.view.geometry import world_data

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
        frame = array("f", (scene.time, *itertools.chain.from_iterable(scene.poses)))
        if scene.last_scan is not None:
            frame.extend(scene.last_scan.pose)
            frame.frombytes(scene.last_scan.ranges.tobytes())
        self._server.show(frame.tobytes())
