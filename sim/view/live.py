"""The live picture of a run in a notebook: frames and facts go to the page, clicks and keys come back."""

from __future__ import annotations

import itertools
import math
from array import array
from collections.abc import Callable, Sequence
from typing import Any

import anywidget
import numpy as np
import traitlets
from IPython.display import HTML, DisplayHandle, display

from sim.evidence import Recording
from sim.notebook import notebook_page
from sim.view.drawing import live
from sim.view.geometry import world_data
from sim.view.graph_data import graph_data
from sim.view.replay import replay
from sim.view.scripts import script
from sim.world import Scan, World

Command = dict[str, Any]
WIDGET = "application/vnd.jupyter.widget-view+json"
BESIDE = "application/vnd.ros2-course.robot+json"  # known to jupyter/labextensions
LONGEST_NAME = 300  # of a topic
SPEEDS = (0.01, 1000.0)  # simulated seconds per second that a page may ask for


class LiveView(anywidget.AnyWidget):
    """Clock, controls and topics of a run that is under way; with a world, its picture and a pad to drive.

    A frame is one binary message; the page draws the newest only.

    Attributes:
        on_command: called with each command of the page that makes sense: {"speed": 2.0}, {"pause": True},
            {"step": True}, {"stop": True}, {"topic": name}, {"graph": True} or {"drive": [forward, left]},
            both in [-1, 1].
    """

    _esm = script("live.js")
    world = traitlets.Dict(allow_none=True).tag(sync=True)
    status = traitlets.Dict().tag(sync=True)
    graph = traitlets.Dict().tag(sync=True)  # empty until somebody looks

    def __init__(self, world: World | None) -> None:
        super().__init__(world=world and world_data(world))
        self.on_command: Callable[[Command], None] | None = None
        self._place: DisplayHandle | None = None
        self.on_msg(self._heard)

    def show(self) -> None:
        """Display the view in the output of the cell that is running."""
        bundle = self._repr_mimebundle_()
        data = bundle[0] if isinstance(bundle, tuple) else bundle
        # Our JupyterLab shows it beside the notebook, and a line here; others know only the rest.
        self._place = display({BESIDE: {}, **data}, raw=True, display_id=True)
        notebook_page().show({WIDGET: data[WIDGET]})

    def frame(self, stamp: float, poses: Sequence[tuple[float, float, float]], scan: Scan | None) -> None:
        """Show all bodies of the world at `stamp` (s); the picture keeps their trails."""
        self.send({}, [packed(stamp, poses, scan)])

    def state(self, state: dict[str, Any]) -> None:
        """Show how the run is going; see `Picture.state` in sim/ros/play."""
        speed = state["speed"]
        more = {"speed": speed if math.isfinite(speed) else None}  # JSON has no infinity
        if "drawing" in state:
            more |= {"drawing": None, "drawn": live(state["drawing"])}
        self.status = {**state, **more}

    def connections(self, recording: Recording) -> None:
        """Show who is connected to whom by now."""
        self.graph = graph_data(recording, counted=False) or {}

    def finish(self, recording: Recording) -> None:
        """The run is over: its replay takes the place of the view, which is closed."""
        try:
            self._leave(replay(recording))
        finally:
            self.close()

    def close(self) -> None:
        """End the view; nothing takes its place. Closing again does nothing."""
        self._leave(HTML(""))
        self.on_command = None
        self.layout.close()  # a widget of its own, which ipywidgets would keep
        super().close()

    def _leave(self, instead: Any) -> None:
        place, self._place = self._place, None
        if place is not None:
            place.update(instead)
            notebook_page().show({"text/html": instead.data if isinstance(instead, HTML) else instead.html})

    def _heard(self, _: Any, content: Any, buffers: Any) -> None:
        command = checked(content)
        if command is not None and self.on_command is not None:
            self.on_command(command)


def packed(stamp: float, poses: Sequence[tuple[float, float, float]], scan: Scan | None) -> bytes:
    """A frame as the page reads it, in float32.

    The stamp (s), x, y (m) and yaw (rad) of each of the world's bodies, and behind them the newest scan, if
    there is one: pose and ranges.
    """
    floats = array("f", (stamp, *itertools.chain.from_iterable(poses)))
    if scan is not None:
        floats.extend(scan.pose)
        floats.frombytes(np.asarray(scan.ranges, np.float32).tobytes())
    return floats.tobytes()


def checked(content: Any) -> Command | None:
    """The command that a message from a page is, or None: anybody can send anything from there."""
    if not isinstance(content, dict) or len(content) != 1:
        return None
    ((name, value),) = content.items()
    if name == "speed" and _between(value, *SPEEDS):
        return {name: float(value)}
    if (name == "pause" and isinstance(value, bool)) or (name in ("step", "stop", "graph") and value is True):
        return {name: value}
    if name == "topic" and isinstance(value, str) and len(value) <= LONGEST_NAME:
        return {name: value}
    if name == "drive" and isinstance(value, list) and len(value) == 2:
        forward, left = value
        if _between(forward, -1, 1) and _between(left, -1, 1):
            return {name: [float(forward), float(left)]}
    return None


def _between(value: Any, least: float, most: float) -> bool:
    return type(value) in (int, float) and least <= value <= most
