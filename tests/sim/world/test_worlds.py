"""World files: those that come with the course, and what is said about faulty ones."""

import dataclasses
import json
import math
import tomllib

import numpy as np
import pytest

from sim.world import (
    Box,
    Circle,
    ImuModel,
    LidarModel,
    MovableBox,
    OtherRobot,
    RobotModel,
    Simulation,
    World,
    WorldError,
)
from sim.world.world_file import MACHINES
from tests.sim.world.files import CARD, HEADINGS, load
from tests.sim.world.mobile import MOBILE
from tests.sim.world.paths import has_a_path

IMU = "rate, gyro_noise, gyro_bias, accel_noise, accel_bias"
LIDAR = (
    "rays, range_min, range_max, noise, dropouts, x, y, yaw, silent, latency, "
    "x_error, y_error, yaw_error, clock_offset, transform_delay"
)
GOOD = "bounds = [-3, -3, 3, 3]\nstart = [0, 0, 0]\n" + CARD


def words(folder, text):
    """What is said about a faulty world file."""
    with pytest.raises(WorldError) as caught:
        load(folder, text)
    return str(caught.value)


def test_names_are_sorted_and_hold_the_first_worlds():
    names = World.names()
    assert names == sorted(names)
    assert {"yard", "room", "corridor", "maze"} <= set(names)


@pytest.mark.parametrize("name", World.names())
def test_every_card_has_the_five_headings_in_order(name):
    lines = World.load(name).card.splitlines()
    assert [line.split(":")[0] for line in lines] == HEADINGS
    assert all(line.split(":", 1)[1].strip() for line in lines)


@pytest.mark.parametrize("name", MOBILE)
def test_every_start_is_free(name):
    simulation = Simulation(World.load(name))
    simulation.advance(1)
    for robot, start in zip(simulation.robots.values(), simulation.world.starts().values(), strict=True):
        assert robot.pose == pytest.approx(start)
        assert robot.bumper == frozenset()


@pytest.mark.parametrize("name", [name for name in World.names() if World.load(name).goal])
def test_every_goal_can_be_reached(name):
    world = dataclasses.replace(World.load(name), movable=())
    assert has_a_path(world, RobotModel().radius)


def test_the_maze_is_solved_by_following_its_left_wall():
    world = World.load("maze")
    simulation = Simulation(world, seed=3)
    while math.dist(simulation.robot.pose[:2], world.goal) > 0.2 and simulation.time < 120:
        scan = np.clip(simulation.robot.scan(), 0.1, 2.0)
        left, ahead = scan[50:100].min(), np.concatenate((scan[:25], scan[-25:])).min()
        turn = -2.0 if ahead < 0.45 else 3.0 * (left - 0.4)
        simulation.robot.command(0.1 if ahead < 0.45 else 0.3, turn)
        simulation.advance(simulation.time + 0.1)
    assert math.dist(simulation.robot.pose[:2], world.goal) <= 0.2
    assert simulation.contacts == []


def test_a_file_becomes_plain_frozen_data(tmp_path):
    world = load(
        tmp_path,
        """
        bounds = [-3, -2, 3, 2]
        start = [1, -1, 0.5]
        goal = [2, 1]
        walls = [[[0, 0], [1, 0], [1, 1]], [[-1, 0], [-1, 1]]]
        [[boxes]]
        x = 2
        y = 0
        yaw = 1.5707963267948966
        width = 1
        height = 0.5
        [[circles]]
        x = -2
        y = 0
        radius = 0.25
        """
        + CARD,
    )
    assert world == World(
        name="mine",
        card="\n".join(f"{heading}: text" for heading in HEADINGS),
        bounds=(-3, -2, 3, 2),
        start=(1, -1, 0.5),
        goal=(2, 1),
        walls=(((0, 0), (1, 0)), ((1, 0), (1, 1)), ((-1, 0), (-1, 1))),
        boxes=(Box(2, 0, math.pi / 2, 1, 0.5),),
        circles=(Circle(-2, 0, 0.25),),
    )
    assert hash(world) == hash(dataclasses.replace(world))
    with pytest.raises(dataclasses.FrozenInstanceError):
        world.name = "other"


def test_a_file_of_ones_own_can_be_loaded_by_a_path_in_a_string(tmp_path):
    load(tmp_path, GOOD)
    assert World.load(str(tmp_path / "mine.toml")).start == (0, 0, 0)


