"""Generated worlds: equal for equal seeds, always with a way through, and plain words for what cannot be."""

import hashlib
import json
import math
import random
import subprocess
import sys
from pathlib import Path

import pytest

from sim.world import RobotModel, Simulation, World, WorldError
from sim.world.generate.maze import generate_maze, longest_path, merged_walls
from tests.sim.world.files import HEADINGS
from tests.sim.world.paths import has_a_path

ROOT = Path(__file__).parents[3]
RADIUS = RobotModel().radius
KINDS = ("room", "maze", "clutter")
SMALL = {
    "room": {"width": 3.5, "height": 3.5, "boxes": 3, "circles": 1, "movable": 1},
    "maze": {"columns": 6, "rows": 5, "cell": 0.4},
    "clutter": {"width": 3.5, "height": 2.5, "density": 0.03},
}


def test_the_search_for_a_path_finds_none_through_a_narrow_gap():
    def gap(width):
        walls = (((1.0, 0.0), (1.0, 1.0)), ((1.0, 1.0 + width), (1.0, 3.0)))
        return World("test", "", (0, 0, 2, 3), (0.4, 0.4, 0), (1.6, 0.4), walls)

    assert has_a_path(gap(0.32), RADIUS)
    assert not has_a_path(gap(0.2), RADIUS)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("hundred", range(3))
def test_every_seed_leaves_a_path(kind, hundred):
    for seed in range(100 * hundred, 100 * hundred + 100):
        world = World.generate(kind, seed=seed, **SMALL[kind])
        Simulation(world)
        assert has_a_path(world, RADIUS), seed


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", range(5))
def test_the_default_sizes_leave_a_path(kind, seed):
    assert has_a_path(World.generate(kind, seed=seed), RADIUS + 0.02, step=0.03)


@pytest.mark.parametrize("kind", KINDS)
def test_equal_seeds_give_equal_worlds_and_others_do_not(kind):
    worlds = [World.generate(kind, seed=seed) for seed in range(20)]
    assert worlds == [World.generate(kind, seed=seed) for seed in range(20)]
    assert len({repr((world.walls, world.boxes, world.circles)) for world in worlds}) == 20


def fingerprint():
    """A hash of sixty worlds."""
    worlds = [World.generate(kind, seed=seed, **SMALL[kind]) for kind in KINDS for seed in range(20)]
    return hashlib.sha256(json.dumps([world.to_data() for world in worlds]).encode()).hexdigest()


def test_another_process_gives_equal_worlds():
    code = f"import sys; sys.path[:0] = [{str(ROOT)!r}, {str(Path(__file__).parent)!r}]\n"
    code += "from test_generate import fingerprint; print(fingerprint())"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == fingerprint()


@pytest.mark.parametrize("kind", KINDS)
def test_a_generated_world_has_a_name_a_card_and_comes_back_from_plain_data(kind):
    world = World.generate(kind, seed=7)
    assert world.name == f"{kind}_7"
    assert [line.split(":")[0] for line in world.card.splitlines()] == HEADINGS
    assert f"The goal is at x {world.goal[0]:g}, y {world.goal[1]:g}" in world.card
    assert f"at x {world.start[0]:g}, y {world.start[1]:g}" in world.card
    assert World.from_data(json.loads(json.dumps(world.to_data()))) == world


def test_a_room_has_the_requested_objects():
    world = World.generate("room", seed=1, width=8, height=6, boxes=3, circles=1, movable=2)
    assert world.bounds == (0, 0, 8, 6)
    assert (len(world.boxes), len(world.circles), len(world.movable)) == (3, 1, 2)
    assert "with a wall all round, 3 boxes, 1 pillar and 2 boxes to push." in world.card
    assert "with a wall all round." in World.generate("room", boxes=0, circles=0).card


@pytest.mark.parametrize("density", [0.02, 0.06])
def test_clutter_covers_the_requested_fraction(density):
    world = World.generate("clutter", seed=1, density=density)
    covered = sum(box.width * box.height for box in world.boxes)
    covered += sum(math.pi * circle.radius**2 for circle in world.circles)
    assert density <= covered / 40 < density + 0.35 * 0.35 / 40


def test_clutter_of_density_0_is_an_empty_field():
    world = World.generate("clutter", density=0)
    assert world.boxes == world.circles == ()


@pytest.mark.parametrize("loops", [0.0, 0.4, 1.0])
def test_each_cell_of_a_maze_can_be_reached(loops):
    maze = generate_maze(9, 7, loops, random.Random(1))
    inner = 8 * 7 + 9 * 6
    if loops == 0:
        assert len(maze.open) == 9 * 7 - 1  # a tree: one way to each cell
    elif loops == 1:
        assert len(maze.open) == inner
    else:
        assert 9 * 7 - 1 < len(maze.open) < inner
    ends = {longest_path(maze, (column, row))[0] for column in range(9) for row in range(7)}
    assert len(ends) == 63
    reached = {(0, 0)}
    for _ in range(63):
        reached |= {b for a, b in maze.open if a in reached} | {a for a, b in maze.open if b in reached}
    assert len(reached) == 63


def test_the_walls_of_a_maze_are_where_it_is_closed_and_as_long_as_can_be():
    maze = generate_maze(6, 5, 0.1, random.Random(2))
    lines = list(merged_walls(maze))
    length = sum(abs(x1 - x0) + abs(y1 - y0) for (x0, y0), (x1, y1) in lines)
    inner = 5 * 5 + 6 * 4
    assert length == 2 * (6 + 5) + inner - len(maze.open)
    ends = [(end, x0 == x1) for (x0, y0), (x1, y1) in lines for end in ((x0, y0), (x1, y1))]
    assert len(ends) == len(set(ends))  # no two lines could be one


@pytest.mark.parametrize(
    ("kind", "parameters", "sentence"),
    [
        ("rom", {}, "There is no kind of world 'rom' to generate. Did you mean 'room'?"),
        ("sea", {}, "There is no kind of world 'sea' to generate. There are room, maze, clutter, warehouse."),
        ("maze", {"colums": 3}, "A generated maze has no 'colums'. Did you mean 'columns'?"),
        ("maze", {"xyz": 3}, "A generated maze has no 'xyz'. There are columns, rows, cell, loops."),
        (
            "maze",
            {"cell": 0.1},
            "A generated maze like that is not possible: cell is 0.1; write a number from 0.4 to 5 (meters).",
        ),
        (
            "maze",
            {"rows": 1000},
            "A generated maze like that is not possible: rows is 1000; write a whole number from 2 to 40.",
        ),
        (
            "clutter",
            {"density": 0.5},
            "A generated clutter like that is not possible: density is 0.5; write a number from 0 to 0.08.",
        ),
        ("room", {"seed": -1}, "The seed of a world is -1; write a whole number, 0 or more."),
        ("room", {"seed": 0.5}, "The seed of a world is 0.5; write a whole number, 0 or more."),
        (
            "room",
            {"boxes": 400},
            "A room of 6 m by 6 m is too small for all this; make it larger, or ask for fewer obstacles.",
        ),
    ],
)
def test_worlds_that_cannot_be_generated(kind, parameters, sentence):
    with pytest.raises(WorldError) as caught:
        World.generate(kind, **parameters)
    assert str(caught.value) == sentence
