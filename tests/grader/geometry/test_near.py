import math

import numpy as np
import pytest

from grader.geometry.near import is_near


def test_a_number_is_near_up_to_the_tolerance():
    assert is_near(1.5, 1.0, 0.5)
    assert not is_near(1.6, 1.0, 0.5)
    assert is_near(-1.5, -1.0, 0.5)
    assert is_near(np.float64(1.0), 1.0, 0.0) is True


def test_a_point_is_near_by_its_distance():
    assert is_near((3.0, 4.0), (0.0, 0.0), 5.0)
    assert not is_near((3.0, 4.0), (0.0, 0.0), 4.9)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_nan_and_infinity_are_near_nothing(value):
    assert not is_near(value, 0.0, 1e9)
    assert not is_near(value, value, 1e9)
    assert not is_near((0.0, value), (0.0, 0.0), 1e9)
