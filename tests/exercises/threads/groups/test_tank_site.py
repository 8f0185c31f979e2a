"""The site of the tank robot: loads whose sum stays, and one radius at the moment of a load."""

import pytest

from grader.exercises.threads.groups import tank_site
from grader.exercises.threads.groups.tank_site import ORDERED, PERIOD, RADII, TOTAL
from sim import run


@pytest.mark.parametrize("seed", [1, 2, 77])
def test_the_load_moves_and_its_sum_stays(seed):
    recording = run(companions=tank_site(seed), seconds=0.42, quiet=True)
    loads = [(row.message.x, row.message.y) for row in recording.messages("/load")]
    assert len(loads) == round(0.42 / PERIOD)
    assert all(left + right == pytest.approx(TOTAL) for left, right in loads)
    assert len({left for left, _ in loads}) == len(loads)
    assert all(10.0 < left < 50.0 for left, _ in loads)


def test_one_radius_comes_at_the_moment_of_a_load_and_the_seed_decides_on_it():
    found = {}
    for seed in (1, 2):
        recording = run(companions=tank_site(seed), seconds=0.42, quiet=True)
        (row,) = recording.messages("/radius")
        assert row.stamp == pytest.approx(ORDERED)
        assert row.stamp in [load.stamp for load in recording.messages("/load")]
        assert RADII[0] <= row.message.data <= RADII[1]
        found[seed] = row.message.data
    assert found[1] != found[2]
