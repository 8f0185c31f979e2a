"""Bags in which a lidar is silent for a while, and the radio for another while."""

from __future__ import annotations

import random
import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from grader.companions.recorded_robots import (
    BEGIN,
    BEST_EFFORT,
    END,
    IMU_MOUNT,
    RobotMessage,
    as_played,
    bag_rows,
    explored,
    silenced,
    static_row,
    write_rows,
)
from sim import Process
from sim.evidence import Seconds

SCAN = "/scan"
MOUNT = (0.03, 0.0, 0.0)
RELIABLE = {"reliability": "reliable", "durability": "volatile", "depth": 10}
EXTRA = "camera_link", "gps_link", "sonar_link", "cliff_link", "dock_link"


@dataclass(frozen=True)
class Drawn:
    """A drawn bag: every how many scans one is published, and what happens when (s).

    silent: when the lidar measures nothing. hiccup: when the radio delivers nothing; scans wait meanwhile.
    delay: of the radio. begins_late: the recording begins after the static transforms were published.
    """

    every: int
    silent: tuple[Seconds, Seconds]
    hiccup: tuple[Seconds, Seconds]
    delay: Seconds
    qos: dict[str, Any]
    extra: int
    begins_late: bool


def draw_bag(seed: int, *, begins_late: bool) -> Drawn:
    """The bag that a seed draws."""
    draw = random.Random(f"report {seed} {begins_late}")
    first, second = draw.uniform(6.0, 11.0), draw.uniform(16.0, 24.0)
    moments = [first, second] if draw.random() < 0.5 else [second, first]
    silent, hiccup = draw.uniform(0.7, 1.1), draw.uniform(1.5, 2.2)
    return Drawn(
        every=draw.choice((1, 2, 3, 4, 5)),
        silent=(moments[0], moments[0] + silent),
        hiccup=(moments[1], moments[1] + hiccup),
        delay=draw.uniform(0.03, 0.12),
        qos=BEST_EFFORT if begins_late else RELIABLE,  # no guess is right in both
        extra=draw.randint(0, len(EXTRA)),
        begins_late=begins_late,
    )


@lru_cache(maxsize=8)
def rows_of(seed: int, begins_late: bool) -> tuple[RobotMessage, ...]:
    """The messages of the bag that a seed draws."""
    drawn = draw_bag(seed, begins_late=begins_late)
    rows = bag_rows(explored(seed, MOUNT), seed, delay=drawn.delay)
    scans = [row for row in rows if row.topic == SCAN]
    rows = [row for row in rows if row.topic != SCAN] + scans[:: drawn.every]
    found = silenced(rows, SCAN, drawn.silent, drawn.hiccup)
    if not begins_late:
        statics = [
            {"base_scan": MOUNT},
            {"imu_link": IMU_MOUNT},
            dict.fromkeys(EXTRA[: drawn.extra], IMU_MOUNT),
        ]
        found = [*(static_row(BEGIN, frames) for frames in statics if frames), *found]
    return tuple(row for row in found if row.received < END)


def player(seed: int, *, begins_late: bool) -> Sequence[Process]:
    """The program that plays the bag."""
    drawn = draw_bag(seed, begins_late=begins_late)
    return [as_played(rows_of(seed, begins_late), {SCAN: drawn.qos}).program()]


def example_bag(seed: int = 0, *, begins_late: bool = False) -> str:
    """Write such a bag into the folder bags/report_SEED, and return the folder."""
    folder = Path("bags", f"report_{seed}{'_late' if begins_late else ''}")
    shutil.rmtree(folder, ignore_errors=True)
    write_rows(rows_of(seed, begins_late), folder, {SCAN: draw_bag(seed, begins_late=begins_late).qos})
    return str(folder)
