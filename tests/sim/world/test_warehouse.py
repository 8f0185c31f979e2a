"""Warehouses from seeds: every place can be reached, and people have room to walk."""

import dataclasses
import itertools
import json
import math

import numpy as np
import pytest

from sim.world import BatteryModel, OtherRobot, Simulation, World, WorldError
from sim.world.battery import NEAR
from sim.world.clearance import clearance
from sim.world.route import Route
from tests.sim.world.files import HEADINGS
from tests.sim.world.paths import has_a_path

SEEDS = range(40)


@pytest.fixture(scope="module")
def worlds():
    return [World.generate("warehouse", seed=seed) for seed in SEEDS]


def test_equal_seeds_give_equal_warehouses_and_others_do_not(worlds):
    assert worlds == [World.generate("warehouse", seed=seed) for seed in SEEDS]
    assert len({repr((world.boxes, world.people, world.warehouse)) for world in worlds}) == len(SEEDS)


def test_each_place_can_be_reached_from_the_charger(worlds):
    for world in worlds[::8]:
        assert math.dist(world.start[:2], world.battery.charger) == 0
        for name, place in world.places().items():
            there = dataclasses.replace(world, goal=place[:2])
            assert has_a_path(there, world.robot.radius + 0.02), (world.name, name)


def test_people_walk_a_minute_without_a_wait_a_touch_or_a_push(worlds):
    for world in worlds[:20]:
        alone = Simulation(dataclasses.replace(world, movable=()))
        crowded = Simulation(world)
        for simulation in (alone, crowded):
            simulation.advance(60)
        assert crowded.poses[-1] == alone.poses[-1] != Simulation(world).poses[-1]
        assert crowded.contacts == []
        boxes = [tuple(pose) for pose in crowded.poses[1:-1]]
        assert boxes == [(box.x, box.y, box.yaw) for box in world.movable]


def test_people_keep_away_from_static_obstacles_and_boxes(worlds):
    for world in worlds:
        for person in world.people:
            route = Route(person.route)
            points = np.array([route.point(place / 10) for place in range(round(route.length * 10))])
            assert clearance(world, *points.T).min() > person.radius + 0.4
            boxes = dataclasses.replace(world, boxes=world.movable, walls=())
            assert clearance(boxes, *points.T).min() > person.radius + 0.05


def test_a_warehouse_has_a_name_a_card_and_comes_back_from_plain_data(worlds):
    world = worlds[7]
    assert world.name == "warehouse_7"
    assert [line.split(":")[0] for line in world.card.splitlines()] == HEADINGS
    assert "6 shelves, 3 boxes to push and 1 person who walks round." in world.card
    assert World.from_data(json.loads(json.dumps(world.to_data()))) == world
    assert list(world.places()) == ["charger", "desk", *(f"shelf_{number}" for number in range(1, 7))]
    assert [body.kind for body in world.bodies] == ["robot", "box", "box", "box", "person"]


def test_a_warehouse_has_the_requested_objects():
    world = World.generate("warehouse", seed=1, columns=1, rows=2, movable=2, people=3)
    assert (len(world.boxes), len(world.movable), len(world.people)) == (3, 2, 3)
    assert len(world.warehouse.pickups) == 2
    gaps = [math.dist(a[:2], b[:2]) for a in world.places().values() for b in world.places().values()]
    assert all(gap == 0 or gap > 2 * NEAR for gap in gaps)  # no one is at two places at once


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (
            {"movable": 7},
            "A generated warehouse like that is not possible: movable is 7; "
            "write at most 6, one for each shelf.",
        ),
        (
            {"robots": 4},
            "A generated warehouse like that is not possible: robots is 4; write a whole number from 1 to 3.",
        ),
        (
            {"rows": 9},
            "A generated warehouse like that is not possible: rows is 9; write a whole number from 1 to 8.",
        ),
        (
            {"shelfs": 9},
            "A generated warehouse has no 'shelfs'. There are columns, rows, movable, people, robots.",
        ),
    ],
)
def test_warehouses_that_cannot_be_generated(change, sentence):
    with pytest.raises(WorldError) as caught:
        World.generate("warehouse", **change)
    assert str(caught.value) == sentence