def test_a_file_of_ones_own_is_read_each_time(tmp_path):
    load(tmp_path, GOOD)
    assert load(tmp_path, GOOD.replace("[0, 0, 0]", "[1, 0, 0]")).start == (1, 0, 0)


def test_segments_are_the_walls_and_then_the_sides_of_the_boxes():
    world = World(
        "t", "", (-9, -9, 9, 9), (0, 0, 0), walls=(((5, 5), (6, 6)),), boxes=(Box(1, 2, math.pi / 2, 4, 2),)
    )
    expected = [(5, 5, 6, 6), (2, 0, 2, 4), (2, 4, 0, 4), (0, 4, 0, 0), (0, 0, 2, 0)]
    assert world.segments() == pytest.approx(np.array(expected, dtype=float))
    assert world.discs().shape == (0, 3)


def test_discs_are_the_circles():
    world = World("t", "", (-9, -9, 9, 9), (0, 0, 0), circles=(Circle(1, 2, 0.5),))
    assert world.discs().tolist() == [[1, 2, 0.5]]
    assert world.segments().shape == (0, 4)


def test_unknown_name_gets_a_guess():
    with pytest.raises(WorldError) as caught:
        World.load("rooom")
    listed = ", ".join(World.names())
    assert str(caught.value) == f"There is no world 'rooom'. Did you mean 'room'? The worlds are {listed}."


def test_unknown_name_without_a_likeness_gets_the_list():
    with pytest.raises(WorldError) as caught:
        World.load("xyzzy")
    assert str(caught.value) == f"There is no world 'xyzzy'. The worlds are {', '.join(World.names())}."


def test_missing_file():
    with pytest.raises(WorldError) as caught:
        World.load("/nowhere/mine.toml")
    assert str(caught.value) == "Cannot read /nowhere/mine.toml (No such file or directory); check the path."


def test_file_that_is_not_text(tmp_path):
    (tmp_path / "mine.toml").write_bytes(b"\xff\xfe")
    with pytest.raises(WorldError) as caught:
        World.load(tmp_path / "mine.toml")
    assert str(caught.value) == "mine.toml is not UTF-8 text; save it as UTF-8."


def test_file_that_is_not_toml(tmp_path):
    text = "start = [0, 0,\nbounds"
    with pytest.raises(tomllib.TOMLDecodeError) as reason:
        tomllib.loads(text)
    assert "line 2" in str(reason.value)
    assert words(tmp_path, text) == f"mine.toml is not valid TOML ({reason.value}); correct it there."


@pytest.mark.parametrize(("good", "bad", "sentence"), [
    ("bounds = [-3, -3, 3, 3]\n", "",
     "bounds is missing; write [xmin, ymin, xmax, ymax] (meters) with xmin < xmax and ymin < ymax."),
    ("[-3, -3, 3, 3]", "[3, -3, -3, 3]",
     "bounds is [3, -3, -3, 3]; "
     "write [xmin, ymin, xmax, ymax] (meters) with xmin < xmax and ymin < ymax."),
    ("start = [0, 0, 0]", "",
     "start is missing; write [x, y, yaw] (meters and radians) inside the bounds."),
    ("start = [0, 0, 0]", "start = [0, nan, 0]",
     "start is [0, nan, 0]; write [x, y, yaw] (meters and radians) inside the bounds."),
    ("start = [0, 0, 0]", "start = [9, 0, 0]",
     "start is [9.0, 0.0, 0.0]; write [x, y, yaw] (meters and radians) inside the bounds."),
    ("start = [0, 0, 0]", "start = [0, 0]",
     "start is [0, 0]; write [x, y, yaw] (meters and radians) inside the bounds."),
    ("start = [0, 0, 0]", "start = [true, 0, 0]",
     "start is [True, 0, 0]; write [x, y, yaw] (meters and radians) inside the bounds."),
    (CARD, "",
     f"card is missing; write a [card] table with a text for each of {', '.join(HEADINGS)}."),
    (CARD, "card = 'text'",
     f"card is 'text'; write a [card] table with a text for each of {', '.join(HEADINGS)}."),
    ('"Topics" = "text"\n', "", "card.Topics is missing; write a short text."),
    ('"Topics" = "text"', '"Topics" = " "', "card.Topics is ' '; write a short text."),
    ('"Start" = "text"', '"Start" = 3', "card.Start is 3; write a short text."),
    ('"Start" = "text"', '"Starts" = "text"',
     "card.Starts is not a known key; did you mean Start?"),
])  # fmt: skip
def test_a_file_with_a_wrong_line(tmp_path, good, bad, sentence):
    load(tmp_path, GOOD)
    assert good in GOOD
    assert words(tmp_path, GOOD.replace(good, bad, 1)) == f"mine.toml: {sentence}"


