"""The drives: equal for equal seeds, drawn such that luck decides nothing, and in no message."""

import numpy as np

from grader.exercises.covariance.drift.short_drives import DRIVES, RADIUS, STEPS, Encoders, drives
from sim import run


def test_a_seed_gives_its_drives_and_another_one_others():
    first, again, other = drives(3), drives.__wrapped__(3), drives(4)
    assert len(first) == DRIVES
    assert all(np.array_equal(a.end, b.end) for a, b in zip(first, again, strict=True))
    assert not np.array_equal(first[0].end, other[0].end)


def test_the_ends_are_as_far_off_as_their_spread_says():
    for seed in (1, 2):
        rows = [(each.end - each.believed[-1], each.spread) for each in drives(seed)]
        squares = [off @ np.linalg.solve(spread, off) for off, spread in rows]
        assert 2.76 <= np.mean(squares) <= 3.24
        assert len({spread.tobytes() for _, spread in rows}) == DRIVES


def test_encoders_publish_what_the_wheels_read_and_stand_still_in_each_drive():
    recording = run(companions=[lambda: Encoders(5)], seconds=6.5, quiet=True)
    angles = np.array([row.message.position for row in recording.messages("/joint_states")])
    rolled = np.diff(angles[:STEPS], axis=0) * RADIUS
    assert np.allclose(rolled, drives(5)[0].rolled[1:])
    assert (~rolled.any(axis=1)).sum() >= 7
    assert {row.topic for row in recording.published if row.from_course} >= {"/joint_states", "/reset_odometry"}
