"""`python -m grader mark ASSIGNMENT`: the command line of marking a class."""
import argparse
import contextlib
import errno
import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from dataclasses import replace
from pathlib import Path

from grader.marking.atomic_file import write_atomically
from grader.marking.command import machine
from grader.marking.command.dry_run import rehearse
from grader.marking.command.mark_class import OpenPool, Outcome, Settings, mark_class
from grader.marking.command.summary import summarize
from grader.marking.command.summary_page import as_page, page_links
from grader.marking.command.summary_text import MANY, as_csv, as_text
from grader.marking.cores import usable_cores
from grader.marking.errors import CourseError, DaskPoolError, SandboxFailed, SandboxMissing
from grader.marking.gradebook.course import Course
from grader.marking.journal import Journal
from grader.marking.pool import Pool
from grader.marking.progress_line import printable
from grader.marking.sandbox.confinement import USER
from grader.marking.self_check import check_marking
from grader.marking.task import TaskPool
from grader.marking.version import course_version
from grader.plugins import POOLS, plugin

DESCRIPTION = """Mark what students handed in, in class/submitted/STUDENT/ASSIGNMENT/.

A submission that was marked and has not changed is not marked again, so the same command resumes after a
stop and marks what is submitted later. Results are stored in class/marking/; points go to nbgrader's
gradebook, notebooks to class/autograded/ and students' pages to class/feedback/, as after
`nbgrader autograde` and `nbgrader generate_feedback`."""
INTERRUPTED = 130  # the exit status of shells
WEAKER = "Here bubblewrap can't make a sandbox, so each student's process is a {}: see grader/README.md."
NO_DASK = "several machines are an extra that is not installed here: leave out --dask"
USUAL_JOBS = len(usable_cores())


def parser() -> argparse.ArgumentParser:
    """The options of the command."""
    form = argparse.RawDescriptionHelpFormatter
    made = argparse.ArgumentParser("python -m grader mark", description=DESCRIPTION, formatter_class=form)
    add = made.add_argument
    add("assignment", nargs="?", default="", metavar="ASSIGNMENT")
    add("--check", action="store_true", help="report what this machine lacks, and do nothing else")
    add("--student", action="append", default=[], metavar="NAME", help="only this one; may be given again")
    add("--jobs", type=_count, metavar="N", help="submissions at a time; default: as many as cores")
    add("--force", action="store_true", help="mark again what has already been marked")
    add("--resume", action="store_true", help="continue the last run of the assignment, with its options")
    add("--unsafe", action="store_true", help="no sandbox: students' code can do anything that you can")
    add("--no-feedback", action="store_true", help="don't make pages for students")
    add("--dry-run", action="store_true", help="print whose marks would change and why; write nothing")
    add("--csv", default="", metavar="FILE", help="write the points there, a row per student and exercise")
    add("--html", default="", metavar="FILE", help="write the summary there, as a page")
    add("--dask", default="", metavar="ADDRESS", help="mark on the workers of this Dask scheduler")
    return made


def main(arguments: list[str] | None = None, open_pool: OpenPool | None = None) -> int:
    """Run the command in the course's folder; returns the exit status. open_pool: opens another pool."""
    form = parser()
    options = form.parse_args(arguments)
    if not (options.assignment or options.check):
        form.error("the following arguments are required: ASSIGNMENT")
    if options.dry_run and (options.csv or options.html):
        form.error("--dry-run writes nothing: leave out --csv and --html")
    try:
        course = Course(Path.cwd())
        settings = _settings(options, course)
        if options.check:
            return _check(course, settings, open_pool or _open_pool)
        if options.dry_run:
            rehearsal = rehearse(course, options.assignment, settings, open_pool or _open_pool)
            print("\n".join(rehearsal.lines(options.assignment)))
            return 0
        outcome = mark_class(course, options.assignment, settings, open_pool or _open_pool)
        _report(options, course, settings, outcome)
    except (CourseError, SandboxMissing, SandboxFailed) as error:
        text = f"Not marked: {error}"
        print(text if text.endswith((".", "?")) else f"{text}.", file=sys.stderr)
        return 1
    except OSError as error:
        advice = "free some space" if error.errno in (errno.ENOSPC, errno.EDQUOT) else "fix this"
        why = f"{error.filename or 'a file'} could not be written ({error.strerror})"
        return _stopped(why, options, advice)
    except DaskPoolError as error:
        return _stopped(str(error), options)
    return INTERRUPTED if outcome.interrupted else int(bool(outcome.problems))