@pytest.mark.parametrize(("more", "sentence"), [
    ("goal = [0, inf]", "goal is [0, inf]; write [x, y] (meters) inside the bounds."),
    ("walls = 3",
     "walls is 3; write a list of walls, each a list of two or more corners [x, y] (meters), "
     "each different from the one before."),
    ("walls = [[[0, 1], [1, 1]], [[2, 2]]]",
     "walls[1] is [[2, 2]]; write two or more corners [x, y] (meters), "
     "each different from the one before."),
    ("walls = [[[2, 2], [2, 2]]]",
     "walls[0] is [[2, 2], [2, 2]]; write two or more corners [x, y] (meters), "
     "each different from the one before."),
    ("walls = [[[2, 2], ['a', 2]]]",
     "walls[0] is [[2, 2], ['a', 2]]; write two or more corners [x, y] (meters), "
     "each different from the one before."),
    ("walls = [7]",
     "walls[0] is 7; write two or more corners [x, y] (meters), each different from the one before."),
    ("boxes = [1]",
     "boxes is [1]; write a [[boxes]] table for each, with x, y, yaw, width and height."),
    ("circles = 1", "circles is 1; write a [[circles]] table for each, with x, y and radius."),
    ("[[boxes]]\nx = 1\ny = 1\nyaw = 0\nwidth = -1\nheight = 1",
     "boxes[0].width is -1; write a number from 0.0001 to 1000 (meters)."),
    ("[[boxes]]\nx = 1\ny = 1\nyaw = inf\nwidth = 1\nheight = 1",
     "boxes[0].yaw is inf; write a finite number (radians)."),
    ("[[boxes]]\nx = 1\ny = 1\nyaw = 0\nwidth = 1",
     "boxes[0].height is missing; write a number from 0.0001 to 1000 (meters)."),
    ("[[circles]]\nx = 1\ny = 1\nradius = 0",
     "circles[0].radius is 0; write a number from 0.0001 to 1000 (meters)."),
    ("[[circles]]\nx = 1\ny = 1\nradius = 1\n[[circles]]\nx = 1\ny = 1\nradus = 1",
     "circles[1].radus is not a known key; did you mean radius?"),
    ("imu = 3", f"imu is 3; write a [imu] table with any of {IMU}."),
    ("[[lidar]]", f"lidar is [{{}}]; write a [lidar] table with any of {LIDAR}."),
    ("[lidar]\nrays = 0", "lidar.rays is 0; write a whole number from 1 to 10000."),
    ("[lidar]\nrange_min = 4", "lidar.range_min is 4.0; write a number below range_max, 3.5 (meters)."),
    ("[robot]\nmax_force = 1",
     "robot.max_force is 1.0; write more than 2.5 N, which the robot's ramps and curves need."),
    ("[robot]\nradus = 1", "robot.radus is not a known key; did you mean radius?"),
    ("[[movable]]\nx = 1\ny = 1\nyaw = 0\nwidth = 1",
     "movable[0].height is missing; write a number from 0.0001 to 1000 (meters)."),
    ("[robots]\nname = 'leader'",
     "robots is {'name': 'leader'}; write a [[robots]] table for each, "
     "with name, start, route, speed and charger."),
    ("[[robots]]\nname = 'leader'",
     "robots[0].start is missing; write [x, y, yaw] (meters and radians)."),
    ("[joint]\n[arm]", "joint and arm are both here; keep one of them."),
    ("[joint]\n[imu]\nrate = 50",
     "imu is ImuModel(rate=50.0, gyro_noise=0.005, gyro_bias=0.02, accel_noise=0.05, accel...; "
     "write nothing there, for this world holds a machine instead of a mobile robot."),
    ("lava = 1",
     "lava is not a known key; the keys are bounds, start, goal, walls, boxes, circles, movable, "
     "robots, people, robot, lidar, wheels, imu, battery, warehouse, "
     f"{''.join(f'{key}, ' for key in MACHINES)}card."),
    ("wals = []", "wals is not a known key; did you mean walls?"),
])  # fmt: skip
def test_a_file_with_a_faulty_addition(tmp_path, more, sentence):
    assert words(tmp_path, GOOD.replace("[card]", f"{more}\n[card]")) == f"mine.toml: {sentence}"


