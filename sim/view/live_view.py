"""The live view of a run in a notebook: sends frames and status to the page, receives commands from it."""

from __future__ import annotations

import itertools
import math
from array import array
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from typing import Any

import anywidget
import numpy as np
import traitlets
from IPython.display import HTML, DisplayHandle, display

from sim.evidence import Recording
from sim.notebook import failure_html, failure_lines, notebook_page
from sim.view.graph_data import graph_data
from sim.view.javascript import script
from sim.view.layer_kinds import OPEN
from sim.view.layers import NewestLayers
from sim.view.replay import replay
from sim.view.strokes import visible_strokes
from sim.view.world_data import world_data
from sim.world import Scan, World

with suppress(ImportError):  # Colab shows widgets that aren't its own only after this call
    from google.colab import output

    output.enable_custom_widget_manager()

Command = dict[str, Any]
WIDGET = "application/vnd.jupyter.widget-view+json"
PANEL = "application/vnd.ros2-course.robot+json"  # handled by jupyter/labextensions
MAX_TOPIC_LENGTH = 300  # characters
MOST_METERS = 1000.0  # of a point in the picture
MAX_SHOWN = 20  # layers
SPEEDS = (0.01, 1000.0)  # range of simulated seconds per second that a page may request


class LiveView(anywidget.AnyWidget):
    """Clock, controls and topics of a running run; with a world, also its picture and a drive pad.

    A frame is one binary message; the page draws only the newest.

    Attributes:
        on_command: called with each valid command of the page: {"speed": 2.0}, {"pause": True},
            {"step": True}, {"stop": True}, {"topic": name}, {"graph": True}, {"drive": [forward, left]},
            both in [-1, 1], or {"point": [x, y]}, in m.
    """

    _esm = script("live.js")
    world = traitlets.Dict(allow_none=True).tag(sync=True)
    status = traitlets.Dict().tag(sync=True)
    layers: traitlets.List[Any] = traitlets.List().tag(sync=True)  # maps, plans and goals
    # the layers that the page may ask for: topics and their kinds
    quiet: traitlets.List[Any] = traitlets.List().tag(sync=True)
    shown = traitlets.List(traitlets.Unicode(), [OPEN], maxlen=MAX_SHOWN).tag(sync=True)  # it asks for these
    graph = traitlets.Dict().tag(sync=True)  # empty until the page requests it
    inputs = traitlets.List(traitlets.Unicode()).tag(sync=True)  # what nodes read besides: "keys", "points"

    def __init__(self, world: World | None, *, reports: bool = True, inputs: Sequence[str] = ()) -> None:
        super().__init__(world=world and world_data(world), inputs=list(inputs))
        self.on_command: Callable[[Command], None] | None = None
        self._reports = reports  # whether the end shows the failure of the run
        self._newest_layers = NewestLayers(world)
        self._recording: Recording | None = None
        self._last_frame = b""
        self._display: DisplayHandle | None = None
        self.on_msg(self._on_message)

    def show(self) -> None:
        """Display the view in the output of the running cell."""
        bundle: Any = self._repr_mimebundle_()
        data = bundle[0] if isinstance(bundle, tuple) else bundle
        # The course's JupyterLab extension shows it in a panel and a line here; other pages ignore PANEL.
        self._display = display({PANEL: {"model": self.model_id}, **data}, raw=True, display_id=True)
        notebook_page().show({WIDGET: data[WIDGET]})

    def frame(self, stamp: float, poses: Sequence[tuple[float, float, float]], scan: Scan | None) -> None:
        """Show all bodies of the world at `stamp` (s); the page stores their trails."""
        self._last_frame = pack_frame(stamp, poses, scan)
        self._send_frame()

    @traitlets.observe("shown")
    def _send_frame(self, _: Any = None) -> None:
        """Send the newest frame, with the layers that the page asks for: also to a run that is paused."""
        layers = []
        if self._recording is not None and self.shown:
            self._newest_layers.read(self._recording)
            layers = self._newest_layers.moving(self._recording.stamp, self.shown)
        if self._last_frame:
            self.send({"layers": layers}, [self._last_frame])

    def state(self, state: dict[str, Any]) -> None:
        """Show the status of the run; see `Picture.state` in sim/ros/play."""
        recording, speed = state["recording"], state["speed"]
        self._recording = recording
        self._newest_layers.read(recording)
        self.layers = self._newest_layers.changed() or self.layers
        self.quiet = self._newest_layers.quiet
        topic = state.get("topic")
        images = self._newest_layers.moving(recording.stamp, [topic["name"]]) if topic else []
        more = {"topic": topic | {"image": next(_images(images), None)}} if topic else {}
        more |= {"speed": speed if math.isfinite(speed) else None}  # JSON has no infinity
        if "drawing" in state:
            more |= {"drawing": None, "drawn": visible_strokes(state["drawing"])}
        self.status = {name: value for name, value in {**state, **more}.items() if name != "recording"}

    def connections(self, recording: Recording) -> None:
        """Show the current connections between nodes."""
        self.graph = graph_data(recording, counted=False) or {}

    def finish(self, recording: Recording) -> None:
        """Replace the view by the replay of the finished run, and close the view."""
        try:
            ending = replay(recording)
            ending.shares_script = False
            ending.above = failure_html(failure_lines(recording)) if self._reports else ""
            self._replace_output(ending)
        finally:
            self.close()

    def close(self) -> None:
        """Close the view and clear its output. Closing again does nothing."""
        self._replace_output(HTML(""))
        self.on_command = None
        self.layout.close()  # a separate widget that ipywidgets would retain
        super().close()

    def _replace_output(self, replacement: Any) -> None:
        handle, self._display = self._display, None
        if handle is not None:
            handle.update(replacement)
            html = replacement.data if isinstance(replacement, HTML) else replacement.html
            notebook_page().show({"text/html": html})

    def _on_message(self, _: Any, content: Any, buffers: Any) -> None:
        command = parse_command(content)
        if command is not None and self.on_command is not None:
            self.on_command(command)


