"""Routes: places along a closed way, and the nearest one to a point."""

import math

import pytest

from sim.world import Route

SQUARE = Route([(0, 0), (2, 0), (2, 2), (0, 2)])
THERE_AND_BACK = Route([(1, 1), (4, 1)])


def test_a_route_is_as_long_as_its_legs():
    assert (SQUARE.length, THERE_AND_BACK.length) == (8, 6)
    assert Route([(0, 0), (3, 0), (3, 4)]).length == 12


@pytest.mark.parametrize("place, point", [
    (0, (0, 0)), (0.5, (0.5, 0)), (2, (2, 0)), (3, (2, 1)), (7.5, (0, 0.5)), (8, (0, 0)), (8.5, (0.5, 0)),
    (-0.5, (0, 0.5)), (80, (0, 0)),
])  # fmt: skip
def test_places_count_from_the_first_corner_and_go_round(place, point):
    assert SQUARE.point(place) == pytest.approx(point)


@pytest.mark.parametrize("point, place", [
    ((0.5, 0.1), 0.5), ((0.5, -3), 0.5), ((5, 5), 4), ((1.9, 1), 3), ((-0.2, 1), 7), ((-1, -1), 0),
])  # fmt: skip
def test_the_nearest_place_is_the_foot_of_the_perpendicular_or_a_corner(point, place):
    assert SQUARE.nearest(*point) == pytest.approx(place)


def test_only_places_within_reach_are_looked_at():
    assert THERE_AND_BACK.nearest(2, 1) == pytest.approx(1)
    assert THERE_AND_BACK.nearest(2, 1, begin=3) == pytest.approx(5)  # on the way back
    assert THERE_AND_BACK.nearest(2, 1, begin=3, reach=0.5) == pytest.approx(3.5)
    assert SQUARE.nearest(0.5, 0, begin=7.8, reach=1) == pytest.approx(8.5)  # beyond the first corner


def test_the_nearest_place_is_the_best_of_many_tried_ones():
    for step in range(200):
        x, y = 3 * math.sin(step) + 1, 3 * math.cos(2.7 * step) + 1
        best = min(math.dist(SQUARE.point(tried / 100), (x, y)) for tried in range(800))
        assert math.dist(SQUARE.point(SQUARE.nearest(x, y)), (x, y)) == pytest.approx(best, abs=0.005)
