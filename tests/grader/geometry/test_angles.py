import math

from grader.geometry.angles import least_turn, turn_between


def test_a_turn_is_measured_the_short_way_round_and_positive_to_the_left():
    assert turn_between(-170.0, 170.0) == 20.0
    assert turn_between(170.0, -170.0) == -20.0
    assert turn_between(90.0, 0.0) == 90.0


def test_what_is_no_number_is_infinitely_far():
    assert turn_between(math.nan, 0.0) == turn_between(math.inf, 0.0) == math.inf


def test_the_least_turn_has_no_sign():
    assert least_turn(0.0, [30.0, -10.0, 180.0]) == 10.0
