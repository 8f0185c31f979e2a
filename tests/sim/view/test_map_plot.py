"""Maps in the picture of a world: cells, a plan, points, the robot and its path."""

import numpy as np
import pytest
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import OccupancyGrid, Path

from sim import run
from sim.view import plot_map
from sim.view.packing import inflated
from sim.view.plot import png
from sim.view.replay_data import run_key


def grid(width=4, height=3, data=None):
    msg = OccupancyGrid()
    msg.info.width, msg.info.height, msg.info.resolution = width, height, 0.5
    msg.info.origin.position.x, msg.info.origin.position.y = -1.0, 2.0
    msg.data = [0] * (width * height) if data is None else data
    return msg


def on_page(figure):
    """What the page draws."""
    return inflated(figure.html.split('data-replay="')[1].split('"')[0])


def layers(figure):
    return {layer["topic"]: layer["data"] for layer in on_page(figure)["layers"]}


def test_each_cell_is_at_its_position_in_the_map():
    figure = plot_map(grid(data=[-1, 0, 50, 100] + [0] * 8))
    runs = [[-1, 1], [0, 1], [50, 1], [100, 1], [0, 8]]
    assert layers(figure) == {"map": {"width": 4, "place": [-1.0, 2.0, 0.5], "runs": runs}}
    page = on_page(figure)
    assert page["title"] == "4 by 3 cells of 0.5 m"
    assert page["world"]["bounds"] == [-1.0, 2.0, 1.0, 3.5]
    assert page["world"]["bodies"] == page["tracks"] == page["world"]["walls"] == []


def test_a_page_without_scripts_has_the_same_map_as_a_picture():
    figure = plot_map(grid(data=[-1, 0, 50, 100] + [0] * 8))
    shades = np.asarray(figure.axes[0].images[0].get_array())
    assert list(shades[0]) == [0, 1, 51, 101]
    assert figure.axes[0].images[0].get_extent() == [-1.0, 1.0, 2.0, 3.5]
    assert figure.axes[0].get_title() == "4 by 3 cells of 0.5 m"
    assert png(figure).startswith(b"\x89PNG")


def test_a_path_is_a_message_or_points_and_ends_at_the_goal():
    path = Path(poses=[PoseStamped(), PoseStamped()])
    path.poses[1].pose.position.x = 0.75
    for given in (path, [(0, 0), (0.75, 0)]):
        figure = plot_map(grid(), given)
        assert layers(figure)["plan"] == [[0, 0], [0.75, 0]]
        assert on_page(figure)["world"]["goal"] == [0.75, 0]


def test_an_empty_path_draws_nothing():
    figure = plot_map(grid(), Path())
    assert list(layers(figure)) == ["map"] and on_page(figure)["world"]["goal"] is None


def test_the_robot_is_drawn_at_the_given_pose_or_on_its_drive():
    figure = plot_map(grid(), robot=(0.5, 2.5, 0.25))
    assert on_page(figure)["tracks"] == [[[500], [2500], [250]]]
    assert figure.axes[0].patches[0].center == (0.5, 2.5)
    drive = run(world="room", seconds=1)
    page = on_page(plot_map(grid(), drive=drive))
    assert (page["run"], page["end"]) == (run_key(drive), 1.0)  # with the cursor of the run's other pictures
    assert len(page["tracks"][0][0]) == len(drive.path)


def test_points_are_marked_by_what_they_are():
    figure = plot_map(grid(), points={"seen": [(0.0, 2.5)], "moved": np.array([[0.5, 3.0]])})
    assert layers(figure)["seen"] == {"color": 0, "places": [[0.0, 2.5]]}
    assert layers(figure)["moved"] == {"color": 1, "places": [[0.5, 3.0]]}
    assert [text.get_text() for text in figure.axes[0].get_legend().get_texts()] == ["seen", "moved"]


@pytest.mark.parametrize(("width", "height", "data"), [(0, 0, []), (4, 3, [0] * 11)])
def test_a_map_without_cells_is_refused(width, height, data):
    with pytest.raises(ValueError) as refused:
        plot_map(grid(width, height, data))
    assert str(refused.value) == (
        f"this map has no cells to draw: it is {width} by {height} cells, and data holds {len(data)} values"
    )
