"""`python -m grader league`: the command line."""

import argparse
import sys
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from dataclasses import replace
from pathlib import Path

from grader.marking.cores import usable_cores
from grader.marking.errors import CourseError, SandboxFailed, SandboxMissing
from grader.marking.extras.league.contest import Contest
from grader.marking.extras.league.entries import Entries, of_class, of_notebooks
from grader.marking.extras.league.league_pages import write_pages
from grader.marking.extras.league.play_league import (
    DrawnLeague,
    LeagueOutcome,
    draw_league,
    play,
    time_limits,
)
from grader.marking.extras.league.standings import REFERENCE, LeagueRow, anonymous_names, standings
from grader.marking.journal import Journal
from grader.marking.pool import Pool
from grader.marking.progress_line import printable
from grader.marking.sandbox import ResourceLimits
from grader.marking.task import TaskPool

DESCRIPTION = """Let delivery robots work in the same warehouses, and compare them.

Without a NOTEBOOK, these are all submissions of a class, in new warehouses. The pages are in class/league/,
where the robots have anonymous names; the table on the terminal shows both. With notebooks, for example
this week's and last week's versions of your own, they work in public warehouses, and the pages are in
work/league/. The same command resumes after a stop, and runs again only what has changed."""
ASSIGNMENT = "13b_delivery"
INTERRUPTED = 130  # the exit status of shells
MAX_SECONDS = 2400.0  # s of simulated time in all warehouses together
MAX_NOTE_CHARS = 100  # of a row's note

OpenPool = Callable[[argparse.Namespace, Contest], AbstractContextManager[TaskPool]]


def parser() -> argparse.ArgumentParser:
    """The options of the command."""
    form = argparse.RawDescriptionHelpFormatter
    made = argparse.ArgumentParser("python -m grader league", description=DESCRIPTION, formatter_class=form)
    add = made.add_argument
    add("notebooks", nargs="*", metavar="NOTEBOOK")
    add("--worlds", type=_number, metavar="N", help="how many warehouses; default: 10")
    add("--seconds", type=_number, metavar="S", help="simulated, in each; default: 120")
    add("--robots", type=int, choices=(1, 2, 3), help="in each, with the same programs; default: 1")
    add("--seed", metavar="TEXT", help="draw the warehouses from this text, which a league's page shows")
    add("--draw", action="store_true", help="draw new warehouses for a class that has played already")
    which = f"whose last exercise receives the programs; default: {ASSIGNMENT}"
    add("--assignment", default=ASSIGNMENT, help=which)
    add("--jobs", type=_number, metavar="N", help="robots at a time; default: as many as cores")
    add("--unsafe", action="store_true", help="no sandbox: the notebooks' code can do anything that you can")
    return made


def main(arguments: list[str] | None = None, open_pool: OpenPool | None = None) -> int:
    """Run the command in the course's folder; returns the exit status. open_pool: opens another pool."""
    options = parser().parse_args(arguments)
    own = bool(options.notebooks)
    folder = Path.cwd() / ("work" if own else "class") / "league"
    journal = Journal(folder / options.assignment)
    try:
        entries = _entries(options)
        with journal.hold_lock():
            drawing = _draw_league(options, journal)
            journal.save_settings(drawing.as_dict())
            opened = open_pool or _open_pool
            played = play(entries, drawing.contest, journal, lambda: opened(options, drawing.contest))
            if not played.interrupted:
                _report(played, entries, drawing, folder, own=own)
    except (CourseError, SandboxMissing, SandboxFailed) as error:
        text = f"Not played: {error}"
        print(text if text.endswith((".", "?")) else f"{text}.", file=sys.stderr)
        return 1
    except OSError as error:
        what = f"{error.filename or 'a file'} could not be written ({error.strerror})"
        print(f"Stopped: {what}. Fix this: the same command continues.", file=sys.stderr)
        return 1
    if played.interrupted:
        done = f"{len(played.results)} of {played.total} have played, and their results are stored"
        print(f"Stopped. {done}: the same command continues.", file=sys.stderr)
        return INTERRUPTED
    return 0


def _entries(options: argparse.Namespace) -> Entries:
    if options.notebooks:
        return of_notebooks(Path.cwd(), options.assignment, options.notebooks)
    return of_class(Path.cwd(), options.assignment)


def _draw_league(options: argparse.Namespace, journal: Journal) -> DrawnLeague:
    seed = options.seed if options.seed is not None or not options.notebooks else ""
    given = options.worlds, options.seconds, options.robots
    drawing = draw_league(journal, *given, seed, anew=options.draw)
    whole = drawing.contest.worlds * drawing.contest.seconds
    if whole > MAX_SECONDS:
        saw = f"{drawing.contest.worlds} of {drawing.contest.seconds:g} s"
        raise CourseError(f"expected at most {MAX_SECONDS:g} s in all warehouses together, saw {saw}")
    return drawing


def _open_pool(options: argparse.Namespace, contest: Contest) -> Pool:
    whole = int(contest.worlds * contest.seconds)
    usual = ResourceLimits()
    limits = replace(usual, cpu_s=usual.cpu_s + whole, wall_s=usual.wall_s + whole)
    jobs = options.jobs or len(usable_cores())
    return Pool(jobs, options.unsafe, time_limits=time_limits(contest), limits=limits)


def _report(
    played: LeagueOutcome, entries: Entries, drawing: DrawnLeague, folder: Path, *, own: bool
) -> None:
    students = list(entries.read)
    names = {name: name for name in students} if own else anonymous_names(students, drawing.key)
    rows = standings(played.results, drawing.contest, names)
    index = write_pages(folder, rows, drawing.contest, own=own)
    print("\n".join(_table(rows, own=own)))
    print(f"\n{played.fresh} played now, {len(rows)} in all: {index}")


def _table(rows: Sequence[LeagueRow], *, own: bool) -> list[str]:
    head = ["", "robot", *([] if own else ["student"]), "delivered", "people", "contacts", "s an order", ""]
    lines = [head]
    for row in rows:
        student = [] if own else ["" if row.student == REFERENCE else row.student]
        counts = [f"{row.delivered} of {row.orders}", f"{row.people}", f"{row.contacts}"]
        pace = f"{row.pace:.1f}" if row.pace is not None else ""
        note = printable(" ".join(filter(None, (row.note, row.why))))
        note = note if len(note) <= MAX_NOTE_CHARS else f"{note[: MAX_NOTE_CHARS - 3]}..."
        lines.append([f"{row.rank or ''}", row.name, *map(printable, student), *counts, pace, note])
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return ["  ".join(map(str.ljust, line, widths)).rstrip() for line in lines]


def _number(word: str) -> int:
    if not (word.isdecimal() and 0 < int(word) <= MAX_SECONDS):
        raise argparse.ArgumentTypeError(f"expected a whole number from 1 to {MAX_SECONDS:g}, saw {word!r}")
    return int(word)
