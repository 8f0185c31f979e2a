"""Connects a robot in real time with its page."""

from __future__ import annotations

import contextlib
from collections import deque
from collections.abc import Sequence
from typing import Any

from sim.ros.play.telemetry import Telemetry
from sim.standalone.live_graph import LiveGraph
from sim.standalone.node_traffic import NodeTraffic, ObservedMessage
from sim.standalone.server import PageServer
from sim.view.layers import NewestLayers
from sim.view.live_view import pack_frame
from sim.view.strokes import visible_strokes
from sim.view.world_data import world_data
from sim.world import Contact

FRAME = 1 / 30  # s
FRAMES_PER_STATUS = 8
MAX_CONTACTS = 100  # the newest are shown


class LivePage:
    """The page of a `RealTimeRun`, served on the first free port of several until it is closed.

    Its layers and topics are those of the robot's own nodes. What other programs publish for each other, such
    as /map and /plan, would need subscriptions, which `ros2 node info` would list: RViz shows it.

    Raises OSError if no port is free.
    """

    def __init__(self, run: Any, ports: Sequence[int]) -> None:
        self._scene = run.scene
        self._run, self._frames = run, 0
        self._drive, self._selected = run.teleop(), ""
        self._telemetry, self._contacts = Telemetry(), deque[Contact](maxlen=MAX_CONTACTS)
        self._layers, self._shown = NewestLayers(run.scene.world), list[str]()
        self._fixed: list[dict[str, Any]] = []  # layers that are always drawn
        self._traffic = NodeTraffic(lambda: run.scene.time, self._note)
        facts = {"world": world_data(run.scene.world), "status": self._status()}
        self._server = open_server(ports, facts, self._obey, LiveGraph(run))
        run.every(FRAME, self._show)

    @property
    def address(self) -> str:
        """The URL for browsers."""
        return f"http://localhost:{self._server.port}"

    def close(self) -> None:
        """Stop the server."""
        self._server.close()

    def _obey(self, command: dict[str, Any]) -> None:
        """Execute a command of the page, in one of the server's threads."""
        if "drive" in command:
            self._drive(*command["drive"])
        elif "topic" in command:
            self._selected = command["topic"]
        elif "shown" in command:
            self._shown = command["shown"]

    def _note(self, message: ObservedMessage) -> None:
        self._telemetry.add(message)
        self._layers.add(message)

    def _status(self) -> dict[str, Any]:
        """Topics with rates, values, contacts, the drawing of turtles, and a warning if there is one."""
        run, scene = self._run, self._scene
        if self._selected != self._telemetry.topic:
            self._telemetry.select(self._selected)
        for node in run.nodes:
            self._traffic.observe(node)
        kinds = run.takes | run.gives
        self._fixed = self._layers.changed() or self._fixed
        drawn = {} if scene.drawing is None else {"drawn": visible_strokes(scene.drawing)}
        return {
            **{"speed": 1, "pace": 1, "stamp": scene.time, "topics": self._traffic.topics(kinds)},
            **{"contacts": [[contact.x, contact.y] for contact in self._contacts], "warning": run.warning},
            **{"layers": self._fixed, "quiet": self._layers.quiet, "shown": self._shown},
            **self._telemetry.values(scene.world, scene, self._contacts, kinds),
            **drawn,
        }

    def _show(self) -> None:
        scene = self._scene
        last = self._contacts[-1].stamp if self._contacts else -1.0
        self._contacts.extend(contact for contact in scene.contacts if contact.stamp > last)
        if self._frames % FRAMES_PER_STATUS == 0:
            self._server.send_status(self._status())
        self._frames += 1
        frame = pack_frame(scene.time, scene.poses, scene.last_scan)
        self._server.show(frame, self._layers.moving(scene.time, self._shown))


def open_server(ports: Sequence[int], *arguments: Any) -> PageServer:
    """A PageServer with these arguments, on the first free port. Raises OSError if none is free."""
    *others, last = ports
    for port in others:
        with contextlib.suppress(OSError):
            return PageServer(port, *arguments)
    return PageServer(last, *arguments)
