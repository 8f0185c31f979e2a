"""Simulated time follows a clock at any speed, without catching up after a gap."""

import math

import pytest

from sim.ros.play.pacing import Pace


class Clock:
    now = 50.0

    def __call__(self):
        return self.now


@pytest.fixture
def clock():
    return Clock()


@pytest.mark.parametrize("speed", [0.5, 1, 4.0])
def test_it_goes_at_its_speed(clock, speed):
    pace, reached = Pace(speed, clock), 0.0
    for frame in range(61):
        clock.now = 50.0 + frame / 30
        reached = pace.due(reached)
    assert reached == pytest.approx(2 * speed)
    assert pace.measured == pytest.approx(speed, rel=0.05)


def test_a_long_gap_does_not_make_time_jump(clock):
    pace = Pace(1.0, clock)
    assert pace.due(3.0) == 3.0
    clock.now += 5.0
    assert pace.due(3.0) == 3.0
    assert pace.measured == 0.0
    clock.now += 0.1
    assert pace.due(3.0) == pytest.approx(3.1)


def test_what_falls_behind_does_not_catch_up(clock):
    pace = Pace(100.0, clock)
    pace.due(0.0)
    clock.now += 0.1
    assert pace.due(0.0) == pytest.approx(10.0)
    pace.fell_behind()
    clock.now += 0.1
    assert pace.due(2.0) == 2.0
    clock.now += 0.1
    assert pace.due(2.0) == pytest.approx(12.0)


def test_another_speed_counts_from_now_on(clock):
    pace = Pace(1.0, clock)
    pace.due(0.0)
    clock.now += 0.2
    pace.speed = 10.0
    assert pace.due(0.2) == 0.2
    clock.now += 0.2
    assert pace.due(0.2) == pytest.approx(2.2)


def test_as_fast_as_it_goes(clock):
    assert Pace(math.inf, clock).due(1.0) == math.inf


@pytest.mark.parametrize("speed", [0, -1.0, math.nan, "2", True, None])
def test_what_is_no_speed_is_refused(speed):
    with pytest.raises(ValueError) as caught:
        Pace(speed)
    words = "speed must be a number greater than 0, such as 2.0 for twice as fast as real time; it is "
    assert str(caught.value) == f"{words}{speed!r}."
