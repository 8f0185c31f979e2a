"""The pond beneath turtlesim: steps, the canvas, and what is kept of a drawing."""

import math

import pytest

from sim.world import CommandError, World, simulate
from sim.world.machines.pond_image import PIXELS, SIDE, PondImage, clipped
from sim.world.machines.turtle import wrap_half_open

BLUE, RED, GREEN = (69, 86, 255), (255, 0, 0), (0, 255, 0)


@pytest.fixture
def pond():
    return simulate(World.load("turtlesim"), 0)


def test_the_frequency_of_calls_to_advance_changes_nothing(pond):
    other = simulate(World.load("turtlesim"), 0)
    for scene in (pond, other):
        scene.command("turtle1", 1.0, 0.0, 1.0)
    pond.advance(0.9)
    for tick in range(91):
        other.advance(tick / 100)
    assert pond.poses == other.poses
    assert pond.time == other.time == pytest.approx(56 * 0.016)


def test_a_turtle_moves_along_the_heading_that_it_has_after_turning(pond):
    pond.command("turtle1", 1.0, 0.5, 1.0)
    pond.advance(0.016)
    (x, y, theta), middle = pond.poses[0], SIDE / 2
    assert theta == 0.016
    assert x - middle == pytest.approx(0.016 * (math.cos(theta) - 0.5 * math.sin(theta)))
    assert y - middle == pytest.approx(0.016 * (math.sin(theta) + 0.5 * math.cos(theta)))


@pytest.mark.parametrize(
    ("angle", "same"), [(math.pi, -math.pi), (-math.pi, -math.pi), (7.0, 7.0 - math.tau)]
)
def test_angles_begin_at_minus_pi(angle, same):
    assert wrap_half_open(angle) == pytest.approx(same)


def test_a_line_is_as_wide_as_its_pen_and_covers_what_was_there():
    canvas = PondImage()
    canvas.line(1.0, 5.0, 9.0, 5.0, RED, 3)
    canvas.line(5.0, 1.0, 5.0, 9.0, GREEN, 1)
    pixel = 1 / 45
    at = [canvas.color(3.0, 5.0 + row * pixel, BLUE) for row in (-2, -1, 0, 1, 2)]
    assert at == [BLUE, RED, RED, RED, BLUE]
    assert canvas.color(5.0, 5.0, BLUE) == GREEN
    canvas.erase()
    assert canvas.color(5.0, 5.0, BLUE) == BLUE


def test_the_corners_of_the_canvas_are_those_of_the_pond():
    canvas = PondImage()
    for x, y in ((0, 0), (SIDE, 0), (0, SIDE), (SIDE, SIDE)):
        canvas.line(x, y, x, y, RED, 255)
        assert canvas.color(x, y, BLUE) == RED
    assert canvas.color(SIDE / 2, SIDE / 2, BLUE) == BLUE
    assert PIXELS == 500


@pytest.mark.parametrize(("line", "part"), [
    ((1, 1, 2, 2), (1, 1, 2, 2)),
    ((1, 1, 1, -9), (1, 1, 1, 0)),
    ((-1, 1, 21, 1), (0, 1, SIDE, 1)),
    ((-1, 1, -1, 2), None),
    ((-3, 1, 1, -3), None),
    ((5, 5, 5, 5), (5, 5, 5, 5)),
])  # fmt: skip
def test_only_the_part_of_a_line_inside_the_pond_is_drawn(line, part):
    assert clipped(*line) == (part if part is None else pytest.approx(part))


def test_a_jump_out_of_the_pond_and_back_leaves_two_lines(pond):
    turtle = pond.turtles["turtle1"]
    for x in (20.0, 25.0, 5.0):
        turtle.teleport_to(x, 5.0, 0.0)
    pond.advance(0.016)
    lines = [[point[1:] for point in stroke.points] for stroke in pond.drawing.strokes]
    assert [len(line) for line in lines] == [2, 2]
    assert lines[0][1] == pytest.approx((SIDE, 5.3356), abs=1e-4)  # on the way from the middle to (20, 5)
    assert lines[1] == [pytest.approx((SIDE, 5.0)), (5.0, 5.0)]


def test_a_place_that_is_none_is_refused_and_nothing_changes(pond):
    with pytest.raises(CommandError, match="Places are finite numbers; this one was nan, 0, 0"):
        pond.spawn("nemo", math.nan, 0.0, 0.0)
    assert list(pond.turtles) == ["turtle1"]


def test_without_an_end_a_drawing_keeps_what_can_be_seen_and_does_not_grow(pond):
    for tick in range(40_000):
        if tick % 60 == 0:
            pond.command("turtle1", 2.0, 0.0, 1.0)
        pond.advance(tick * 0.016)
        if tick % 1000 == 0:
            pond.discard_history()
    assert sum(len(stroke.points) for stroke in pond.drawing.strokes) <= 21_000
    pond.clear()
    pond.set_background(RED)
    pond.discard_history()
    assert (pond.drawing.strokes, len(pond.drawing.grounds)) == ([], 1)


def test_many_short_lines_are_forgotten_the_oldest_first(pond):
    from sim.world.pen_drawing import Stroke

    for number in range(12_000):
        pond.drawing.strokes.append(Stroke("turtle1", RED, 0.1, [(number, 0.0, 0.0), (number, 1.0, 1.0)]))
    pond.discard_history()
    assert len(pond.drawing.strokes) == 6_000
    assert pond.drawing.strokes[0].points[0][0] == 6_000


def test_the_ground_had_its_colors_one_after_the_other(pond):
    pond.advance(1.0)
    pond.set_background(RED)
    pond.advance(2.0)
    pond.set_background(RED)
    assert pond.drawing.grounds == [(0.0, BLUE), (1.0, RED)]
    assert [pond.drawing.ground_at(stamp) for stamp in (-1.0, 0.5, 1.0, 9.0)] == [BLUE, BLUE, RED, RED]
