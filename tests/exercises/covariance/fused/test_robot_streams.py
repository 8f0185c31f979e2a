"""The streams: late and with gaps, of robots whose yaw passes pi, and without the truth."""

import numpy as np
import pytest

from grader.exercises.covariance.fused.fair_seeds import FAIR
from grader.exercises.covariance.fused.robot_streams import BIAS, LATE, NOISE, STREAMS, streams


@pytest.mark.parametrize("seed", FAIR[:3])
def test_streams_have_what_the_task_says(seed):
    rows = streams(seed)
    assert len(rows) == STREAMS
    assert {row.silent for row in rows} == {"", "wheels", "gyro"}
    assert all(len(row.gap) == {"": 0, "wheels": 20, "gyro": 15}[row.silent] for row in rows)
    assert max(row.gyro_late.max() for row in rows) == LATE > max(row.wheels_late.max() for row in rows) >= 1
    assert sum(bool(np.abs(row.wheels).max() > np.pi) for row in rows) > STREAMS / 2
    assert {row.speeds[0] > 0.1 for row in rows} == {True, False}
    assert all((row.speeds[80:] == 0.0).all() and np.ptp(row.yaws[75:]) == 0.0 for row in rows)


def test_a_sensor_s_messages_arrive_in_the_order_of_their_stamps():
    for row in streams(FAIR[0]):
        assert (np.diff(np.arange(len(row.gyro)) + row.gyro_late) >= 0).all()
        assert (np.diff(np.arange(0, 80, 2) + row.wheels_late[:80:2]) >= 0).all()


def test_errors_are_those_of_the_sensors():
    rows = streams(FAIR[0])
    off = np.array([row.wheels[80] - row.yaws[80] for row in rows])
    assert np.mean(off**2 / [row.spread[80] for row in rows]) == pytest.approx(1.0, abs=0.05)
    biases = np.array([(row.gyro[1:] - np.diff(row.yaws) / 0.1).mean() for row in rows])
    assert np.abs(biases).max() == pytest.approx(BIAS, abs=4 * NOISE / 9)


def test_a_seed_gives_its_streams():
    assert np.array_equal(streams(4)[3].gyro, streams.__wrapped__(4)[3].gyro)
