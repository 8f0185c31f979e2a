"""Time, path, determinism and the layer of `sim.world`."""

import hashlib
import math
import subprocess
import sys
from pathlib import Path

import pytest

from sim.world import Simulation, World
from tests.sim.world.mobile import MOBILE

ROOT = Path(__file__).parents[3]


def digest(world, seed):
    """A hash of everything a 20 s drive with collisions, seen by all sensors, gives."""
    simulation = Simulation(World.load(world), seed=seed)
    h = hashlib.sha256()
    for tick in range(200):
        simulation.robot.command(0.5, 0.9 * math.sin(tick / 10))
        simulation.advance((tick + 1) / 10)
        for robot in simulation.robots.values():
            h.update(robot.scan().tobytes())
            h.update(repr((robot.odometry, robot.wheels, sorted(robot.bumper), robot.imu())).encode())
        h.update(repr(simulation.poses).encode())
    h.update(repr([robot.contacts for robot in simulation.robots.values()]).encode())
    return h.hexdigest()


def test_time_is_a_whole_number_of_steps():
    simulation = Simulation(World.load("yard"))
    for step in range(1, 6001):
        simulation.advance(step * 0.01)
        assert simulation.time == step / 100


@pytest.mark.parametrize(
    ("until", "time"),
    [
        (0.0, 0.0),
        (0.0099, 0.0),
        (0.01, 0.01),
        (0.29, 0.29),
        (0.1 + 0.2, 0.3),
        (0.999999999, 1.0),
        (1.234, 1.23),
    ],
)
def test_advance_does_the_steps_that_end_by_then(until, time):
    simulation = Simulation(World.load("yard"))
    simulation.advance(until)
    assert simulation.time == time


def test_time_never_goes_back():
    simulation = Simulation(World.load("yard"))
    simulation.advance(1)
    simulation.advance(0.5)
    assert simulation.time == 1


def test_how_advance_is_called_does_not_matter():
    whole, steps = (Simulation(World.load("room")) for _ in range(2))
    for simulation in (whole, steps):
        simulation.robot.command(0.5, 0.5)
    whole.advance(2)
    for step in range(1, 401):
        steps.advance(step / 200)
    assert whole.poses == steps.poses
    assert whole.robot.odometry == steps.robot.odometry


@pytest.mark.parametrize("world", MOBILE)
def test_equal_seeds_give_equal_bytes(world):
    assert digest(world, seed=3) == digest(world, seed=3)


def test_the_seed_changes_the_noise_and_nothing_else():
    first, second = (Simulation(World.load("room"), seed=seed) for seed in (1, 2))
    assert first.robot.scan().tobytes() != second.robot.scan().tobytes()
    for simulation in (first, second):
        simulation.robot.command(0.5, 0.3)
        simulation.advance(5)
    assert first.poses == second.poses


def test_another_process_gives_equal_bytes():
    code = f"import sys; sys.path[:0] = [{str(ROOT)!r}, {str(Path(__file__).parent)!r}]\n"
    code += "from test_simulation import digest; print(digest('room', 3))"
    runs = [
        subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True) for _ in "ab"
    ]
    assert [run.stdout.strip() for run in runs] == [digest("room", 3)] * 2


def test_collisions_write_nothing(capfd):
    digest("corridor", 3)
    assert capfd.readouterr() == ("", "")


def test_the_world_knows_no_ros_no_notebook_and_no_grader():
    code = f"""
import importlib, pkgutil, sys
from pathlib import Path
sys.path.insert(0, {str(ROOT)!r})
before = set(sys.modules)
package = type(sys)("sim"); package.__path__ = [{str(ROOT / "sim")!r}]; sys.modules["sim"] = package
import sim.world
for module in pkgutil.iter_modules(sim.world.__path__, "sim.world."):
    importlib.import_module(module.name)
print(*sorted({{name.split(".")[0] for name in set(sys.modules) - before}}))
"""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = set(run.stdout.split())
    assert {"sim", "pymunk", "numpy"} <= loaded
    assert not loaded & {
        "rclpy",
        "geometry_msgs",
        "sensor_msgs",
        "IPython",
        "matplotlib",
        "nbgrader",
        "grader",
    }
