"""Machines in world files and worlds."""

import pytest

from sim.world import Simulation, World, WorldError, simulate
from sim.world.machines import Arm, ArmModel, CartPole, CartPoleModel, Joint, JointModel, Pond, PondModel
from tests.sim.world.files import CARD, load


def machine_world(folder, table):
    return load(folder, f"bounds = [-1, -1, 1, 1]\n{table}\n{CARD}")


@pytest.mark.parametrize(
    ("table", "machine"),
    [
        ("[joint]\nlower = -1\nmax_velocity = 3", JointModel(lower=-1.0, max_velocity=3.0)),
        ("[arm.elbow]\nlength = 0.3", ArmModel(elbow=JointModel(length=0.3))),
        ("[cart_pole]\nangle_noise = 0.01", CartPoleModel(angle_noise=0.01)),
        ("[pond]\nbackground = [1, 2, 3]", PondModel((1, 2, 3))),
    ],
)
def test_a_table_becomes_the_machine_of_the_world(tmp_path, table, machine):
    world = machine_world(tmp_path, table)
    assert (world.machine, world.start, world.bodies) == (machine, (0.0, 0.0, 0.0), machine.bodies)


@pytest.mark.parametrize(
    ("name", "kind"), [("joint", Joint), ("arm", Arm), ("cart_pole", CartPole), ("turtlesim", Pond)]
)
def test_a_named_world_is_simulated_by_its_machine_and_fits_its_picture(name, kind):
    world = World.load(name)
    scene = simulate(world, 1)
    assert type(scene) is kind
    scene.advance(1.0)
    assert len(scene.poses) == len(world.bodies) == len({body.name for body in world.bodies})
    xmin, ymin, xmax, ymax = world.bounds
    assert all(xmin < x < xmax and ymin < y < ymax for x, y, _ in scene.poses)


def test_a_world_without_a_machine_has_a_mobile_robot():
    assert type(simulate(World.load("room"), 1)) is Simulation


@pytest.mark.parametrize(
    ("table", "sentence"),
    [
        ("[joint]\nlowr = 1", "joint.lowr is not a known key; did you mean lower?"),
        (
            "[arm.shoulder]\nlower = 3",
            "arm.shoulder.lower is 3.0; write an angle (radians) below upper, which is 1.5708.",
        ),
        ("[arm]\nwrist = 3", "arm.wrist is not a known key; the keys are shoulder, elbow, elbow_first."),
        (
            "[cart_pole]\npole_length = 0",
            "cart_pole.pole_length is 0; write a number from 0.0001 to 1000 (meters).",
        ),
        ("[joint]\n[arm]", "joint and arm are both here; keep one of them."),
    ],
)
def test_faulty_tables(tmp_path, table, sentence):
    with pytest.raises(WorldError) as caught:
        machine_world(tmp_path, table)
    assert str(caught.value) == f"mine.toml: {sentence}"


@pytest.mark.parametrize("machine", [3, "joint", JointModel])
def test_a_machine_is_one_of_the_models(machine):
    with pytest.raises(WorldError) as caught:
        World("test", "", (-1, -1, 1, 1), machine=machine)
    assert str(caught.value) == (
        f"World: machine is {machine!r}; write one of JointModel, ArmModel, CartPoleModel, PondModel."
    )
