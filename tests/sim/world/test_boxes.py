"""Boxes that can be pushed: friction by its closed forms, walls, contacts, and what the lidar sees."""

import math

import numpy as np
import pytest

from sim.world import DT, Body, Box, LidarModel, MovableBox, RobotModel, Simulation, World, WorldError

GRAVITY = 9.80665
RADIUS, FORCE = RobotModel().radius, RobotModel().max_force
MILLIMETER = 1e-3
QUIET = LidarModel(noise=0)


def simulation(*boxes, start=(0.0, 0.0, 0.0), **more):
    return Simulation(World("test", "", (-5, -5, 5, 5), start, movable=boxes, lidar=QUIET, **more))


def drive(simulation, v, until, w=0.0):
    """Command (v, w) at 10 Hz and return the first box's pose after each step."""
    poses = []
    for tick in range(round(simulation.time * 10), round(until * 10)):
        simulation.robot.command(v, w)
        for step in range(1, 11):
            simulation.advance(tick / 10 + step * DT)
            poses.append(simulation.poses[1])
    return poses


def spread(box, count=400):
    """The mean distance of the box's points from its center, by summing over a grid."""
    u = (np.arange(count) + 0.5) / count - 0.5
    return np.hypot(*np.meshgrid(u * box.width, u * box.height)).mean()


@pytest.mark.parametrize("friction", [0.05, 0.1, 0.15])
@pytest.mark.parametrize("mass", [0.2, 0.5])
def test_a_box_slides_on_by_the_law_of_friction_when_the_robot_brakes(friction, mass):
    """The robot brakes at 2 m/s^2, the box more gently: so it leaves the robot and slides v^2 / (2 mu g)."""
    v = 0.5
    pushed = simulation(MovableBox(0.5, 0, 0, 0.3, 0.3, mass=mass, friction=friction))
    x1, x2 = (pose[0] for pose in drive(pushed, v, until=3)[-2:])
    assert (x2 - x1) / DT == pytest.approx(v)
    at_rest = drive(pushed, 0, until=6)[-1]
    # Velocity changes in steps, each of which ends with the speed that it began with: half a step more.
    assert at_rest[0] - x2 == pytest.approx(v**2 / (2 * friction * GRAVITY) + v * DT / 2, abs=1e-4)
    assert at_rest[1:] == pytest.approx((0, 0), abs=1e-9)


@pytest.mark.parametrize("share", [0.8, 0.95, 0.99])
def test_a_force_above_the_floors_grip_moves_a_box(share):
    friction = share * FORCE / GRAVITY
    pushed = simulation(MovableBox(0.251, 0, 0, 0.3, 0.3, mass=1.0, friction=friction))
    assert drive(pushed, 0.1, until=4)[-1][0] > 0.251 + 0.25


@pytest.mark.parametrize("share", [1.01, 1.05, 2.0])
def test_a_force_below_the_floors_grip_moves_no_box(share):
    friction = share * FORCE / GRAVITY
    pushed = simulation(MovableBox(0.251, 0, 0, 0.3, 0.3, mass=1.0, friction=friction))
    assert drive(pushed, 0.01, until=60)[-1][0] == pytest.approx(0.251, abs=1.5 * MILLIMETER)
    assert pushed.robot.odometry.x > 0.5


def test_a_heavy_box_stops_the_robot():
    pushed = simulation(MovableBox(1.0, 0, 0, 0.3, 0.3, mass=20.0))
    drive(pushed, 0.6, until=6)
    assert pushed.poses[1][0] == pytest.approx(1.0, abs=MILLIMETER)
    assert pushed.robot.pose[0] == pytest.approx(0.85 - RADIUS, abs=2 * MILLIMETER)
    assert pushed.robot.odometry.x > 3


def test_a_box_alone_stays_where_it_is():
    still = simulation(MovableBox(1.0, 2.0, 0.7, 0.3, 0.5))
    still.advance(10)
    assert still.poses[1] == (1.0, 2.0, 0.7)


def test_the_floor_slows_a_turning_box_by_its_twist_grip():
    box = MovableBox(1.0, 0, 0, 0.6, 0.2, mass=1.0, friction=0.3)
    assert box.max_friction_force == pytest.approx(0.3 * GRAVITY)
    assert box.max_friction_torque == pytest.approx(box.max_friction_force * spread(box), rel=1e-4)


