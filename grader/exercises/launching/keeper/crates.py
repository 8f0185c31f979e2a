"""Programs that use the types of crate_interfaces: a scanner of crates, and a dispatcher that looks for some.

In a student's notebook these are the student's own types, and a judge has those of DEFINITIONS.
"""

import random
from functools import partial
from typing import Any

from rclpy.node import Node

from grader.companions.schedule import Schedule
from grader.workspace.interfaces import Interfaces

SCANNED, FIND = "/crates", "/find_crates"
EMPTY, FULL = 0, 1
EVERY, FIRST = 0.4, 0.5  # s: between two crates, and until the first
REQUESTS = 1.9, 3.5, 5.1, 7.1  # s: each is between two crates
LABELS = ("alder", "beech", "cedar", "elm", "fir", "larch", "oak", "pine", "willow", "yew")
CRATE = "uint8 EMPTY=0\nuint8 FULL=1\nstring label\nfloat64 mass\nuint8 state\ngeometry_msgs/Point place\n"

INTERFACES = Interfaces(
    "crate_interfaces",
    definitions={
        "msg/Crate.msg": CRATE,
        "srv/FindCrates.srv": "float64 heaviest\n---\nCrate[] crates\n",
        "action/Lift.action": "string label\nfloat64 height\n---\nbool lifted\n---\nfloat64 height\n",
    },
    types={
        "msg/Crate": "RIHS01_f155374a3e5997abb913e69798eb0a34f827c8856dbeba08384efc3a01d275de",
        "srv/FindCrates": "RIHS01_08fa5f62690c5646db714a6f39775c79ba9a575ee6f05425eb61cec4f1ffd241",
        "action/Lift": "RIHS01_8804f6aa7642e8c7cfc5b7db36236128f011137f264a214a8c2b36e841c0c8ab",
    },
)


def crates(seed: int) -> list[Any]:
    """Return the programs of a seed."""
    return [partial(scanner, seed), partial(Dispatcher, seed)]


def drawn_crates(seed: int) -> list[tuple[str, float, int, tuple[float, float]]]:
    """Label, mass, state and place of each crate that is scanned; some are scanned again, changed."""
    rng = random.Random(f"crates {seed}")
    labels = rng.sample(LABELS, 6)
    order = [*labels[:4], labels[1], labels[4], labels[0], labels[5], *rng.choices(labels, k=12)]
    states = [FULL, EMPTY, FULL, FULL] + [rng.choice((EMPTY, FULL)) for _ in order[4:]]
    masses = rng.sample(range(20, 400), len(order))
    return [
        (label, mass / 10, state, (rng.randrange(100) / 10, rng.randrange(60) / 10))
        for label, mass, state in zip(order, masses, states, strict=True)
    ]


def scanner(seed: int) -> Node:
    """A scanner that publishes each crate (Crate on /crates)."""
    from crate_interfaces.msg import Crate
    from geometry_msgs.msg import Point

    rows = []
    for number, (label, mass, state, (x, y)) in enumerate(drawn_crates(seed)):
        crate = Crate(label=label, mass=mass, state=state, place=Point(x=x, y=y))
        rows.append((FIRST + number * EVERY, SCANNED, crate))
    return Schedule("scanner", rows)


class Dispatcher(Node):
    """Calls /find_crates (FindCrates), once with the exact mass of a crate that was scanned last."""

    def __init__(self, seed: int) -> None:
        super().__init__("dispatcher")
        from crate_interfaces.srv import FindCrates

        self.request, self.rng = FindCrates.Request, random.Random(f"dispatcher {seed}")
        self.masses = [mass for _, mass, _, _ in drawn_crates(seed)]
        self.client = self.create_client(FindCrates, FIND)
        self.timers_left = [self.create_timer(moment, partial(self.call, moment)) for moment in REQUESTS]

    def call(self, moment: float) -> None:
        """Send one request."""
        self.timers_left.pop(0).cancel()
        scanned = self.masses[: int((moment - FIRST) / EVERY) + 1]
        heaviest = scanned[-1] if moment == REQUESTS[1] else self.rng.choice([max(scanned), 5.0, 20.0, 30.0])
        self.client.call_async(self.request(heaviest=heaviest))
