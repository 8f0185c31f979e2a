"""The drive against closed forms: ramps, lines, arcs, limits, timeout, odometry."""

import math
from dataclasses import replace

import pytest

from sim.world import DT, CommandError, RobotModel, Simulation, World
from sim.world.robot import wrap

MODEL = RobotModel()
YARD = World.load("yard")


def keep_driving(simulation, v, w, until, period=0.1):
    """Command (v, w) every period until the time `until`, as a controller does."""
    for tick in range(round(simulation.time / period), round(until / period)):
        simulation.robot.command(v, w)
        simulation.advance((tick + 1) * period)


def in_map(odometry, start):
    """The odometry's pose, moved from the odom frame into the map frame."""
    x0, y0, yaw0 = start
    c, s = math.cos(yaw0), math.sin(yaw0)
    return x0 + c * odometry.x - s * odometry.y, y0 + s * odometry.x + c * odometry.y, odometry.yaw + yaw0


def test_nothing_moves_without_a_command():
    simulation = Simulation(YARD)
    simulation.advance(3)
    assert simulation.robot.pose == YARD.start
    assert simulation.robot.odometry == (0, 0, 0, 0, 0)
    assert simulation.robot.wheels == (0, 0, 0, 0)


def test_the_odometry_of_a_robot_that_has_driven_before_continues_from_there():
    start = (1.0, -2.0, 0.5)
    simulation = Simulation(replace(YARD, start=start, robot=RobotModel(odometry=start)))
    assert simulation.robot.odometry == (*start, 0, 0)
    assert simulation.robot.wheels == (0, 0, 0, 0)
    keep_driving(simulation, 0.4, 0.6, until=2)
    assert simulation.robot.odometry[:3] == pytest.approx(simulation.robot.pose, abs=1e-6)


def test_speed_ramps_up_at_the_greatest_acceleration():
    simulation = Simulation(YARD)
    simulation.robot.command(0.5, 1.0)
    for step in range(1, 40):
        simulation.advance(step * DT)
        odometry = simulation.robot.odometry
        assert odometry.v == pytest.approx(min(MODEL.max_acceleration * step * DT, 0.5))
        assert odometry.w == pytest.approx(min(MODEL.max_angular_acceleration * step * DT, 1.0))


def test_straight_line_is_the_sum_of_its_steps():
    simulation = Simulation(YARD)
    keep_driving(simulation, 0.5, 0, until=4)
    ramp = [MODEL.max_acceleration * DT * step for step in range(25)]
    distance = DT * (sum(ramp) + 0.5 * (400 - len(ramp)))
    assert simulation.robot.pose == pytest.approx((distance, 0, 0), abs=1e-9)
    assert simulation.robot.odometry == pytest.approx((distance, 0, 0, 0.5, 0), abs=1e-9)


def test_backwards_is_the_mirror_of_forwards():
    forwards, backwards = Simulation(YARD), Simulation(YARD)
    keep_driving(forwards, 0.4, 0, until=2)
    keep_driving(backwards, -0.4, 0, until=2)
    assert backwards.robot.pose == pytest.approx((-forwards.robot.pose[0], 0, 0), abs=1e-12)


def test_steady_turn_is_an_exact_circle():
    simulation = Simulation(YARD)
    v, w = 0.4, 0.8
    keep_driving(simulation, v, w, until=1)
    x, y, yaw = simulation.robot.pose
    center = x - v / w * math.sin(yaw), y + v / w * math.cos(yaw)
    for tenth in range(11, 101):
        keep_driving(simulation, v, w, until=tenth / 10)
        x, y, now = simulation.robot.pose
        assert math.dist(center, (x, y)) == pytest.approx(v / w, abs=1e-9)
        assert now == pytest.approx(wrap(yaw + w * (tenth / 10 - 1)), abs=1e-9)


