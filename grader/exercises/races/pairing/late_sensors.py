"""A camera and a lidar whose messages are late, lost, and at times held up for seconds."""

from __future__ import annotations

import functools

import numpy as np
from sensor_msgs.msg import Image, LaserScan

from grader.companions.tape import Row, Tape
from sim.evidence import Seconds

TICK = 0.02  # s
IMAGE, SCAN = "/camera/image_raw", "/scan"
PERIODS = {IMAGE: 10, SCAN: 5}  # ticks between two measurements
LATE, SOON = (3, 13), (0, 3)  # ticks that messages are on their way, from and below; of either sensor
OFFSET, LOST = 1, 0.1  # ticks by which an image's moment differs from a scan's; the share that gets lost
FIRST, LAST, HELD, PACE = 50, 1150, (550, 800), 1  # ticks; a stall; between two messages after one
SECONDS: Seconds = 26.0


def sensor_rows(held: str, seed: int) -> dict[int, list[Row]]:
    """The messages of each tick. held: the topic that is late, and held up from 11 s to 16 s."""
    draw = np.random.default_rng([seed, 152])
    rows: dict[int, list[Row]] = {}
    for topic, period in PERIODS.items():
        before = 0
        for measured in range(FIRST, LAST, period):
            moment = measured + (OFFSET if topic == IMAGE else 0)
            arrives = moment + int(draw.integers(*(LATE if topic == held else SOON)))
            if topic == held and HELD[0] <= moment < HELD[1]:
                arrives = max(arrives, HELD[1])
            before = arrives = max(arrives, before + PACE)
            if draw.random() >= LOST:
                rows.setdefault(arrives, []).append((topic, _message(topic), arrives - moment))
    return rows


def _message(topic: str) -> Image | LaserScan:
    """A message without a stamp; an image of four pixels, or a scan of four rays."""
    if topic == IMAGE:
        image = Image(height=2, width=2, encoding="mono8", step=2, data=[0, 0, 0, 0])
        image.header.frame_id = "camera"
        return image
    scan = LaserScan(angle_increment=1.57, range_max=8.0, ranges=[1.0, 1.0, 1.0, 1.0])
    scan.header.frame_id = "base_scan"
    return scan


class LateSensors(Tape):
    """Publishes /camera/image_raw (Image) at 5 Hz and /scan (LaserScan) at 10 Hz."""

    def __init__(self, held: str, seed: int) -> None:
        types = {IMAGE: Image, SCAN: LaserScan}
        super().__init__("sensors", round(TICK * 1e9), types, sensor_rows(held, seed))


def late_sensors(held: str, seed: int) -> list[functools.partial[LateSensors]]:
    """The companions of a run. held: the topic that is late, and held up for 5 s."""
    return [functools.partial(LateSensors, held, seed)]
