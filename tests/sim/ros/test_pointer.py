"""Clicks in the live picture: nodes read them as points, and a box is put where the user clicks."""

import itertools

import pytest

from sim import Pointer, Process, Teleop, World, play, run
from sim.play import _inputs
from tests.sim.ros import playing
from tests.students.engine import mains

FRAME = 1 / 30
STOREROOM = World.load("storeroom")


@pytest.fixture
def clock():
    return playing.Clock([FRAME / 4])


def clicked(clock, *nodes, world, places, picture=None):
    """A player in whose picture these places were clicked, one after each ten frames."""
    made = playing.player(*nodes, world=world, seconds=600, clock=clock)
    watcher = playing.watched(made, picture)
    for place in places:
        for _ in range(10):
            made.play_frame()
        watcher.on_command({"point": place})
    for _ in range(10):
        made.play_frame()
    made.stop()
    return made.recording


def test_each_click_is_published_once_as_a_point(clock):
    recording = clicked(clock, Pointer, world="arm", places=[[0.5, 0.25], [-0.5, 0.0]])
    points = [received.message for received in recording.messages("/clicked_point")]
    assert [(msg.point.x, msg.point.y, msg.header.frame_id) for msg in points] == [
        (0.5, 0.25, "map"),
        (-0.5, 0.0, "map"),
    ]


def test_the_frame_is_a_parameter(clock):
    pointer = Process(Pointer, parameters={"frame": "base_link"})
    (received,) = clicked(clock, pointer, world="arm", places=[[0.5, 0.25]]).messages("/clicked_point")
    assert received.message.header.frame_id == "base_link"


def test_without_a_pointer_a_click_changes_nothing(clock):
    recording = clicked(clock, mains.Counter, world=STOREROOM, places=[[1.0, 1.0]])
    assert recording.digest == clicked(clock, mains.Counter, world=STOREROOM, places=[[0.0, 0.0]]).digest


def test_a_box_is_put_where_the_user_clicks(clock):
    pointer = Process(Pointer, parameters={"box": "box_1"})
    x, y, _ = STOREROOM.start
    recording = clicked(clock, pointer, world=STOREROOM, places=[[x + 0.6, y]])
    last = recording.tracks["box_1"][-1]
    assert (last.x, last.y) == (x + 0.6, y)
    assert len(recording.messages("/clicked_point")) == 1


@pytest.mark.parametrize("where", [STOREROOM.start[:2], (STOREROOM.bounds[0], STOREROOM.bounds[1])])
def test_a_box_is_not_put_into_a_robot_or_a_wall(clock, where):
    pointer = Process(Pointer, parameters={"box": "box_1"})
    recording = clicked(clock, pointer, world=STOREROOM, places=[list(where)])
    first, last = recording.tracks["box_1"][0], recording.tracks["box_1"][-1]
    assert (first.x, first.y) == (last.x, last.y)
    assert not recording.contacts


def test_the_picture_says_where_no_box_fits_until_the_next_click(clock):
    pointer, picture = Process(Pointer, parameters={"box": "box_1"}), playing.Watcher()
    x, y, _ = STOREROOM.start
    clicked(clock, pointer, world=STOREROOM, places=[[x, y], [x + 0.6, y]], picture=picture)
    shown = [words for words, _ in itertools.groupby(state["warning"] for state in picture.states)]
    assert shown == ["", "box_1 can't be put there: click a free place.", ""]


@pytest.mark.parametrize(
    ("world", "box"), [("storeroom", "box_99"), ("storeroom", "robot"), ("arm", "box_1")]
)
def test_where_there_is_no_such_box_the_click_is_a_point_only(clock, world, box):
    pointer = Process(Pointer, parameters={"box": box})
    assert len(clicked(clock, pointer, world=world, places=[[1.0, 1.0]]).messages("/clicked_point")) == 1


def test_a_pointer_that_is_not_used_publishes_nothing():
    assert run(Pointer, world="arm", seconds=2, quiet=True).messages("/clicked_point") == []


@pytest.mark.parametrize(
    ("nodes", "inputs"),
    [
        ((), []),
        ((mains.Counter, mains.classic), []),
        ((Teleop,), ["keys"]),
        ((Process(Pointer, parameters={"box": "box_1"}), Process(Teleop)), ["keys", "points"]),
    ],
)
def test_the_picture_knows_what_nodes_read(nodes, inputs):
    assert _inputs(nodes) == inputs


def test_keys_are_read_in_a_world_without_a_robot(clock):
    made = playing.player(Teleop, world="cart_pole", seconds=600, clock=clock)
    watcher = playing.watched(made)
    for _ in range(20):
        watcher.on_command({"drive": [0.0, -1.0]})
        made.play_frame()
    made.stop()
    assert {received.message.angular.z for received in made.recording.messages("/cmd_vel")} == {-1.0}


def test_outside_a_notebook_it_runs_like_any_node():
    assert play(Pointer, world="arm", seconds=0.5, speed=1000.0, quiet=True).recording.ended.reason == "time"