@pytest.mark.parametrize("start", [(0, 0, 0), (1.0, -2.0, 2.5)])
def test_odometry_is_exact_in_free_space(start):
    simulation = Simulation(World("free", "", YARD.bounds, start))
    for tick in range(1, 601):
        simulation.robot.command(0.6 if tick // 30 % 2 else -0.3, 2.5 * math.sin(tick / 10))
        simulation.advance(tick / 10)
        x, y, yaw = in_map(simulation.robot.odometry, start)
        assert simulation.robot.pose[:2] == pytest.approx((x, y), abs=1e-9)
        assert wrap(simulation.robot.pose[2] - yaw) == pytest.approx(0, abs=1e-9)


def test_yaw_stays_above_minus_pi_and_up_to_pi():
    simulation = Simulation(YARD)
    yaws = []
    for tick in range(1, 101):
        keep_driving(simulation, 0, 2.0, until=tick / 10)
        yaws += [simulation.robot.pose[2], simulation.robot.odometry.yaw]
    assert min(yaws) > -math.pi and max(yaws) <= math.pi
    assert max(yaws) > 3 and min(yaws) < -3


@pytest.mark.parametrize(
    ("angle", "wrapped"),
    [(0, 0), (math.pi, math.pi), (-math.pi, math.pi), (3 * math.pi, math.pi), (1.5 * math.pi, -math.pi / 2)],
)
def test_wrap(angle, wrapped):
    assert wrap(angle) == pytest.approx(wrapped)


def test_wheels_follow_the_kinematics():
    simulation = Simulation(YARD)
    keep_driving(simulation, 0.3, 1.0, until=5)
    wheels, lever = simulation.robot.wheels, MODEL.track_width / 2
    assert wheels.left_rate == pytest.approx((0.3 - lever * 1.0) / MODEL.wheel_radius)
    assert wheels.right_rate == pytest.approx((0.3 + lever * 1.0) / MODEL.wheel_radius)
    turned = (wheels.right - wheels.left) * MODEL.wheel_radius / MODEL.track_width
    assert wrap(turned) == pytest.approx(simulation.robot.odometry.yaw)
    ramp_v, ramp_w = 15, 13  # first steps at full speed: 0.3 / (2 * DT), 1.0 / (8 * DT)
    length = DT * (sum(0.02 * step for step in range(ramp_v)) + 0.3 * (500 - ramp_v))
    angle = DT * (sum(0.08 * step for step in range(ramp_w)) + 1.0 * (500 - ramp_w))
    assert wheels.left == pytest.approx((length - lever * angle) / MODEL.wheel_radius)
    assert wheels.right == pytest.approx((length + lever * angle) / MODEL.wheel_radius)


@pytest.mark.parametrize("sign", [1, -1])
def test_commands_are_cut_to_the_limits(sign):
    simulation = Simulation(YARD)
    keep_driving(simulation, sign * 99.0, sign * 99.0, until=1)
    assert simulation.robot.odometry[3:] == (sign * MODEL.max_v, sign * MODEL.max_w)


def test_robot_ramps_down_half_a_second_after_the_last_command():
    simulation = Simulation(YARD)
    simulation.robot.command(0.4, 0)
    simulation.advance(0.5)
    assert simulation.robot.odometry.v == 0.4
    simulation.advance(0.51)
    assert simulation.robot.odometry.v == pytest.approx(0.4 - MODEL.max_acceleration * DT)
    simulation.advance(0.7)
    assert simulation.robot.odometry.v == pytest.approx(0)
    still = simulation.robot.pose
    simulation.advance(5)
    assert simulation.robot.pose == pytest.approx(still, abs=1e-9)


def test_every_command_starts_the_timeout_anew():
    simulation = Simulation(YARD)
    keep_driving(simulation, 0.4, 0, until=4, period=0.5)
    assert simulation.robot.odometry.v == 0.4


@pytest.mark.parametrize(
    ("v", "w", "seen"),
    [
        (math.nan, 0.0, "nan m/s and 0.0 rad/s"),
        (0.1, math.inf, "0.1 m/s and inf rad/s"),
        (-math.inf, 0.0, "-inf m/s and 0.0 rad/s"),
    ],
)
def test_a_command_that_is_not_finite_is_refused_and_changes_nothing(v, w, seen):
    simulation = Simulation(YARD)
    keep_driving(simulation, 0.4, 0, until=1)
    with pytest.raises(CommandError) as caught:
        simulation.robot.command(v, w)
    assert str(caught.value) == (
        f"Velocity commands are finite numbers; this one was {seen}: check how it was calculated."
    )
    simulation.advance(1.2)
    assert simulation.robot.odometry.v == 0.4