def test_a_file_sets_the_parameters_of_robots_and_sensors(tmp_path):
    text = """
        [robot]
        max_v = 1
        [lidar]
        rays = 180
        dropouts = 0.05
        [imu]
        [[movable]]
        x = 1
        y = 1
        yaw = 0
        width = 0.4
        height = 0.2
        friction = 0.5
        [[robots]]
        name = "leader"
        start = [-1, 0, 0]
        route = [[-1, 0], [-1, 2], [1, 2]]
        """
    world = load(tmp_path, GOOD.replace("[card]", text + "[card]"))
    assert world.robot == RobotModel(max_v=1)
    assert world.lidar == LidarModel(rays=180, dropouts=0.05)
    assert world.imu == ImuModel()
    assert world.movable == (MovableBox(1, 1, 0, 0.4, 0.2, friction=0.5),)
    assert world.robots == (OtherRobot("leader", (-1, 0, 0), ((-1, 0), (-1, 2), (1, 2))),)
    assert World.from_data(json.loads(json.dumps(world.to_data()))) == world


@pytest.mark.parametrize("name", World.names())
def test_every_world_comes_back_from_plain_data(name):
    world = World.load(name)
    assert World.from_data(json.loads(json.dumps(world.to_data()))) == world


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        (
            {"start": [9, 0, 0]},
            "start is [9.0, 0.0, 0.0]; write [x, y, yaw] (meters and radians) inside the bounds.",
        ),
        ({"lidar": {"rays": 1e9}}, "lidar.rays is 1000000000.0; write a whole number from 1 to 10000."),
        (
            {"boxes": [[1]]},
            "boxes is [[1]]; write a [[boxes]] table for each, with x, y, yaw, width and height.",
        ),
        ({"name": None}, "name is None; write a text."),
        ({"__class__": 1}, "__class__ is not a known key; the keys are bounds,"),
    ],
)
def test_hostile_data_of_a_world(changes, sentence):
    with pytest.raises(WorldError) as caught:
        World.from_data(World.load("room").to_data() | changes)
    assert str(caught.value).startswith(f"the world: {sentence}")


def test_data_that_is_no_table():
    with pytest.raises(WorldError) as caught:
        World.from_data([1])
    assert str(caught.value) == "the world is [1]; write a table of its keys and values."


@pytest.mark.parametrize("text", ["a = " + "9" * 5000, "a = " + "[" * 5000 + "]" * 5000])
def test_toml_beyond_what_python_reads(tmp_path, text):
    assert words(tmp_path, text).startswith("mine.toml is not a world file (")
    assert words(tmp_path, text).endswith("); correct it there.")


def test_a_number_too_big_for_a_float_is_not_finite(tmp_path):
    huge = "9" * 400
    text = GOOD.replace("[card]", f"[[circles]]\nx = {huge}\ny = 1\nradius = 1\n[card]")
    assert words(tmp_path, text) == (
        f"mine.toml: circles[0].x is {huge[:77]}...; write a number from -1000 to 1000 (meters)."
    )


@pytest.mark.parametrize(
    ("what", "obstacles"),
    [
        ("wall", {"walls": (((1.05, -1.0), (1.05, 5.0)),)}),
        ("box", {"boxes": (Box(1.2, 2.1, 0.3, 3.0, 3.0),)}),
        ("circle", {"circles": (Circle(1.0, 2.0, 2.0),)}),
    ],
)
def test_a_start_inside_an_obstacle(what, obstacles):
    world = World("mine", "", (-3, -3, 3, 3), (1.0, 2.0, 0.0), **obstacles)
    with pytest.raises(WorldError) as caught:
        Simulation(world)
    assert str(caught.value) == (
        "World 'mine': the robot (radius 0.1 m) does not fit at the start (1, 2), "
        f"where a {what} is; move the start or the {what}."
    )
