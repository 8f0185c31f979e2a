"""The table of a league: a row for each capstone."""

from __future__ import annotations

import hashlib
import hmac
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import count

from grader.marking.extras.league.contest import Contest, Game
from grader.marking.result import Result

REFERENCE = ".reference"  # the course's own entry: no student's name begins with a dot
COLORS = "amber azure coral copper crimson gold green indigo ivory lilac olive pearl ruby silver teal violet"
BIRDS = "crane crow dove eagle falcon finch gull heron ibis kite lark owl plover raven swan wren"


@dataclass(frozen=True)
class LeagueRow:
    """One capstone in the table.

    name: its name on the page. rank: 0 for the reference. games: in the contest's order, fewer if it was
    stopped. note: what went wrong. why: the error, which may quote the programs' text.
    """

    student: str
    name: str
    games: tuple[Game, ...]
    note: str = ""
    why: str = ""
    rank: int = 0

    @property
    def delivered(self) -> int:
        """Orders that count, in all warehouses."""
        return sum(game.delivered for game in self.games)

    @property
    def orders(self) -> int:
        """All orders."""
        return sum(game.orders for game in self.games)

    @property
    def people(self) -> int:
        """Return how often it touched a person."""
        return sum(game.people for game in self.games)

    @property
    def contacts(self) -> int:
        """Return how often it touched anything else."""
        return sum(game.contacts for game in self.games)

    @property
    def pace(self) -> float | None:
        """The average time of an order that counts (s)."""
        return sum(game.waited for game in self.games) / self.delivered if self.delivered else None

    @property
    def order(self) -> tuple[float, ...]:
        """The sort key, best first: deliveries, then people, then other contacts, then time.

        A robot that was stopped early comes after those with as many deliveries.
        """
        return -self.delivered, -len(self.games), self.people, self.contacts, self.pace or 0.0


def standings(results: Iterable[Result], contest: Contest, names: Mapping[str, str]) -> list[LeagueRow]:
    """All rows, the best first; equal ones have equal ranks. names: of the rows, by student."""
    rows = sorted(
        (_row(result, contest, names[result.student]) for result in results),
        key=lambda row: (row.order, row.name),
    )
    ranked: list[LeagueRow] = []
    for row in rows:
        better = sum(other.order < row.order for other in rows if other.student != REFERENCE)
        ranked.append(row if row.student == REFERENCE else replace(row, rank=better + 1))
    return ranked


def _row(result: Result, contest: Contest, name: str) -> LeagueRow:
    games = tuple(
        Game(**game) for notebook in result.notebooks for cell in notebook.cells for game in cell.games
    )
    why = next((game.why for game in games if game.why), "")
    return LeagueRow(result.student, name, games, _note(games, contest), result.reason or why)


def _note(games: Sequence[Game], contest: Contest) -> str:
    bad = [number for number, game in enumerate(games, 1) if game.why]
    if not games:
        return "Did not play."
    if len(games) < contest.worlds:
        return f"Stopped in warehouse {len(games) + 1}: from there on, nothing counts."
    return f"Something went wrong in {len(bad)} of {len(games)} warehouses, first in {bad[0]}." if bad else ""


def anonymous_names(students: Iterable[str], key: str) -> dict[str, str]:
    """A different name for each student, such as `teal heron`, that reveals nothing without the key."""
    found: dict[str, str] = {}
    colors, birds = COLORS.split(), BIRDS.split()
    for student in sorted(students):
        if student == REFERENCE:
            found[student] = "the reference"
            continue
        for attempt in count():
            word = f"{attempt} {student}".encode(errors="surrogateescape")
            drawn = hmac.new(key.encode(), word, hashlib.sha256).digest()
            name = f"{colors[drawn[0] % len(colors)]} {birds[drawn[1] % len(birds)]}"
            name += f" {drawn[2]}" if attempt >= len(colors) else ""  # a large class
            if name not in found.values():
                break
        found[student] = name
    return found
