"""A database of parcels that is used by messages, and a scanner that reads the labels of parcels."""

import functools
import random
from collections.abc import Callable

from rclpy.node import Node
from std_msgs.msg import String

from grader.companions.schedule import Row, Schedule
from grader.exercises.warehouse.shelves.parcel_library import FOUND, QUERIES
from sim.evidence import Seconds

WITH_JUDGE = True  # it knows all shelves
LABELS = "/label"
QUICKEST, SLOWEST = 0.6, 1.4  # s
BURSTS = (1.0, 2), (4.0, 3), (7.0, 1), (10.0, 3)  # when each begins (s), and its labels, 0.2 s apart


class Database(Node):
    """Publishes the shelf of each label that it is sent; only a run's seed says which shelf that is."""

    def __init__(self, seed: int) -> None:
        super().__init__("database")
        self.seed = seed
        self.found = self.create_publisher(String, FOUND, 100)
        self.create_subscription(String, QUERIES, self.on_query, 100)

    def on_query(self, query: String) -> None:
        """Publish the shelf once the search has taken its time."""

        def publish() -> None:
            timer.cancel()
            self.found.publish(String(data=f"{query.data} {stored(self.seed, query.data)}"))

        timer = self.create_timer(seconds_for(self.seed, query.data), publish)


def stored(seed: int, label: str) -> str:
    """Return what the database of a seed has of a parcel."""
    draw = random.Random(f"shelf {seed} {label}")
    return f"{draw.choice('ABCDEFGH')}{draw.randint(1, 9)}"


def seconds_for(seed: int, label: str) -> Seconds:
    """Return how long the database takes for a parcel."""
    return round(random.Random(f"time {seed} {label}").uniform(QUICKEST, SLOWEST), 2)


def scanner(seed: int) -> list[Callable[[], Node]]:
    """Return the database, and a program that publishes labels on /label.

    The labels are all different, up to three in a short time.
    """
    stamps = [begin + 0.2 * index for begin, size in BURSTS for index in range(size)]
    numbers = random.Random(f"labels {seed}").sample(range(100, 1000), len(stamps))
    labels = [String(data=f"P{number}") for number in numbers]
    rows: list[Row] = [(stamp, LABELS, label) for stamp, label in zip(stamps, labels, strict=True)]
    return [functools.partial(Database, seed), functools.partial(Schedule, "scanner", rows)]
