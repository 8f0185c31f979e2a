"""One joint against the closed form of its trapezoidal profile."""

import dataclasses
import math
import statistics

import pytest

from sim.world import CommandError, WorldError
from sim.world.machines import JointModel
from tests.sim.world.machines.machines import alone, steps

MODEL = JointModel(lower=-1.5, upper=1.5, max_velocity=1.0, max_acceleration=2.0)
ROUNDING = 1e-9


def duration(path, model=MODEL):
    """The closed form: with and without a stretch at full speed."""
    v, a = model.max_velocity, model.max_acceleration
    return path / v + v / a if path >= v * v / a else 2 * math.sqrt(path / a)


def arrival(joint, target):
    """Seconds until the joint stands at its target."""
    begin = joint.time
    return next(t for t in steps(joint, 10) if (joint.position, joint.velocity) == (target, 0.0)) - begin


@pytest.mark.parametrize("path", [1.5, 1.0, 0.5, 0.32, 0.1, 0.02])
def test_a_move_takes_as_long_as_its_closed_form(path):
    joint = alone(MODEL)
    joint.command(path)
    assert duration(path) - ROUNDING <= arrival(joint, path) <= duration(path) + 0.02


def test_the_profile_is_a_trapezoid():
    joint = alone(MODEL)
    joint.command(1.5)
    profile = {round(t, 2): (joint.position, joint.velocity) for t in steps(joint, 3)}
    assert profile[0.25] == pytest.approx((0.0625, 0.5))  # a t^2 / 2
    assert profile[0.5] == pytest.approx((0.25, 1.0))
    assert profile[1.2] == pytest.approx((0.95, 1.0))
    assert profile[1.75] == pytest.approx((1.5 - 0.0625, 0.5))
    assert profile[2.02] == (1.5, 0.0)


@pytest.mark.parametrize(("reported", "goes"), [(9.0, 1.5), (-9.0, -1.5), (1e300, 1.5)])
def test_a_command_beyond_the_limits_is_clamped(reported, goes):
    joint = alone(MODEL)
    joint.command(reported)
    joint.advance(4)
    assert (joint.position, joint.velocity) == (goes, 0.0)


def test_new_commands_midway_never_break_a_limit():
    """A hundred commands at odd moments, and one on top of the other."""
    joint = alone(MODEL)
    before = 0.0
    for number in range(100):
        joint.command(2 * math.sin(number * number))
        for _ in steps(joint, 0.05 + 0.11 * (number % 7)):
            assert -1.5 <= joint.position <= 1.5
            assert abs(joint.velocity) <= 1.0
            assert abs(joint.velocity - before) <= 0.02 + ROUNDING
            before = joint.velocity


def test_turning_back_midway_brakes_first():
    """At full speed the joint needs v^2 / 2a more to stop; from there it is the way back."""
    joint = alone(MODEL)
    joint.command(1.5)
    joint.advance(1.0)
    assert joint.velocity == 1.0
    stop = joint.position + 0.25
    joint.command(0.0)
    joint.advance(1.5)
    assert (joint.position, joint.velocity) == (pytest.approx(stop), pytest.approx(0.0, abs=ROUNDING))
    assert arrival(joint, 0.0) == pytest.approx(duration(stop), abs=0.02)


@pytest.mark.parametrize("command", [math.nan, math.inf, -math.inf])
def test_a_command_that_is_no_number_is_refused_and_changes_nothing(command):
    joint = alone(MODEL)
    joint.command(1.0)
    with pytest.raises(CommandError) as caught:
        joint.command(command)
    assert str(caught.value) == (
        f"Joint commands are finite numbers (rad); this one was {command}: check how it was calculated."
    )
    joint.advance(3)
    assert joint.position == 1.0


def test_the_link_is_drawn_where_the_joint_is():
    joint = alone(JointModel(start=0.5), start=(1.0, 2.0, math.pi / 2))
    assert [body.kind for body in joint.world.bodies] == ["link"]
    assert joint.poses == [(1.0, 2.0, pytest.approx(math.pi / 2 + 0.5))]
    assert (joint.contacts, joint.last_scan) == ([], None)


def test_how_often_it_is_looked_at_changes_nothing():
    often, once = alone(MODEL), alone(MODEL)
    for joint in (often, once):
        joint.command(1.2)
    for tick in range(1, 100):
        often.advance(tick * 0.0137)
    once.advance(99 * 0.0137)
    assert (often.time, often.position, often.velocity) == (once.time, once.position, once.velocity)


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"lower": 2.0}, "lower is 2.0; write an angle (radians) below upper, which is 1.5708."),
        (
            {"start": 3.0},
            "start is 3.0; write an angle (radians) from lower to upper, -1.5708 to 1.5708.",
        ),
        ({"max_velocity": 0}, "max_velocity is 0; write a number from 0.0001 to 100 (rad/s)."),
        (
            {"max_acceleration": math.nan},
            "max_acceleration is nan; write a number from 0.0001 to 10000 (rad/s^2).",
        ),
        ({"length": -1.0}, "length is -1.0; write a number from 0.0001 to 1000 (meters)."),
    ],
)
def test_invalid_parameters(values, sentence):
    with pytest.raises(WorldError) as caught:
        JointModel(**values)
    assert str(caught.value) == f"JointModel: {sentence}"


def test_an_encoder_measures_with_noise_and_the_joint_moves_as_without():
    noisy = dataclasses.replace(MODEL, position_noise=0.001, velocity_noise=0.002)
    exact, joint = alone(MODEL), alone(noisy, seed=1)
    for each in (exact, joint):
        each.command(1.2)
    rows = []
    for _, _ in zip(steps(exact, 3), steps(joint, 3), strict=True):
        assert exact.measure() == (exact.position, exact.velocity) == (joint.position, joint.velocity)
        position, velocity = joint.measure()
        rows.append((position - joint.position, velocity - joint.velocity))
    for errors, sigma in zip(zip(*rows, strict=True), (0.001, 0.002), strict=True):
        assert statistics.pstdev(errors) == pytest.approx(sigma, rel=0.2)
        assert max(map(abs, errors)) < 5 * sigma


def test_equal_seeds_give_equal_measurements():
    noisy = dataclasses.replace(MODEL, position_noise=0.001)
    joints = [alone(noisy, seed=seed) for seed in (1, 1, 2)]
    measured = [[joint.measure() for _ in range(3)] for joint in joints]
    assert measured[0] == measured[1] != measured[2]
    assert {velocity for _, velocity in measured[0]} == {0.0}
