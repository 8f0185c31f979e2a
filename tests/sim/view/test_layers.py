"""Maps, plans and goals as layers of a picture."""

import math

import pytest
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import OccupancyGrid, Path

from sim.view.layer_kinds import CELLS
from sim.view.layers import NewestLayers, layers_of
from tests.sim.recordings import published


def grid(width=2, height=2, data=(0, 0, -1, 100), frame="map"):
    message = OccupancyGrid(data=list(data))
    message.header.frame_id = frame
    message.info.width, message.info.height, message.info.resolution = width, height, 0.5
    message.info.origin.position.x = -1.0
    return message


def plan(*points):
    message = Path()
    message.header.frame_id = "map"
    message.poses = [pose(*point) for point in points]
    return message


def pose(x, y, yaw=0.0):
    message = PoseStamped()
    message.header.frame_id = "map"
    message.pose.position.x, message.pose.position.y = x, y
    message.pose.orientation.z, message.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return message


def test_a_map_is_runs_of_cells_in_meters():
    (layer,) = layers_of(published("/map", [(0.5, grid())]))
    runs = [[0, 2], [-1, 1], [100, 1]]
    data = {"width": 2, "place": [-1.0, 0.0, 0.5], "runs": runs}
    assert layer == {"stamp": 500, "topic": "/map", "kind": "map", "data": data}


def test_a_large_map_has_larger_cells_and_keeps_its_walls():
    side = 2 * math.isqrt(CELLS)
    cells = [0] * side * side
    cells[side * 7 + 9] = 100
    (layer,) = layers_of(published("/map", [(0.0, grid(side, side, cells))]))
    assert layer["data"]["place"][2] == 1.0
    assert sum(count for _, count in layer["data"]["runs"]) == CELLS
    assert [count for value, count in layer["data"]["runs"] if value == 100] == [1]


def test_plans_and_goals_have_points_and_a_heading():
    (layer,) = layers_of(published("/plan", [(1.0, plan((0.0, 0.0), (1.0, 2.0)))]))
    assert (layer["kind"], layer["data"]) == ("plan", [[0.0, 0.0], [1.0, 2.0]])
    (layer,) = layers_of(published("/goal_pose", [(1.0, pose(1.0, 2.0, 1.5))]))
    assert (layer["kind"], layer["data"]) == ("goal", [1.0, 2.0, 1.5])


@pytest.mark.parametrize(
    "topic, message",
    [
        ("/map", grid(frame="odom")),
        ("/map", grid(3)),
        ("/plan", plan((math.nan, 0.0))),
        ("/goal_pose", pose(1e9, 0.0)),
    ],
    ids=["frame", "cells", "nan", "far"],
)
def test_what_can_not_be_drawn_is_left_out(topic, message):
    assert layers_of(published(topic, [(0.0, message)])) == []


def test_the_newest_of_each_topic_is_shown_once():
    recording, newest = published("/plan", [(1.0, plan()), (2.0, plan((3.0, 0.0)))]), NewestLayers()
    newest.read(recording)
    (layer,) = newest.changed()
    assert (layer["stamp"], layer["data"]) == (2000, [[3.0, 0.0]])
    newest.read(recording)
    assert newest.changed() is None