@pytest.mark.parametrize(
    ("table", "key", "value", "sentence"),
    [
        (
            *("warehouse", "pickups", []),
            "warehouse.pickups is []; write a list of one or more poses [x, y, yaw] (meters and radians).",
        ),
        ("warehouse", "desk", [1, 2], "warehouse.desk is [1, 2]; write [x, y, yaw] (meters and radians)."),
        (
            *("warehouse", "interval", 0),
            "warehouse.interval is 0; write a number from 0.0001 to 100000 (seconds).",
        ),
        ("battery", "empty", 13, "battery.empty is 13.0; write a number below full, 12.6 (V)."),
        ("battery", "start", 1.2, "battery.start is 1.2; write a number from 0 to 1."),
    ],
)
def test_faults_in_a_warehouse_are_named(worlds, table, key, value, sentence):
    data = worlds[0].to_data()
    data[table][key] = value
    with pytest.raises(WorldError) as caught:
        World.from_data(data)
    assert str(caught.value) == f"the world: {sentence}"


@pytest.mark.parametrize(
    ("key", "change", "what"),
    [
        ("people", lambda data: data["people"][0]["route"].append([99, 0]), "routes"),
        ("warehouse", lambda data: data["warehouse"].update(desk=[-1, 0, 0]), "places"),
        ("battery", lambda data: data["battery"].update(charger=[-1, 0]), "places"),
    ],
)
def test_a_pose_outside_the_bounds_is_rejected(worlds, key, change, what):
    data = json.loads(json.dumps(worlds[0].to_data()))
    change(data)
    with pytest.raises(WorldError) as caught:
        World.from_data(data)
    assert str(caught.value).startswith(f"the world: {key} is ")
    assert str(caught.value).endswith(f"...; write {what} that lie inside the bounds.")


def test_each_robot_has_a_charger_where_it_begins():
    for seed in SEEDS:
        world = World.generate("warehouse", seed=seed, rows=1 + seed % 3, movable=2, robots=3)
        assert list(world.starts()) == ["robot", "robot_2", "robot_3"]
        assert world.chargers == {name: start[:2] for name, start in world.starts().items()}
        places = [*world.places().values()]
        assert places[1:3] == [world.chargers["robot_2"], world.chargers["robot_3"]]
        assert min(math.dist(a[:2], b[:2]) for a, b in itertools.combinations(places, 2)) > 0.4
        spots = np.array([place[:2] for place in places[:3]])
        for boxes in (world.boxes, world.movable):
            there = dataclasses.replace(world, boxes=boxes)
            assert clearance(there, *spots.T).min() > world.robot.radius + 0.05
        alone = World.generate("warehouse", seed=seed, rows=1 + seed % 3, movable=2)
        assert dataclasses.replace(world, robots=(), card=alone.card) == alone
    assert "robot_3 at its own, at x 2, y 0.3." in world.card
    assert "and /orders (warehouse_msgs/Order). robot_2 has its own under /robot_2. robot_3" in world.card


def test_people_walk_past_the_robots_that_charge():
    for seed in range(12):
        simulation = Simulation(World.generate("warehouse", seed=seed, robots=3, movable=0))
        alone = Simulation(World.generate("warehouse", seed=seed, movable=0))
        for each in (simulation, alone):
            each.advance(60)
        assert simulation.poses[-1] == alone.poses[-1]
        assert all(robot.battery.current >= 0 for robot in simulation.robots.values())


@pytest.mark.parametrize(
    ("battery", "charger", "sentence"),
    [
        (None, (1, 1), "write no charger for two, where robots have no battery."),
        (BatteryModel((0, 0)), (9, 9), "write a charger for two that lies inside the bounds."),
        (BatteryModel((0, 0)), (1,), "OtherRobot: charger is [1]; write [x, y] (meters)."),
    ],
)
def test_a_charger_that_cannot_be_is_refused(battery, charger, sentence):
    with pytest.raises(WorldError) as caught:
        other = OtherRobot("two", (0, 0, 0), charger=charger)
        World(*("floor", "", (-1, -1, 3, 1), (0, 0, 0)), robots=(other,), battery=battery)
    assert str(caught.value).endswith(sentence)
