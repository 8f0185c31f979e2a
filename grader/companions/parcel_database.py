"""A database that is used with asyncio, and a scanner that reads the labels of parcels."""

import asyncio
import functools
import random
from collections.abc import Callable

from rclpy.node import Node
from std_msgs.msg import String

from grader.companions.schedule import Row, Schedule
from sim.evidence import Seconds

LABELS = "/label"
QUICKEST, SLOWEST = 0.6, 1.4  # s
BURSTS = (1.0, 2), (4.0, 3), (7.0, 1), (10.0, 3)  # when each begins (s), and its labels, 0.2 s apart


async def shelf_of(label: str) -> str:
    """Return the shelf of a parcel, such as "C7". The database takes about a second for its answer."""
    await asyncio.sleep(seconds_for(label))
    return stored(label)


def stored(label: str) -> str:
    """Return what the database has of a parcel."""
    draw = random.Random(f"shelf {label}")
    return f"{draw.choice('ABCDEFGH')}{draw.randint(1, 9)}"


def seconds_for(label: str) -> Seconds:
    """Return how long the database takes for a parcel."""
    return round(random.Random(f"time {label}").uniform(QUICKEST, SLOWEST), 2)


def scanner(seed: int) -> list[Callable[[], Node]]:
    """Return a program that publishes labels on /label, all different, up to three in a short time."""
    stamps = [begin + 0.2 * index for begin, size in BURSTS for index in range(size)]
    numbers = random.Random(f"labels {seed}").sample(range(100, 1000), len(stamps))
    labels = [String(data=f"P{number}") for number in numbers]
    rows: list[Row] = [(stamp, LABELS, label) for stamp, label in zip(stamps, labels, strict=True)]
    return [functools.partial(Schedule, "scanner", rows)]
