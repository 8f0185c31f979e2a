"""The order of a run: which of the choices that nothing fixes differ from the usual ones."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from functools import cached_property
from hashlib import blake2b
from typing import Any, NamedTuple

from sim.nanoseconds import Nanoseconds, nanoseconds

# What may vary: between processes on one machine; between machines; whatever nothing guarantees.
HOST, NETWORK, ANY = LEVELS = "host", "network", "any"
SPREAD = 0.005  # s
LATEST_START, STARTS_LATE = 0.5, 0.5  # s, and the share of programs that start later
LATEST_KEPT, KEPT_LATE = (
    0.1,
    0.5,
)  # s, and the share of subscriptions that get later what a latched topic keeps
MOST_PROGRAMS = 10  # whose starts are looked at to know when all have started
INTENSITIES = 0.05, 0.2, 0.5  # of the choices made, the share that departs from the usual one
_FORM = re.compile(
    r"(?:(?P<level>host|network|any)-)?(?P<key>[0-9A-Za-z]+)"
    r"(?:@(?P<spread>\d+(?:\.\d+)?)ms)?(?:\+(?P<late>\d+(?:\.\d+)?)s)?(?P<only>:[0-9a-f,]*)?"
)


class Draw(NamedTuple):
    """An order's draw for one choice. chance and value are in [0, 1) and independent."""

    id: str
    chance: float
    value: float


@dataclass(frozen=True)
class Order:
    """One of the orders in which a run can happen; its text, such as "17", stands for it anywhere.

    key: from which all choices are drawn; any letters and digits. level: what may vary. spread: by how much
    a message may be late (s). late: by how much a program may start later (s). only: the ids of the
    departures that are made; None for all that are drawn.

    Each choice is drawn from the key and the choice's own name alone, such as a time, a node and a topic. So
    other choices don't shift it, and two processes that share a run draw the same.
    """

    key: str
    level: str = NETWORK
    spread: float = SPREAD
    late: float = LATEST_START
    only: frozenset[str] | None = None

    @classmethod
    def parse(cls, order: Any) -> Order | None:
        """The order of a number or a text; None for 0, the usual order.

        Raises TypeError for anything else, ValueError for a text that is no order.
        """
        if order is None or order == "" or isinstance(order, Order):
            return order or None
        if isinstance(order, bool) or not isinstance(order, int | str):
            raise TypeError(f"order must be a whole number, or a string such as 'k3f9'; it is {order!r}.")
        form = _FORM.fullmatch(str(order))
        if form is None:
            raise ValueError(
                f"order must be 0 or more, or the string of an order such as 'k3f9'; it is {order!r}."
            )
        level, key, spread, late, only = form.group("level", "key", "spread", "late", "only")
        if key == "0":
            return None
        return cls(
            key,
            level or NETWORK,
            SPREAD if spread is None else float(spread) / 1000,
            LATEST_START if late is None else float(late),
            None if only is None else frozenset(filter(None, only[1:].split(","))),
        )

    def __str__(self) -> str:
        level = "" if self.level == NETWORK else f"{self.level}-"
        spread = "" if self.spread == SPREAD else f"@{self.spread * 1000:g}ms"
        late = "" if self.late == LATEST_START else f"+{self.late:g}s"
        only = "" if self.only is None else f":{','.join(sorted(self.only))}"
        return f"{level}{self.key}{spread}{late}{only}"

    def limited_to(self, departures: frozenset[str]) -> Order:
        """The order in which only these departures are made."""
        return replace(self, only=departures)

    @cached_property
    def intensity(self) -> float:
        """The share of choices that depart from the usual one."""
        return INTENSITIES[int(self.draw("intensity").value * len(INTENSITIES))]

    @cached_property
    def _hash_key(self) -> bytes:
        return self.key.encode()[:64]

    def draw(self, *name: object) -> Draw:
        """Return what is drawn for the choice of this name."""
        text = "\0".join(map(str, name)).encode(errors="surrogateescape")
        drawn = blake2b(text, digest_size=11, key=self._hash_key).digest()
        chance, value = int.from_bytes(drawn[3:7]), int.from_bytes(drawn[7:])
        return Draw(drawn[:3].hex(), chance / 2**32, value / 2**32)

    def start(self, program: int) -> tuple[Draw, Nanoseconds]:
        """Return how much later than usual the student's program of this number starts, and its draw."""
        draw = self.draw("start", program)
        late = self.departs(draw, STARTS_LATE)
        return draw, int(draw.value * nanoseconds(self.late)) if late else 0

    @property
    def all_started(self) -> Nanoseconds:
        """Return when all of the student's programs that start with the run have started."""
        return max(self.start(program)[1] for program in range(MOST_PROGRAMS))

    def delay(self, now: Nanoseconds, sender: str, topic: str, receiver: str) -> tuple[Draw, Nanoseconds]:
        """Return how late a node's messages on a topic reach another node now; and what is drawn for it."""
        draw = self.draw("message", now, sender, topic, receiver)
        late = self.departs(draw, self.intensity / 2)
        return draw, 1 + int(draw.value * nanoseconds(self.spread)) if late else 0

    def kept_delay(self, sender: str, topic: str, receiver: str) -> tuple[Draw, Nanoseconds]:
        """Return how late a new subscription gets what a latched topic has kept; and what is drawn for it."""
        draw = self.draw("kept", sender, topic, receiver)
        late = self.departs(draw, KEPT_LATE)
        return draw, 1 + int(draw.value * nanoseconds(LATEST_KEPT)) if late else 0

    def departs(self, draw: Draw, probability: float) -> bool:
        """Return whether this draw's choice departs from the usual one, as it does with this probability."""
        return draw.chance < probability if self.only is None else draw.id in self.only
