"""Maps as RViz shows them: cells, a plan, the robot and its way."""

import numpy as np
import pytest
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import OccupancyGrid, Path

from sim import run
from sim.view import plot_map
from sim.view.plot import png


def grid(width=4, height=3, data=None):
    msg = OccupancyGrid()
    msg.info.width, msg.info.height, msg.info.resolution = width, height, 0.5
    msg.info.origin.position.x, msg.info.origin.position.y = -1.0, 2.0
    msg.data = [0] * (width * height) if data is None else data
    return msg


def shades(figure):
    """The cells' shades as drawn: 0 unknown, 1 free, up to 101 occupied; the lowest row first."""
    return np.asarray(figure.axes[0].images[0].get_array())


def test_each_cell_is_at_its_position_in_the_map():
    figure = plot_map(grid(data=[-1, 0, 50, 100] + [0] * 8))
    assert list(shades(figure)[0]) == [0, 1, 51, 101]
    assert shades(figure)[1:].max() == 1
    assert figure.axes[0].images[0].get_extent() == [-1.0, 1.0, 2.0, 3.5]
    assert figure.axes[0].get_title() == "4 by 3 cells of 0.5 m"
    assert png(figure).startswith(b"\x89PNG")


def test_a_path_is_a_message_or_points():
    path = Path(poses=[PoseStamped(), PoseStamped()])
    path.poses[1].pose.position.x = 0.75
    for given in (path, [(0, 0), (0.75, 0)]):
        assert plot_map(grid(), given).axes[0].lines[0].get_xydata().tolist() == [[0, 0], [0.75, 0]]


def test_an_empty_path_draws_nothing():
    assert not plot_map(grid(), Path()).axes[0].lines


def test_the_robot_is_drawn_at_the_given_pose_or_at_the_end_of_the_drive():
    assert plot_map(grid(), robot=(0.5, 2.5, 0.0)).axes[0].patches[0].center == (0.5, 2.5)
    drive = run(world="room", seconds=1)
    figure = plot_map(grid(), drive=drive)
    assert figure.axes[0].patches[0].center == (drive.path[-1].x, drive.path[-1].y)
    assert [text.get_text() for text in figure.axes[0].get_legend().get_texts()] == ["drive", "robot"]


@pytest.mark.parametrize(("width", "height", "data"), [(0, 0, []), (4, 3, [0] * 11)])
def test_a_map_without_cells_is_refused(width, height, data):
    with pytest.raises(ValueError) as refused:
        plot_map(grid(width, height, data))
    assert str(refused.value) == (
        f"this map has no cells to draw: it is {width} by {height} cells, and data holds {len(data)} values"
    )
