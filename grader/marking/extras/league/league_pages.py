"""The pages of a league: the table, and for each warehouse the replays beside each other.

Everything in them is escaped, they need no external resources, and they quote texts of programs only if all
programs are the reader's own.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from markupsafe import Markup

from grader.marking.atomic_file import write_atomically
from grader.marking.extras.league.contest import Contest
from grader.marking.extras.league.standings import REFERENCE, LeagueRow
from grader.marking.page_templates import template_environment
from sim.view.ghost_replay import player
from sim.view.replay import PLAYER_SCRIPT

INDEX = "league.html"


def write_pages(folder: Path, rows: Sequence[LeagueRow], contest: Contest, *, own: bool) -> Path:
    """Write all pages; return the first one. own: all rows are the reader's. Raises OSError."""
    names = [f"warehouse_{number:02}.html" for number in range(1, contest.worlds + 1)]
    shown = {"rows": rows, "contest": contest, "own": own, "pages": names, "ghost": _ghost(rows)}
    index = folder / INDEX
    write_atomically(index, _pages.get_template("table.html").render(**shown).lstrip())
    for number, name in enumerate(names):
        text = _pages.get_template("warehouse.html").render(
            **shown, number=number, players=_players(rows, number), script=Markup(PLAYER_SCRIPT)
        )
        write_atomically(folder / name, text.lstrip())
    return index


def _ghost(rows: Sequence[LeagueRow]) -> LeagueRow | None:
    """The robot that is shown in the others' replays: the reference, or else the first."""
    return next((row for row in rows if row.student == REFERENCE), rows[0] if rows else None)


def _players(rows: Sequence[LeagueRow], number: int) -> list[tuple[LeagueRow, Markup]]:
    """The replays of one warehouse, in the order of the table."""
    ghost = _ghost(rows)
    runs = {row.student: row.games[number].replay for row in rows if len(row.games) > number}
    there = runs.get(ghost.student, "") if ghost else ""
    found = []
    for row in rows:
        run = runs.get(row.student, "")
        along = there if row is not ghost else ""
        made = player(run, "This replay needs scripts.", along) if run else ""
        found.append((row, Markup(made)))
    return found


_pages = template_environment(Path(__file__).parent)
