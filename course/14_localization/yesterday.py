"""Yesterday's bag, and what really happened."""

import math
from pathlib import Path
from shutil import rmtree

from grader.companions.recorded_robots import (
    BEGIN,
    IMU_MOUNT,
    bag_rows,
    explored,
    silenced,
    static_row,
    write_rows,
)
from sim import Recording

SEED, ASKEW = 4, math.radians(9.0)
CLAIMED, REAL = (0.03, 0.0, 0.0), (0.03, 0.0, ASKEW)
SILENT, HICCUP = (9.0, 9.8), (17.0, 19.0)  # s: the lidar, and the radio


def write(folder: str) -> str:
    """Write the bag into a folder, which is made anew; returns it."""
    rmtree(folder, ignore_errors=True)
    rows = silenced(bag_rows(explored(SEED, REAL), SEED), "/scan", SILENT, HICCUP)
    statics = [static_row(BEGIN, frames) for frames in ({"base_scan": CLAIMED}, {"imu_link": IMU_MOUNT})]
    return str(write_rows([*statics, *rows], Path(folder)))


def truth() -> Recording:
    """What really happened."""
    return explored(SEED, REAL)
