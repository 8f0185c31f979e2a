"""The arm: where its tip is, and how it follows positions and trajectories."""

import dataclasses
import math
import random

import pytest

from sim.world import CommandError
from sim.world.machines import ArmModel, JointModel, ReachError, Waypoint
from tests.sim.world.machines.machines import alone, steps

FAST = JointModel(lower=-2.0, upper=2.0, max_velocity=3.0, max_acceleration=10.0)
MODEL = ArmModel(FAST, dataclasses.replace(FAST, length=0.4))
UPPER, FORE = 0.5, 0.4


@pytest.mark.parametrize(
    ("angles", "tip"),
    [
        ((0, 0), (UPPER + FORE, 0, 0)),
        ((math.pi / 2, 0), (0, UPPER + FORE, math.pi / 2)),
        ((0, math.pi / 2), (UPPER, FORE, math.pi / 2)),
        ((math.pi / 2, -math.pi / 2), (FORE, UPPER, 0)),
        ((math.pi / 3, -2 * math.pi / 3), (0.45, (UPPER - FORE) * math.sqrt(3) / 2, -math.pi / 3)),
    ],
)
def test_forward_kinematics_are_the_geometry_of_two_links(angles, tip):
    assert MODEL.forward(*angles) == pytest.approx(tip)


@pytest.mark.parametrize("elbow_left", [True, False])
def test_inverse_kinematics_undo_the_forward_ones(elbow_left):
    for number in range(100):
        shoulder, elbow = 3 * math.sin(number), 1.5 + 1.4 * math.cos(number)
        elbow = elbow if elbow_left else -elbow
        x, y, _ = MODEL.forward(shoulder, elbow)
        assert MODEL.inverse(x, y, elbow_left) == pytest.approx((shoulder, elbow))


@pytest.mark.parametrize(("place", "distance"), [((1.0, 0.0), "1"), ((0.0, 0.05), "0.05")])
def test_a_point_out_of_reach_is_reported(place, distance):
    with pytest.raises(ReachError) as caught:
        MODEL.inverse(*place)
    assert str(caught.value) == (
        f"The tip can be 0.1 to 0.9 m from the shoulder; ({place[0]:g}, {place[1]:g}) is {distance} m away: "
        "choose another place."
    )


def test_the_links_are_drawn_end_to_end():
    arm = alone(ArmModel(dataclasses.replace(FAST, start=0.5), FAST), start=(1.0, 2.0, math.pi / 2))
    turn = math.pi / 2 + 0.5
    assert [(body.name, body.kind) for body in arm.world.bodies] == [
        ("upper_arm", "link"),
        ("forearm", "link"),
    ]
    upper, fore = arm.poses
    assert upper == (1.0, 2.0, pytest.approx(turn))
    assert fore == pytest.approx((1 + 0.5 * math.cos(turn), 2 + 0.5 * math.sin(turn), turn))


def test_both_joints_go_to_their_positions_cut_to_the_limits():
    arm = alone(MODEL)
    arm.command((1.0, -7.0))
    arm.advance(3)
    assert (arm.positions, arm.velocities) == ((1.0, -2.0), (0.0, 0.0))
    assert arm.desired == ((1.0, -2.0), (0.0, 0.0))


@pytest.mark.parametrize("positions", [[1.0], [1.0, math.nan], [1.0, 2.0, 3.0], []])
def test_a_command_of_another_form_is_refused(positions):
    arm = alone(MODEL)
    with pytest.raises(CommandError) as caught:
        arm.command(positions)
    assert str(caught.value) == (
        "A command is one finite number (rad) for each of the 2 joints; "
        f"this one was {positions}: check how it was calculated."
    )
    arm.advance(1)
    assert arm.positions == (0.0, 0.0)


CUBIC = [Waypoint(1.0, (0.6, -0.4), (0.5, 0.0)), Waypoint(2.0, (1.0, 0.4), (0.0, 0.0))]


def hermite(t, q0, v0, q1, v1):
    """The cubic over one second, in the usual basis."""
    return (
        (2 * t**3 - 3 * t**2 + 1) * q0
        + (t**3 - 2 * t**2 + t) * v0
        + (3 * t**2 - 2 * t**3) * q1
        + (t**3 - t**2) * v1
    )


def test_waypoints_with_velocities_are_joined_by_cubics_and_followed_exactly():
    arm = alone(MODEL)
    trajectory = arm.follow(CUBIC)
    assert trajectory.end == 2.0
    for t in steps(arm, 3):
        wanted = (0.0, 0.0)
        if t <= 1:
            wanted = hermite(t, 0, 0, 0.6, 0.5), hermite(t, 0, 0, -0.4, 0)
        elif t <= 2:
            wanted = hermite(t - 1, 0.6, 0.5, 1.0, 0), hermite(t - 1, -0.4, 0, 0.4, 0)
        else:
            wanted = 1.0, 0.4
        assert arm.desired[0] == pytest.approx(wanted)
        assert arm.positions == pytest.approx(wanted, abs=1e-9)


def test_waypoints_without_velocities_are_joined_by_straight_lines():
    """The joints can't jump to a speed, but are back on the line after speed / acceleration, and never off by
    more than speed^2 / (2 acceleration)."""
    arm = alone(MODEL)
    arm.follow([Waypoint(1.0, (0.5, 0.0)), Waypoint(2.0, (0.5, 1.0)), Waypoint(3.0, (0.0, 1.0))])
    for t in steps(arm, 4):
        wanted = 0.5 * min(t, 1) - 0.5 * min(max(t - 2, 0), 1), min(max(t - 1, 0), 1)
        assert arm.desired[0] == pytest.approx(wanted)
        assert arm.positions == pytest.approx(wanted, abs=1.0 / 20 + 1e-3)
    arm.advance(4.2)
    assert (arm.positions, arm.velocities) == ((0.0, 1.0), (0.0, 0.0))


