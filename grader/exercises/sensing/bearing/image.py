"""Images of a camera: their pixels, what is red in them, and where that is."""

import math
from typing import Any

import numpy as np

LEAST = 20  # red pixels: fewer are no post, and a post has more


def pixels_of(image: Any) -> np.ndarray:
    """Return the pixels of an rgb8 or bgr8 Image: rows, columns, and red, green and blue."""
    rows = np.frombuffer(image.data, np.uint8).reshape(image.height, image.step)
    pixels = rows[:, : 3 * image.width].reshape(image.height, image.width, 3)
    return pixels[..., ::-1] if image.encoding == "bgr8" else pixels


def is_red(pixels: np.ndarray) -> np.ndarray:
    """Return for each pixel whether it is red: over 90, and green and blue less than half of that."""
    red, green, blue = (pixels[..., channel].astype(int) for channel in range(3))
    return (red > 90) & (2 * green < red) & (2 * blue < red)


def column_of_red(pixels: np.ndarray) -> float | None:
    """Return the middle column of what is red, counted from the image's left edge; None if there is no post.

    Half of the red pixels are to the left of it: single ones far away don't move it.
    """
    columns = np.nonzero(is_red(pixels))[1]
    return float(np.median(columns)) + 0.5 if len(columns) >= LEAST else None


def bearing_of(column: float, width: int) -> float:
    """Return the bearing (rad, to the left) of a column, for a camera that sees 90 degrees."""
    return math.atan(1 - 2 * column / width)
