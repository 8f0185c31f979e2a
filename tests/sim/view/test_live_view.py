import math
import os
import subprocess
import sys

import numpy as np
import pytest
from IPython.display import HTML
from ipywidgets.widgets import widget

from sim import Recording, World
from sim.evidence import Pose
from sim.view import live_view
from sim.view.live_view import LiveView, parse_command
from sim.view.replay import Replay
from sim.world import Scan
from tests.patience import PATIENCE

STATE = {"stamp": 1.0, "speed": 1.0, "pace": 1.0, "paused": False}
STATE |= {"topics": [], "contacts": [], "ended": None}


class Place:
    """Where a cell shows something."""

    def __init__(self):
        self.shown = []

    def update(self, item):
        self.shown.append(item)


@pytest.fixture
def place(monkeypatch):
    place = Place()

    def display(item, raw, display_id):
        assert raw and display_id
        place.shown.append(item)
        return place

    monkeypatch.setattr(live_view, "display", display)
    return place


@pytest.fixture
def view(place):
    view = LiveView(World.load("room"))
    view.show()
    yield view
    view.close()


def sent(view, monkeypatch):
    messages = []
    monkeypatch.setattr(view, "send", lambda content, buffers: messages.append((content, buffers)))
    return messages


def test_a_frame_is_one_message_of_stamp_poses_and_scan(view, monkeypatch):
    messages = sent(view, monkeypatch)
    ranges = np.array([1.0, math.inf, math.nan], np.float32)
    view.frame(2.5, [(1.0, 2.0, 3.0), (4.0, 5.0, 6.0)], Scan(2.45, (0.5, 0.25, 0.125), ranges))
    view.frame(2.75, [(1.0, 2.0, 3.0)], None)
    (_, (first,)), (_, (second,)) = messages
    floats = np.frombuffer(first, np.float32)
    assert floats[:10].tolist() == [2.5, 1, 2, 3, 4, 5, 6, 0.5, 0.25, 0.125]
    assert np.array_equal(floats[10:], ranges, equal_nan=True)
    assert np.frombuffer(second, np.float32).tolist() == [2.75, 1, 2, 3]


def test_a_frame_with_360_rays_is_1_5_kib(view, monkeypatch):
    messages = sent(view, monkeypatch)
    view.frame(0.0, [(0.0, 0.0, 0.0)], Scan(0.0, (0.0, 0.0, 0.0), np.ones(360, np.float32)))
    assert len(messages[0][1][0]) == 4 * (1 + 3 + 3 + 360)


def test_the_world_is_sent_to_the_page_once_with_all_its_bodies(view):
    world = World.load("room")
    assert view.world["bounds"] == list(world.bounds)
    assert len(view.world["walls"]) == len(world.walls)
    assert view.world["bodies"] == [{"name": "robot", "kind": "robot", "radius": 0.1, "outline": []}]
    assert view.world["lidar"]["far"] == world.lidar.range_max


def test_a_run_without_a_world_has_a_view():
    view = LiveView(None)
    assert view.world is None
    view.close()


def test_a_state_is_stored_for_later_pages_and_has_no_infinity(view):
    view.state(STATE | {"speed": math.inf, "recording": Recording()})
    assert view.status == STATE | {"speed": None}


def test_a_graph_is_stored_for_later_pages(view):
    assert view.graph == {}
    recording = Recording()
    view.connections(recording)
    assert view.graph == {}
    recording.graph.nodes.append("/alone")
    view.connections(recording)
    assert [box["lines"] for box in view.graph["boxes"]] == [["/alone"]]


@pytest.mark.parametrize(
    "command",
    [
        {"speed": 2.0},
        {"pause": True},
        {"pause": False},
        {"step": True},
        {"stop": True},
        {"graph": True},
        {"drive": [1.0, -0.5]},
        {"point": [12.5, -0.5]},
    ],
)
def test_a_command_of_the_page_is_passed_on(view, command):
    received = []
    view.on_command = received.append
    view._handle_custom_msg(command, [])
    assert received == [command]


@pytest.mark.parametrize(
    "message",
    [
        None,
        "stop",
        [],
        {},
        {"speed": 2.0, "stop": True},
        {"speed": 0},
        {"speed": -1.0},
        {"speed": math.nan},
        {"speed": math.inf},
        {"speed": 10**400},
        {"speed": "2"},
        {"speed": True},
        {"speed": None},
        {"pause": 1},
        {"pause": "false"},
        {"step": False},
        {"stop": 1},
        {"stop": {}},
        {"graph": 1},
        {"graph": False},
        {"drive": [1.0]},
        {"drive": [0.0, 0.0, 0.0]},
        {"drive": [1.5, 0.0]},
        {"drive": [math.nan, 0.0]},
        {"drive": [0.0, math.inf]},
        {"drive": [True, False]},
        {"drive": ["1", "0"]},
        {"drive": "10"},
        {"drive": {"0": 1, "1": 1}},
        {"point": [1.0]},
        {"point": [1001.0, 0.0]},
        {"point": [math.nan, 0.0]},
        {"point": ["1", "0"]},
        {"point": 3},
        {"__class__": 1},
        {1: 2},
    ],
)
def test_a_hostile_message_is_dropped(view, message):
    received = []
    view.on_command = received.append
    view._handle_custom_msg(message, [])
    assert received == []
    assert parse_command(message) is None


def test_messages_without_a_handler_are_dropped(view):
    view._on_message(view, {"stop": True}, [])  # ipywidgets would swallow what it raises
    assert view.on_command is None


def test_at_the_end_a_replay_takes_the_place_of_the_view(view, place):
    model = view.model_id
    view.finish(Recording(world=World.load("room"), path=[Pose(0.0, 0.0, 0.0, 0.0)], stamp=1.0))
    first, instead = place.shown
    assert first[live_view.WIDGET]["model_id"] == model
    assert live_view.PANEL in first  # for a page that shows it beside the notebook
    assert isinstance(instead, Replay)
    assert (view.comm, view.on_command) == (None, None)


def test_a_view_that_is_closed_leaves_nothing(view, place):
    view.close()
    view.close()
    assert isinstance(place.shown[1], HTML)
    assert (place.shown[1].data, len(place.shown), view.comm) == ("", 2, None)


def test_a_view_is_closed_even_when_there_is_nothing_to_replay(view, place):
    with pytest.raises(ValueError, match="nothing has moved in this run yet"):
        view.finish(Recording(world=World.load("room")))
    assert (place.shown[1].data, view.comm) == ("", None)


def test_fifty_views_leave_no_widget():
    before = len(widget._instances)
    for _ in range(50):
        LiveView(World.load("room")).close()
    assert len(widget._instances) == before


def test_colab_shows_widgets_that_are_not_its_own(tmp_path):
    """By a module with the one function of Colab's that is called."""
    (tmp_path / "google" / "colab").mkdir(parents=True)
    output = "def enable_custom_widget_manager(): print('enabled')"
    (tmp_path / "google" / "colab" / "output.py").write_text(output)
    path = os.pathsep.join([str(tmp_path), *filter(None, sys.path)])
    done = subprocess.run(
        [sys.executable, "-c", "import sim.view.live_view"],
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        timeout=PATIENCE,
    )
    assert (done.stdout, done.stderr) == ("enabled\n", "")