def _check(course: Course, settings: Settings, open_pool: OpenPool) -> int:
    lacking = list(machine.missing(course, lambda: open_pool(settings, "")))
    for sentence in [*lacking, *machine.weaknesses(course)]:
        text = sentence[0].upper() + sentence[1:]
        print(text if text.endswith(".") else f"{text}.", file=sys.stderr if lacking else sys.stdout)
    if not lacking:
        print("Nothing is missing: a right answer and a wrong one were marked correctly.")
    return int(bool(lacking))


def _settings(options: argparse.Namespace, course: Course) -> Settings:
    """The settings of the options, or of the last run."""
    jobs = options.jobs or USUAL_JOBS
    given = Settings(
        *(sorted(options.student), options.force, jobs, options.unsafe, not options.no_feedback),
        *(options.csv, options.html, options.dask),
    )
    if not options.resume:
        return given
    if given != Settings(jobs=jobs, dask=options.dask):
        advice = "give no others except --jobs and --dask"
        raise CourseError(f"--resume takes the options of the last run: {advice}")
    stored = Journal(course.journal(options.assignment)).settings()
    if stored is None:
        raise CourseError(f"there is no run of {options.assignment} to continue: leave out --resume")
    last = Settings(**stored)
    return replace(last, jobs=options.jobs or last.jobs, dask=options.dask or last.dask)


@contextlib.contextmanager
def _open_pool(settings: Settings, secret: str) -> Iterator[TaskPool]:
    """A pool that marks correctly. Raises SandboxMissing and SandboxFailed."""
    opened: AbstractContextManager[TaskPool]
    if settings.dask:
        opened = _dask_pool()(settings.dask, settings.unsafe, secret)
    else:
        opened = Pool(settings.jobs, settings.unsafe, secret)
    with opened as pool:
        if isinstance(pool, Pool) and pool.isolation.startswith(USER):
            print(WEAKER.format(pool.isolation), file=sys.stderr)
        check_marking(pool)
        yield pool


def _dask_pool() -> Callable[[str, bool, str], AbstractContextManager[TaskPool]]:
    """The pool on other machines, which is an extra. Raises CourseError where there is none."""
    if not (entry := plugin(POOLS, "dask")):
        raise CourseError(NO_DASK)
    opens: Callable[[str, bool, str], AbstractContextManager[TaskPool]] = entry.load()
    return opens


def _report(options: argparse.Namespace, course: Course, settings: Settings, outcome: Outcome) -> None:
    about = outcome.worth, outcome.results, outcome.standings, outcome.notes
    summary = summarize(options.assignment, *about, course_version())
    if outcome.results:
        print(as_text(summary))
    if outcome.due:
        print(f"\n{outcome.due}")
    file = settings.csv
    if not file and len(outcome.results) > MANY:
        file = str(course.table(options.assignment).relative_to(Path.cwd()))
        print(f"\nThe points and flags of each student are in {file}.")
    if file:
        write_atomically(Path(file), as_csv(options.assignment, outcome.results, outcome.standings))
    if settings.html:
        links = page_links(course, options.assignment, outcome.results, Path(settings.html))
        write_atomically(Path(settings.html), as_page(summary, links))
    all_of_it = f"{len(outcome.results)} of {outcome.total} in all"
    print(f"\n{len(outcome.fresh)} marked now, {all_of_it}, in {outcome.seconds:.1f} s.")
    for problem in outcome.problems:
        print(printable(problem), file=sys.stderr)
    if outcome.interrupted or outcome.problems:
        done = f"{len(outcome.results)} of {outcome.total} submissions are marked and stored"
        print(f"Stopped. {done}: {_again(options)}.", file=sys.stderr)


def _stopped(why: str, options: argparse.Namespace, advice: str = "fix this") -> int:
    print(f"Stopped: {why}. What is marked is stored: {advice}, then {_again(options)}.", file=sys.stderr)
    return 1


def _again(options: argparse.Namespace) -> str:
    return f"continue with `python -m grader mark {options.assignment} --resume`"


def _count(word: str) -> int:
    if not (word.isdecimal() and 0 < int(word) <= 512):
        raise argparse.ArgumentTypeError(f"expected a number from 1 to 512, saw {word!r}")
    return int(word)
