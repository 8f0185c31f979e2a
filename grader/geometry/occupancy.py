"""The cells of an OccupancyGrid as an array, and distances between them."""

from typing import Any

import numpy as np


def cells_of(message: Any) -> np.ndarray:
    """Return the cells of an OccupancyGrid, shape (rows, columns); row 0 has the lowest y."""
    return np.array(message.data, dtype=np.int16).reshape(message.info.height, message.info.width)


def distances_to_occupied(cells: np.ndarray) -> np.ndarray:
    """Return how far the middle of each cell is from that of the nearest occupied cell, in cells."""
    rows, columns = (np.arange(count) for count in cells.shape)
    in_row = np.full(cells.shape, np.inf)  # squared; then the nearest of all rows
    for column, occupied in zip(columns, (cells == 100).T, strict=True):
        in_row[occupied] = np.minimum(in_row[occupied], (columns - column) ** 2)
    nearest = np.full(cells.shape, np.inf)
    for row, squared in zip(rows, in_row, strict=True):
        np.minimum(nearest, squared + ((rows - row) ** 2)[:, None], out=nearest)
    distances: np.ndarray = np.sqrt(nearest)
    return distances
