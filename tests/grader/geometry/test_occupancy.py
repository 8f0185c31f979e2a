import numpy as np
from nav_msgs.msg import OccupancyGrid

from grader.geometry.occupancy import cells_of, distances_to_occupied


def test_cells_are_rows_from_the_lowest_one_up():
    grid = OccupancyGrid(data=[0, 100, -1, 0, 0, 0])
    grid.info.width, grid.info.height = 3, 2
    assert cells_of(grid).tolist() == [[0, 100, -1], [0, 0, 0]]


def test_distances_are_those_of_the_nearest_occupied_cell():
    cells = np.array([[100, 0, 0, 0], [0, 0, 0, 100]])
    assert np.allclose(distances_to_occupied(cells), [[0, 1, 2**0.5, 1], [1, 2**0.5, 1, 0]])
    assert np.isinf(distances_to_occupied(np.zeros((2, 2)))).all()