@pytest.mark.parametrize("turn", [0.0, 0.3, math.pi / 4])
def test_a_pushed_box_does_not_go_through_a_wall(turn):
    pushed = simulation(MovableBox(1.0, 0.0, turn, 0.3, 0.3), walls=(((1.6, -5.0), (1.6, 5.0)),))
    box = pushed.world.movable[0]
    for x, y, yaw in drive(pushed, 0.6, until=8):
        moved = MovableBox(x, y, yaw, box.width, box.height)
        assert max(corner[0] for corner in moved.corners()) < 1.6 + 0.6 * DT
    assert pushed.robot.odometry.x > 2


def test_one_box_pushes_the_next():
    pushed = simulation(MovableBox(0.5, 0, 0, 0.3, 0.3), MovableBox(0.9, 0, 0, 0.3, 0.3))
    drive(pushed, 0.3, until=4)
    _, near, far = pushed.poses
    assert near[0] > 0.9
    assert far[0] - near[0] == pytest.approx(0.3, abs=2 * MILLIMETER)


def test_a_box_pushed_off_its_middle_turns():
    pushed = simulation(MovableBox(0.5, 0.1, 0, 0.3, 0.3))
    assert drive(pushed, 0.3, until=2)[-1][2] > 0.05


def test_the_robot_reports_contact_with_a_box():
    pushed = simulation(MovableBox(0.5, 0, 0, 0.3, 0.3))
    drive(pushed, 0.3, until=3)
    (contact,) = pushed.contacts
    assert (contact.what, contact.side, contact.end) == ("box", "front", None)
    assert (contact.x, contact.y) == pytest.approx((0.35, 0), abs=0.005)
    assert pushed.robot.bumper == {"front"}


def test_the_lidar_sees_a_box_where_it_is_now():
    pushed = simulation(MovableBox(0.6, 0, 0, 0.3, 0.3), start=(0.0, 0.0, math.pi))
    behind = 180
    assert pushed.robot.scan()[behind] == pytest.approx(0.45, abs=1e-6)
    drive(pushed, -0.3, until=3)
    gap = pushed.poses[1][0] - 0.15 - pushed.robot.pose[0]
    assert pushed.poses[1][0] > 0.9
    assert gap < 0.12 and pushed.robot.scan()[behind] == -math.inf
    drive(pushed, 0.3, until=5)
    gap = pushed.poses[1][0] - 0.15 - pushed.robot.pose[0]
    assert gap > 0.2 and pushed.robot.scan()[behind] == pytest.approx(gap, abs=1e-6)


def test_the_lidar_sees_a_movable_box_like_a_static_one():
    parameters = (1.0, 0.4, 0.5, 0.7, 0.3)
    still = Simulation(World("test", "", (-5, -5, 5, 5), boxes=(Box(*parameters),), lidar=QUIET))
    assert simulation(MovableBox(*parameters)).robot.scan() == pytest.approx(still.robot.scan(), abs=1e-6)


def test_boxes_are_bodies_with_an_outline_after_the_robot():
    boxes = MovableBox(1, 0, 0, 0.4, 0.2), MovableBox(2, 0, 0, 0.2, 0.2)
    robot, first, second = simulation(*boxes).world.bodies
    assert robot == Body("robot", "robot", radius=0.1)
    assert first == Body("box_1", "box", outline=((-0.2, -0.1), (0.2, -0.1), (0.2, 0.1), (-0.2, 0.1)))
    assert second.name == "box_2"


@pytest.mark.parametrize(
    ("box", "more", "sentence"),
    [
        (
            MovableBox(0.1, 0, 0, 0.4, 0.4),
            {},
            "the robot (radius 0.1 m) does not fit at the start (0, 0), where a box is; "
            "move the start or the box.",
        ),
        (
            MovableBox(2, 1, 0, 0.4, 0.4),
            {"walls": (((2.1, 0), (2.1, 2)),)},
            "box_1 does not fit at (2, 1), where a wall is; move one of the two.",
        ),
    ],
)
def test_no_room(box, more, sentence):
    with pytest.raises(WorldError) as caught:
        simulation(box, **more)
    assert str(caught.value) == f"World 'test': {sentence}"


def test_a_box_inside_another_is_refused():
    with pytest.raises(WorldError) as caught:
        simulation(MovableBox(2, 1, 0, 0.4, 0.4), MovableBox(2.1, 1.1, 0.2, 0.4, 0.4))
    assert str(caught.value) == (
        "World 'test': box_2 does not fit at (2.1, 1.1), where a box is; move one of the two."
    )


def test_boxes_may_touch():
    still = simulation(MovableBox(1, 0, 0, 0.4, 0.4), MovableBox(1.4, 0, 0, 0.4, 0.4))
    still.advance(1)
    assert still.poses[1:] == [pytest.approx((1, 0, 0)), pytest.approx((1.4, 0, 0))]
