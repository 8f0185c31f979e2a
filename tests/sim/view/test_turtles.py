"""Turtles that come and go, and their lines, in figures, replays and the live picture."""

import base64
import io
import json
import zlib

import numpy as np
import pytest
from PIL import Image

from sim import World, run
from sim.view import animate, plot_path, png, replay_data
from sim.view.body_tracks import presence_intervals
from sim.view.strokes import POINTS, all_strokes, visible_strokes
from sim.world import PenDrawing, Stroke, simulate
from tests.students.engine.pond import script

BLUE, PINK, RED = 0x4556FF, 0xB3B8FF, (255, 0, 0)


@pytest.fixture(scope="module")
def swim():
    """turtle2 comes at 0.5 s and goes at 1.5 s; what turtle1 drew is erased at 2 s."""
    steps = [
        (0.5, "spawn"), (0.6, "swim", "turtle1", 1.0), (1.5, "kill", "turtle2"), (2.0, "clear"),
        (2.1, "pen", *RED, 9), (2.2, "jump_to", 2.0, 9.0, 0.0),
    ]  # fmt: skip
    return run(script(*steps), world="turtlesim", seconds=3, quiet=True)


def colors(data, share=0.0005):
    """The colors of a picture that cover more than this share of it."""
    image = np.asarray(Image.open(io.BytesIO(data)).convert("RGB")).reshape(-1, 3)
    found, counts = np.unique(image, axis=0, return_counts=True)
    often = found[counts > share * len(image)]
    return {f"{red:02x}{green:02x}{blue:02x}" for red, green, blue in often}


def unpacked(recording):
    return json.loads(zlib.decompress(base64.b64decode(replay_data.pack(recording, 1.0)), -15))


def test_a_figure_has_the_pond_with_its_final_drawing_and_turtles(swim):
    figure = plot_path(swim)
    shown = colors(png(figure))
    assert {"4556ff", "ff0000", "7bc96f"} <= shown
    assert "b3b8ff" not in shown  # erased
    assert figure.description.endswith("turtle1")
    assert "turtle2" not in figure.description


def test_a_replay_has_the_times_of_each_turtle(swim):
    data = unpacked(swim)
    assert [body["name"] for body in data["world"]["bodies"]] == ["turtle1", "turtle2"]
    assert data["there"] == [[[0, 2976]], [[528, 1488]]]
    assert sum(data["stamps"]) == 2976
    assert [len(track[0]) for track in data["tracks"]] == [63, 63]


def test_a_replay_knows_what_was_drawn_and_erased_when(swim):
    drawing = unpacked(swim)["drawing"]
    assert drawing["grounds"] == [[0, BLUE]]
    (first, second) = drawing["strokes"]
    assert (first[0], round(first[1] * 45), first[2]) == (PINK, 3, 2000)
    assert first[3][0] == [608, 5.544, 5.544]
    assert len(first[3]) == 64
    assert second == [0xFF0000, pytest.approx(9 / 45), None, [[2208, 6.552, 5.544], [2208, 2.0, 9.0]]]


def test_the_live_picture_shows_what_is_there_now(swim):
    now = visible_strokes(swim.drawing)
    assert now["ground"] == BLUE
    assert now["strokes"] == [[0xFF0000, pytest.approx(9 / 45), [[6.552, 5.544], [2.0, 9.0]]]]


def test_an_animation_draws_lines_and_omits_removed_turtles(swim):
    image = Image.open(io.BytesIO(bytes(animate(swim, speed=1.0, frames_per_second=2))))

    def near(frame, *color):
        return bool((np.abs(frame - color).max(axis=1) < 50).sum() > 20)

    seen = []
    for stamp in (0.0, 1.0, 3.0):
        image.seek(round(2 * stamp))
        frame = np.asarray(image.convert("RGB")).reshape(-1, 3).astype(int)
        seen.append((near(frame, 0x7B, 0xC9, 0x6F), near(frame, 0xF2, 0xB8, 0x4B)))
    assert seen == [(True, False), (True, True), (True, False)]


def test_when_a_body_was_there(swim):
    assert presence_intervals(swim.path) == [(0.0, pytest.approx(2.976))]
    assert presence_intervals(swim.tracks["turtle2"]) == [(pytest.approx(0.528), pytest.approx(1.488))]


def test_long_drawings_are_thinned_and_keep_their_ends():
    points = [(tick * 0.016, tick * 1e-4, 0.0) for tick in range(100_000)]
    drawing = PenDrawing([Stroke("turtle1", RED, 0.1, points)], [(0.0, RED)])
    (stroke,) = all_strokes(drawing)["strokes"]
    assert len(stroke[3]) == POINTS
    assert (stroke[3][0][0], stroke[3][-1][0]) == (0, 1599984)


def test_a_world_without_pens_is_packed_as_before():
    data = unpacked(run(world="yard", seconds=0.2, quiet=True))
    assert "drawing" not in data
    assert "there" not in data
    assert simulate(World.load("yard"), 0).drawing is None