def _images(layers: Sequence[dict[str, Any]]) -> Iterator[Any]:
    return (layer["data"] for layer in layers if layer["kind"] == "image")


def pack_frame(stamp: float, poses: Sequence[tuple[float, float, float]], scan: Scan | None) -> bytes:
    """A frame as the page parses it, in float32.

    The stamp (s), then x, y (m) and yaw (rad) of each of the world's bodies, then the newest scan, if there
    is
    one: pose and ranges.
    """
    floats = array("f", (stamp, *itertools.chain.from_iterable(poses)))
    if scan is not None:
        floats.extend(scan.pose)
        floats.frombytes(np.asarray(scan.ranges, np.float32).tobytes())
    return floats.tobytes()


def parse_command(content: Any) -> Command | None:
    """The command in a message from a page, or None if it is invalid: pages are untrusted."""
    if not isinstance(content, dict) or len(content) != 1:
        return None
    ((name, value),) = content.items()
    if name == "speed" and _between(value, *SPEEDS):
        return {name: float(value)}
    if (name == "pause" and isinstance(value, bool)) or (name in ("step", "stop", "graph") and value is True):
        return {name: value}
    if name == "topic" and _is_topic(value):
        return {name: value}
    if name == "shown" and isinstance(value, list) and len(value) <= MAX_SHOWN and all(map(_is_topic, value)):
        return {name: value}
    if name == "drive" and isinstance(value, list) and len(value) == 2:
        forward, left = value
        if _between(forward, -1, 1) and _between(left, -1, 1):
            return {name: [float(forward), float(left)]}
        return None
    is_pair = isinstance(value, list) and len(value) == 2
    if name == "point" and is_pair and all(_between(part, -MOST_METERS, MOST_METERS) for part in value):
        return {name: [float(part) for part in value]}
    return None


def _is_topic(value: Any) -> bool:
    return isinstance(value, str) and len(value) <= MAX_TOPIC_LENGTH


def _between(value: Any, least: float, most: float) -> bool:
    return type(value) in (int, float) and least <= value <= most
