"""The robot against walls, boxes and circles: it stops, slips, and says what it touched and where."""

import math

import pytest

from sim.world import DT, Box, Circle, RobotModel, Simulation, World

BOUNDS = (-5, -5, 5, 5)
RADIUS = RobotModel().radius
MILLIMETER = 1e-3 + 1e-9  # and the rounding of coordinates
WALL = ((1.0, -5.0), (1.0, 5.0))


def world(start=(0, 0, 0), **obstacles):
    return World("test", "", BOUNDS, start, **obstacles)


def drive(simulation, v, w, until):
    """Command (v, w) at 10 Hz and return x after each step."""
    xs = []
    for tick in range(round(simulation.time * 10), round(until * 10)):
        simulation.robot.command(v, w)
        for step in range(1, 11):
            simulation.advance(tick / 10 + step / 100)
            xs.append(simulation.robot.pose[0])
    return xs


@pytest.mark.parametrize(
    "obstacles",
    [
        {"walls": (WALL,)},
        {"boxes": (Box(1.5, 0, 0, 1, 1),)},
        {"boxes": (Box(1 + math.sqrt(0.5), 0, math.pi / 4, 1, 1),)},
        {"circles": (Circle(1.5, 0, 0.5),)},
    ],
    ids=["wall", "box", "corner of a box", "circle"],
)
@pytest.mark.parametrize("v", [0.1, 0.6])
def test_robot_stops_at_an_obstacle_within_a_millimeter(obstacles, v):
    simulation = Simulation(world(**obstacles))
    depths = [x - (1 - RADIUS) for x in drive(simulation, v, 0, until=12)]
    first = next(index for index, depth in enumerate(depths) if depth > 0)
    assert depths[first] <= v * DT  # a step ends before its collisions are found
    assert min(depths[first + 1 :]) >= 0 and max(depths[first + 1 :]) <= MILLIMETER


@pytest.mark.parametrize("v", [0.6, 3.0, 10.0])
def test_no_speed_takes_the_robot_through_a_thin_wall(v):
    fast = RobotModel(max_v=v, max_acceleration=50, max_force=200)
    simulation = Simulation(world(walls=(WALL,), robot=fast))
    assert max(drive(simulation, v, 0, until=4)) < 1


def test_wheels_slip_while_the_robot_is_blocked():
    simulation = Simulation(world(walls=(WALL,)))
    drive(simulation, 0.5, 0, until=10)
    assert simulation.robot.pose[0] < 0.902
    assert simulation.robot.odometry.x == pytest.approx(10 * 0.5 - 0.065)  # 0.065 m are lost to the ramp
    assert simulation.robot.odometry.v == 0.5


def test_blocked_robot_is_not_pulled_after_its_wheels_later():
    simulation = Simulation(world(walls=(WALL,)))
    drive(simulation, 0.5, 0, until=10)
    drive(simulation, -0.5, 0, until=11)
    # The wheels turn back after 0.25 s, ramp for another 0.25 s and drive 0.5 s at 0.5 m/s.
    assert simulation.robot.pose[0] == pytest.approx(0.9 - 0.0625 - 0.25, abs=0.01)


def test_robot_slides_along_a_wall_and_keeps_its_heading():
    heading = math.radians(60)
    simulation = Simulation(world(start=(0, 0, heading), walls=(WALL,)))
    drive(simulation, 0.5, 0, until=8)
    x, y, yaw = simulation.robot.pose
    assert 0 <= x - (1 - RADIUS) <= MILLIMETER
    assert y > 2.5
    assert yaw == pytest.approx(heading, abs=0.02)


@pytest.mark.parametrize(
    ("heading", "v", "side"),
    [
        (0, 0.5, "front"),
        (math.pi, -0.5, "back"),
        (math.radians(-70), 0.5, "left"),
        (math.radians(70), 0.5, "right"),
    ],
)
def test_bumper_names_the_side_that_touches(heading, v, side):
    simulation = Simulation(world(start=(0.8, 0, heading), walls=(WALL,)))
    assert simulation.robot.bumper == frozenset()
    drive(simulation, v, 0, until=2)
    assert simulation.robot.bumper == {side}
    assert simulation.contacts[0].side == side


def test_bumper_follows_a_robot_that_turns_while_it_touches():
    simulation = Simulation(world(start=(0.8, 0, 0), walls=(WALL,)))
    drive(simulation, 0.5, 0, until=1)
    drive(simulation, 0.0, 1.0, until=2.6)
    assert simulation.robot.bumper == {"right"}
    assert [contact.side for contact in simulation.contacts] == ["front"]


def test_both_sides_are_pressed_in_a_corner():
    walls = (WALL, ((-5.0, 1.0), (5.0, 1.0)))
    simulation = Simulation(world(start=(0.8, 0.8, math.radians(40)), walls=walls))
    drive(simulation, 0.5, 0, until=3)
    assert simulation.robot.bumper == {"front", "left"}
    assert len([contact for contact in simulation.contacts if contact.end is None]) == 2


@pytest.mark.parametrize(
    ("what", "obstacles"),
    [
        ("wall", {"walls": (WALL,)}),
        ("box", {"boxes": (Box(1.5, 0, 0, 1, 1),)}),
        ("circle", {"circles": (Circle(1.5, 0, 0.5),)}),
    ],
)
def test_a_contact_has_time_position_and_kind(what, obstacles):
    simulation = Simulation(world(**obstacles))
    drive(simulation, 0.5, 0, until=3)
    (contact,) = simulation.contacts
    assert (contact.side, contact.what, contact.end) == ("front", what, None)
    assert (contact.x, contact.y) == pytest.approx((1, 0), abs=1e-6)
    # 0.9 m at 0.5 m/s; the ramp costs 0.13 s.
    assert contact.stamp == pytest.approx(0.9 / 0.5 + 0.13, abs=0.0101)

    drive(simulation, -0.5, 0, until=4)
    (contact,) = simulation.contacts
    assert 3.2 < contact.end < 3.4
    assert simulation.robot.bumper == frozenset()


def test_touching_twice_is_two_contacts():
    simulation = Simulation(world(start=(0.8, 0, 0), walls=(WALL,)))
    for tick, v in enumerate((0.5, -0.5, 0.5, -0.5), start=1):
        drive(simulation, v, 0, until=tick)
    first, second = simulation.contacts
    assert first.stamp < first.end < second.stamp < second.end


def test_lists_handed_out_are_copies():
    simulation = Simulation(world(start=(0.8, 0, 0), walls=(WALL,)))
    drive(simulation, 0.5, 0, until=1)
    simulation.contacts.clear()
    assert len(simulation.contacts) == 1