def test_a_trajectory_too_fast_for_the_joints_is_followed_as_fast_as_they_can():
    arm = alone(MODEL)
    arm.follow([Waypoint(0.2, (1.5, 0.0))])
    previous = 0.0
    for _ in steps(arm, 2):
        (speed, _) = arm.velocities
        assert abs(speed) <= 3.0 and abs(speed - previous) <= 0.1 + 1e-9
        previous = speed
        if arm.positions == (1.5, 0.0):
            break
    assert arm.time == pytest.approx(1.5 / 3 + 3 / 10, abs=0.02)


def test_a_cubic_that_swings_beyond_a_limit_is_cut_there():
    arm = alone(MODEL)
    arm.follow([Waypoint(1.0, (1.9, 0.0), (3.0, 0.0)), Waypoint(2.0, (1.0, 0.0), (0.0, 0.0))])
    places = [arm.positions[0] for _ in steps(arm, 3)]
    assert max(places) == pytest.approx(2.0, abs=0.01)
    assert max(places) <= 2.0
    assert places[-1] == 1.0


def test_a_trajectory_begins_where_the_arm_is_and_how_it_moves():
    arm = alone(MODEL)
    arm.command((1.0, 0.0))
    arm.advance(0.2)
    place, speed = arm.positions[0], arm.velocities[0]
    assert speed == pytest.approx(2.0)
    arm.follow([Waypoint(1.0, (1.0, 0.0), (0.0, 0.0))])
    for t in steps(arm, 1):
        assert arm.positions[0] == pytest.approx(hermite(t - 0.2, place, speed, 1.0, 0), abs=1e-9)


def test_a_trajectory_can_begin_later_or_have_begun_before():
    later, before = alone(MODEL), alone(MODEL)
    assert later.follow(CUBIC, delay=0.5).end == 2.5
    later.advance(0.5)
    assert later.positions == (0.0, 0.0)
    before.advance(3.0)
    assert [w.time for w in before.follow(CUBIC, delay=-1.5).waypoints] == [3.0, 3.5]
    later.advance(2.5)
    before.advance(4.5)  # it was late, and needs longer
    assert later.positions == before.positions == pytest.approx((1.0, 0.4))


def test_hold_brakes_and_stays():
    arm = alone(MODEL)
    arm.command((2.0, 0.0))
    arm.advance(0.3)
    stop = arm.positions[0] + 3.0**2 / 20
    assert arm.velocities[0] == pytest.approx(3.0)
    arm.hold()
    arm.advance(0.61)
    assert (arm.positions, arm.velocities) == ((pytest.approx(stop), 0.0), (0.0, 0.0))
    arm.advance(2.0)
    assert arm.positions[0] == pytest.approx(stop)


def orders(rng, joint):
    """An endless mix of commands for an arm, most of it more than its joints can do."""

    def angle():
        return rng.uniform(joint.lower, joint.upper)

    while True:
        if rng.random() < 0.4:
            yield lambda arm: arm.command((3 * angle(), 3 * angle()))
        elif rng.random() < 0.2:
            yield lambda arm: arm.hold()
        else:
            moments = sorted(rng.uniform(0, 4) for _ in range(rng.randint(1, 5)))
            speed = rng.choice([0.0, 0.5, -1.0]) * joint.max_velocity
            points = [Waypoint(t, (angle(), angle()), (speed, -speed)) for t in moments[:-1]]
            points.append(Waypoint(moments[-1], (angle(), angle()), rng.choice([None, (0.0, 0.0)])))
            yield lambda arm, points=points: arm.follow(points, rng.choice([0.0, 0.2, -0.1]))


@pytest.mark.parametrize("seed", range(40))
def test_no_command_makes_a_joint_exceed_a_limit(seed):
    """Neither of place, nor of speed, nor of acceleration; and speed is what places change by."""
    rng = random.Random(seed)
    joint = JointModel(
        -rng.uniform(0.1, 3), rng.uniform(0.1, 3), 0.0, rng.uniform(0.2, 5), rng.uniform(0.3, 30)
    )
    arm = alone(ArmModel(joint, joint))
    order = orders(rng, joint)
    for _ in range(12):
        next(order)(arm)
        place, speed = arm.positions[0], arm.velocities[0]
        for _ in steps(arm, rng.uniform(0.01, 2)):
            before, slower, place, speed = place, speed, arm.positions[0], arm.velocities[0]
            assert joint.lower <= place <= joint.upper
            assert abs(speed) <= joint.max_velocity
            assert abs(speed - slower) / 0.01 <= joint.max_acceleration * (1 + 1e-6)
            assert abs(place - before - (speed + slower) / 200) <= joint.max_acceleration * 0.01**2
    arm.command((joint.upper, joint.lower))
    arm.advance(arm.time + 60)
    assert (arm.positions, arm.velocities) == ((joint.upper, joint.lower), (0.0, 0.0))


def test_each_joint_of_an_arm_has_the_noise_of_its_own_encoder():
    noisy = dataclasses.replace(MODEL, elbow=dataclasses.replace(FAST, position_noise=0.001))
    arm = alone(noisy, seed=1)
    shoulder, elbow, *velocities = arm.measure()
    assert shoulder == 0.0 != elbow
    assert velocities == [0.0, 0.0]
    assert alone(MODEL).measure() == (0.0, 0.0, 0.0, 0.0)
