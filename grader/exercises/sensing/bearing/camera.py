"""A camera that looks at posts of several colors, and draws each of its pictures from the run's seed."""

import array
import functools
import itertools
import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image

FIRST, PERIOD = 1.0, 0.25  # s
HEIGHT = 48  # rows
OPTICAL = "camera_optical_frame"  # x to the right, y down, z ahead, as REP 103 has it
BACKGROUND = (205, 215, 225), (120, 120, 115)  # the wall and the floor
RED = 205, 35, 35
OTHERS = {
    "orange": (220, 150, 40),
    "magenta": (200, 40, 150),
    "white": (235, 235, 230),
    "blue": (35, 40, 205),
    "green": (40, 160, 60),
}
SHADES, NOISE = (0.65, 1.0), 9  # how bright a post is, and how far off each number of a pixel may be
WIDE, HIGH = (5, 9), (12, 20)  # a post's columns and rows
MOST_FALSE = 10  # single pixels that are red by mistake
# Where red posts are from image to image: 1 is the left edge of the image, -1 the right one, None is no post.
PLACES = (0.95, 0.6, 0.35, 0.0, -0.35, -0.6, -0.95, None, None)


@dataclass(frozen=True)
class Format:
    """The format of a camera's images. padding: bytes at the end of each row that belong to no pixel."""

    encoding: str = "rgb8"
    width: int = 64
    padding: int = 0


class PostCamera(Node):
    """Publishes an image on /image four times a second, best effort. It sees 45 degrees to either side."""

    def __init__(self, seed: int, layout: Format) -> None:
        super().__init__("camera")
        self.draw, self.layout = random.Random(f"camera {seed}"), layout
        self.numbers = np.random.default_rng(self.draw.getrandbits(32))
        self.places = itertools.chain.from_iterable(iter(self._shuffled, None))
        self.publisher = self.create_publisher(Image, "/image", qos_profile_sensor_data)
        self.begin = self.create_timer(FIRST, self._start)

    def _shuffled(self) -> Sequence[float | None]:
        return self.draw.sample(PLACES, len(PLACES))

    def _start(self) -> None:
        self.begin.cancel()
        self.create_timer(PERIOD, self.take)
        self.take()

    def take(self) -> None:
        """Publish the next image."""
        pixels = picture(next(self.places), self.layout.width, self.draw, self.numbers)
        image = message(pixels, self.layout)
        image.header.stamp, image.header.frame_id = self.get_clock().now().to_msg(), OPTICAL
        self.publisher.publish(image)


def picture(place: float | None, width: int, draw: random.Random, numbers: np.random.Generator) -> np.ndarray:
    """Return an image as an array of rows, columns and the numbers for red, green and blue.

    It shows posts of other colors and, unless `place` is None, a red one in front of them.
    """
    pixels = np.empty((HEIGHT, width, 3), np.int16)
    pixels[: HEIGHT // 2], pixels[HEIGHT // 2 :] = BACKGROUND
    for color in draw.sample(list(OTHERS.values()), 3):
        _draw_post(pixels, draw.uniform(-1.0, 1.0), color, draw)
    if place is not None:
        _draw_post(pixels, place + draw.uniform(-0.08, 0.08), RED, draw)
    for _ in range(draw.randint(MOST_FALSE - 2, MOST_FALSE)):
        pixels[draw.randrange(HEIGHT), draw.randrange(width)] = RED
    noise = numbers.integers(-NOISE, NOISE, pixels.shape, endpoint=True)
    return np.asarray(np.clip(pixels + noise, 0, 255).astype(np.uint8))


def _draw_post(pixels: np.ndarray, place: float, color: Sequence[int], draw: random.Random) -> None:
    """Draw a post into an image. At an edge, at least half of it is in the image."""
    width, columns = pixels.shape[1], draw.randint(*WIDE)
    middle = min(max(round(width * (1 - place) / 2), 0), width - 1)
    top, shade = HEIGHT // 2 - draw.randint(3, 9), draw.uniform(*SHADES)
    left, right = max(middle - columns // 2, 0), middle + columns // 2 + 1
    pixels[top : top + draw.randint(*HIGH), left:right] = [shade * part for part in color]


def message(pixels: np.ndarray, layout: Format) -> Image:
    """Return an image as a message without a header. The padding of a row repeats red pixels."""
    height, width, _ = pixels.shape
    ordered = pixels[..., ::-1] if layout.encoding == "bgr8" else pixels
    rows = ordered.reshape(height, 3 * width)
    padding = np.resize(np.array(RED, np.uint8), (height, layout.padding))
    image = Image(height=height, width=width, encoding=layout.encoding, step=3 * width + layout.padding)
    image.data = array.array("B", np.hstack([rows, padding]).tobytes())  # of bytes, each would be checked
    return image


def camera(seed: int, layout: Format = Format()) -> list[Callable[[], Node]]:
    """Return a camera, as companions of a run."""
    return [functools.partial(PostCamera, seed, layout)]
