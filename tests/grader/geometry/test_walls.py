"""Walls round a rectangle."""

from grader.geometry import rectangle


def test_a_rectangle_has_four_walls_counter_clockwise_from_its_lower_left_corner():
    assert rectangle(-1.0, -2.0, 3.0, 4.0) == (
        ((-1.0, -2.0), (3.0, -2.0)),
        ((3.0, -2.0), (3.0, 4.0)),
        ((3.0, 4.0), (-1.0, 4.0)),
        ((-1.0, 4.0), (-1.0, -2.0)),
    )
