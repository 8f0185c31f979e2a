"""Runs the entries that have no result yet, and stores each result, so that a stopped league can continue."""

from __future__ import annotations

import contextlib
import itertools
import secrets
from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import asdict, dataclass, field
from typing import Any

from grader.marking.extras.league.contest import Contest
from grader.marking.extras.league.entries import Entries
from grader.marking.journal import Journal, JournalEntry
from grader.marking.progress_line import ProgressLine
from grader.marking.result import Result
from grader.marking.task import TaskPool, TimeLimits


@dataclass
class LeagueOutcome:
    """All results. total: number of entries. fresh: how many played now. interrupted: by Ctrl-C."""

    results: list[Result] = field(default_factory=list)
    total: int = 0
    fresh: int = 0
    interrupted: bool = False


def play(
    entries: Entries,
    contest: Contest,
    journal: Journal,
    open_pool: Callable[[], AbstractContextManager[TaskPool]],
) -> LeagueOutcome:
    """Run the contest with all entries. The caller holds the journal's lock. Raises OSError."""
    played = LeagueOutcome(total=len(entries.read))
    with contextlib.closing(ProgressLine(played.total)) as progress:

        def found(entry: JournalEntry) -> None:
            played.results.append(entry.result)
            progress.skip()

        tasks = entries.tasks(contest)
        unplayed = journal.unmarked(tasks, found)
        try:
            first = next(unplayed, None)
            if first is not None:
                with open_pool() as pool:
                    for result in pool.mark(itertools.chain([first], unplayed)):
                        played.results.append(journal.save(result).result)
                        played.fresh += 1
                        progress.add_line(f"{result.student.lstrip('.')}: {_done(result)}")
        except KeyboardInterrupt:
            played.interrupted = True
            with contextlib.suppress(KeyboardInterrupt):
                list(journal.unmarked(tasks, found))  # the count is of all results
    return played


def _done(result: Result) -> str:
    games = [game for notebook in result.notebooks for cell in notebook.cells for game in cell.games]
    return f"{sum(game['delivered'] for game in games)} delivered in {len(games)} warehouses"


def time_limits(contest: Contest) -> TimeLimits:
    """Limits that stop programs which are slower than the simulated time."""
    usual, whole = TimeLimits(), contest.worlds * contest.seconds
    return TimeLimits(test=max(usual.test, whole), notebook=usual.notebook + whole)


@dataclass(frozen=True)
class DrawnLeague:
    """A league as it was drawn. key: the secret from which the names of the robots are derived."""

    contest: Contest
    key: str

    def as_dict(self) -> dict[str, Any]:
        """Plain data, ready for JSON."""
        return asdict(self)


def draw_league(
    journal: Journal,
    worlds: int | None,
    seconds: float | None,
    robots: int | None,
    seed: str | None,
    *,
    anew: bool,
) -> DrawnLeague:
    """The league that was drawn here before, with the given changes; or a new one.

    seed: the text from which its warehouses are drawn; None, or `anew`, for a random one.
    """
    kept = journal.settings() or {}
    before = Contest(**kept["contest"]) if "contest" in kept else Contest(seed=secrets.token_hex(8))
    drawn = seed if seed is not None else secrets.token_hex(8) if anew else before.seed
    contest = Contest(drawn, worlds or before.worlds, seconds or before.seconds, robots or before.robots)
    return DrawnLeague(contest, kept.get("key") or secrets.token_hex(16))
