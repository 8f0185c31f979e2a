"""People on foot: they wait for static obstacles, and for nothing that moves."""

import math

import pytest

from sim.world import Circle, MovableBox, Person, Simulation, World, WorldError

BOUNDS = (-1, -3, 12, 3)
ROUTE = ((1.0, 0.0), (11.0, 0.0), (11.0, 2.0), (1.0, 2.0))


def world(start=(0.0, -2.0, 0.0), **things):
    return World("test", "", BOUNDS, start, people=(Person(ROUTE),), **things)


def walked(simulation, until):
    simulation.advance(until)
    return simulation.poses[-1]


def test_a_person_walks_round_at_their_pace_and_looks_where_they_go():
    simulation = Simulation(world())
    assert walked(simulation, 5) == (pytest.approx(6), 0, 0)
    assert walked(simulation, 11) == (11, pytest.approx(1), pytest.approx(math.pi / 2))
    assert walked(simulation, 24)[:2] == pytest.approx((1, 0))
    assert simulation.bodies[-1] == ("person_1", "person", 0.2, ())


@pytest.mark.parametrize("thing", ["robot", "box"])
def test_a_person_waits_for_a_standing_obstacle_and_then_turns_back(thing):
    there = {"start": (6.0, 0.0, 0.0)} if thing == "robot" else {"movable": (MovableBox(6, 0, 0, 0.2, 0.2),)}
    simulation = Simulation(world(**there))
    x, _, _ = walked(simulation, 5)
    assert 0.4 < 6 - x < 1.0
    assert walked(simulation, 8)[0] == x
    assert walked(simulation, 10)[0] < x
    assert walked(simulation, 17)[1] == pytest.approx(2)  # round the other way
    simulation.advance(60)
    assert simulation.contacts == []


def test_a_person_walks_on_when_the_obstacle_has_moved_away():
    simulation = Simulation(world((6.0, 0.0, math.pi / 2)))
    x, _, _ = walked(simulation, 6)
    for tenth in range(60, 90):
        simulation.robot.command(-0.5, 0.0)
        simulation.advance(tenth / 10)
    assert walked(simulation, 9)[0] > x + 0.5
    assert simulation.contacts == []


def test_an_obstacle_beside_the_path_does_not_block():
    simulation = Simulation(world((6.0, -0.4, 0.0)))
    assert walked(simulation, 8)[0] == pytest.approx(9)
    assert simulation.contacts == []


def test_a_robot_that_moves_is_not_waited_for_and_the_touch_is_one_of_a_person():
    simulation = Simulation(world((5.0, 0.0, math.pi)))
    for tenth in range(1, 40):
        simulation.robot.command(0.4, 0.0)
        simulation.advance(tenth / 10)
    (contact, *_) = simulation.contacts
    assert contact.what == "person" and contact.side == "front"
    assert 2.5 < contact.stamp < 3.0  # 4 m less two radii, at 1.4 m/s
    assert len({round(simulation.poses[-1][0], 1), round(simulation.robot.pose[0] - 0.3, 1)}) == 1


def test_the_lidar_sees_a_person():
    simulation = Simulation(world((0.0, 0.0, 0.0)))
    assert simulation.robot.scan()[0] == pytest.approx(0.8, abs=0.05)
    simulation.advance(1)
    assert simulation.robot.scan()[0] == pytest.approx(1.8, abs=0.05)


def test_equal_runs_are_equal_however_they_are_cut():
    whole, pieces = Simulation(world()), Simulation(world())
    whole.advance(30)
    for part in range(1, 301):
        pieces.advance(part / 10)
    assert whole.poses == pieces.poses


@pytest.mark.parametrize(
    ("parameters", "sentence"),
    [
        (
            {"route": ()},
            "Person: route is []; write [[x, y], ...], two or more corners (meters), "
            "each different from the one before.",
        ),
        ({"speed": 5.0}, "Person: speed is 5.0; write a number from 0.0001 to 3 (m/s)."),
    ],
)
def test_invalid_people(parameters, sentence):
    with pytest.raises(WorldError) as caught:
        Person(**{"route": ROUTE} | parameters)
    assert str(caught.value) == sentence


def test_a_start_where_a_person_is_is_refused():
    with pytest.raises(WorldError) as caught:
        Simulation(world((1.1, 0.0, 0.0)))
    assert str(caught.value) == (
        "World 'test': the robot (radius 0.1 m) does not fit at the start (1.1, 0), where a person is; "
        "move the start or the person."
    )


def test_a_pillar_is_no_concern_of_their_own():
    """A world's author gives people a free path, like a robot's route."""
    simulation = Simulation(world(circles=(Circle(6, 0, 0.2),)))
    assert walked(simulation, 8)[0] == pytest.approx(9)
