"""How near a robot came to people while it drove."""

import pytest

from grader.checks import nearest_person
from sim import World, run
from sim.evidence import Pose
from sim.world import Person
from tests.sim.recordings import recording
from tests.students.engine.drivers import Driver

FARTHER = Person(((2.0, 3.0), (2.0, 3.2)), speed=0.1)
NEARER = Person(((2.0, 1.0), (2.0, 1.2)), speed=0.1)


class Idle(Driver):
    v = 0.0


def drive(node, *people):
    return run(node, world=World("hall", "", (-4, -4, 6, 4), (0, 0, 0), people=people), seconds=6, quiet=True)


@pytest.mark.parametrize("people", [(NEARER, FARTHER), (FARTHER, NEARER)])
def test_the_nearest_of_all_and_of_all_moments(people):
    away, stamp, speed = nearest_person(drive(Driver, *people), faster=0.3)
    assert (away, stamp, speed) == pytest.approx((0.9, 4.3, 0.5), abs=0.3)


def test_no_one_is_near_a_robot_that_is_slower_or_alone():
    assert nearest_person(drive(Driver, NEARER), faster=0.6) is None
    assert nearest_person(drive(Idle, NEARER), faster=0.0) is None
    assert nearest_person(drive(Driver), faster=0.0) is None
    assert nearest_person(run(seconds=0.1), faster=0.0) is None


def test_a_moment_at_which_a_person_was_not_seen_does_not_count():
    world = World("hall", "", (-4, -4, 6, 4), (0, 0, 0), people=(NEARER,))
    path = [Pose(float(n), float(n), 0.0, 0.0) for n in range(4)]
    seen = {"person_1": [Pose(1.0, 2.0, 1.0, 0.0)]}
    away, stamp, speed = nearest_person(recording(world=world, path=path, tracks=seen), faster=0.5)
    assert (away, stamp, speed) == (pytest.approx(2**0.5 - NEARER.radius), 1.0, 1.0)
