"""`python -m grader mark-one SUBMISSION --assignment NAME`: the command line of judging one submission."""
from __future__ import annotations

import argparse
import sys
from pathlib import Path

from grader.marking import secret
from grader.marking.atomic_file import write_atomically
from grader.marking.errors import CourseError, NotMarked, SandboxFailed, SandboxMissing
from grader.marking.extras.one_submission.judge_one import (
    Judged,
    JudgeSettings,
    chosen_cells,
    judge,
    read_release,
    read_submission,
)
from grader.marking.extras.one_submission.report import SCHEMA, LateRule, as_text, report
from grader.marking.lateness import FORM, Lateness, parse_local
from grader.marking.progress_line import printable
from grader.marking.sandbox import ResourceLimits
from grader.marking.task import TimeLimits

DESCRIPTION = """Judge one submission, a folder or a notebook, without a gradebook; write the result as JSON.

The points and sentences are those of `python -m grader mark`. The exit status is 0 if a verdict was reached,
whatever the points, 1 if the submission could not be judged, and 2 for a wrong command line. The file is
either complete or absent."""
USUAL_KB = 1000
TIMES = TimeLimits()
CONFIGURATION = "nbgrader_config.py"
NO_RESULT = "Judged, but no result was written"


class _UsageError(Exception):
    """A command line that can't be executed; the text says why."""


def parser() -> argparse.ArgumentParser:
    """The options of the command."""
    form = argparse.RawDescriptionHelpFormatter
    made = argparse.ArgumentParser("python -m grader mark-one", description=DESCRIPTION, formatter_class=form)
    add = made.add_argument
    add("submission", nargs="?", type=Path, metavar="SUBMISSION", help="a folder, or a notebook")
    add("--assignment", default="", metavar="NAME", help="such as 02_topics; its release is in exercises/")
    add("--release", type=Path, metavar="FOLDER", help="the released assignment, if it isn't in exercises/")
    add("--exercise", action="append", default=[], metavar="NAME", help="only this one; may be given again")
    add("--student", default="", metavar="NAME", help="with a secret, the worlds depend on it")
    add("--secret", type=Path, metavar="FILE", help="default: .secret in this folder, if there is one")
    add("--out", type=Path, metavar="FILE", help="default: print the result")
    add("--page", type=Path, metavar="FOLDER", help="also write the student's page there")
    add("--receipt", type=Path, metavar="FILE", help="also write a signed receipt there; needs --issuer")
    add("--issuer", default="", type=printable, metavar="TEXT", help="of the receipt: your name and contact")
    add("--due", default="", metavar="TIME", help=f'such as "{FORM}", in local time; needs --handed-in')
    add("--handed-in", default="", metavar="TIME", help="when the submission was handed in")
    percent = "points that a late day costs; default: that of nbgrader_config.py"
    add("--percent-per-day", type=_percent, metavar="PERCENT", help=percent)
    _add_limits(made)
    add("--no-self-check", action="store_true", help="don't judge a right and a wrong answer before")
    add("--unsafe", action="store_true", help="no sandbox: the student's code can do anything that you can")
    add("--schema", action="store_true", help="print the JSON schema of results, and do nothing else")
    return made


def _add_limits(form: argparse.ArgumentParser) -> None:
    add = form.add_argument
    limits = {
        "seconds": ("all cells of a notebook", TIMES.notebook),
        "cell-seconds": ("one cell", TIMES.cell),
        "test-seconds": ("the runs of one exercise", TIMES.test),
    }
    for name, (of, usual) in limits.items():
        add(f"--{name}", type=_number, default=usual, metavar="N", help=f"for {of}; default: {usual:g}")
    memory = ResourceLimits().memory_mb
    add("--memory-mb", type=_number, default=memory, metavar="N", help=f"for the code; default: {memory}")
    add("--output-kb", type=_number, default=USUAL_KB, metavar="N", help=f"in FILE; default: {USUAL_KB}")


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit status."""
    form = parser()
    options = form.parse_args(arguments)
    if options.schema:
        print(SCHEMA.read_text(encoding="utf-8"), end="")
        return 0
    try:
        if options.out:
            options.out.unlink(missing_ok=True)  # else an older result would look like this one's
        return _written(options, *_judge(options))
    except _UsageError as error:
        form.error(str(error))
    except (CourseError, NotMarked, SandboxMissing, SandboxFailed) as error:
        return _failed(str(error))
    except OSError as error:
        return _failed(f"{error.filename or 'a file'} could not be read or written ({error.strerror})")
    except KeyboardInterrupt:
        return _failed("the command was interrupted")


def _judge(options: argparse.Namespace) -> tuple[Judged, LateRule | None, str]:
    """Judge as the options say. Raises _UsageError, CourseError before anything is run."""
    if not (options.submission and options.assignment):
        raise _UsageError("expected SUBMISSION and --assignment NAME")
    if options.exercise and (options.page or options.receipt):
        raise _UsageError("--page and --receipt are for a whole assignment: leave out --exercise")
    if bool(options.receipt) != bool(options.issuer):
        raise _UsageError("expected --receipt FILE and --issuer TEXT together")
    try:
        key = secret.read_file(options.secret) if options.secret else secret.read(Path.cwd())
        late = _late_rule(options)
        release = read_release(options.release or Path("exercises", options.assignment))
        if release.assignment != options.assignment:
            release = type(release)(options.assignment, release.notebooks, release.files, release.digest)
        only = chosen_cells(release, options.exercise)
        submitted = read_submission(options.submission, release)
    except (CourseError, SystemExit) as error:
        raise _UsageError(str(error)) from None
    if options.student in (".", "..") or set(options.student) & set("/\0"):
        raise _UsageError(f"expected a name without `/` for --student, saw {options.student!r}")
    if key and not options.student:
        raise _UsageError("with a secret each student has other worlds: expected --student NAME")
    if options.receipt:
        from grader.marking.extras.one_submission.receipt_of_one import require_library

        require_library()
    memory = ResourceLimits(memory_mb=int(options.memory_mb))
    seconds = {"cell": options.cell_seconds, "test": options.test_seconds, "notebook": options.seconds}
    how = JudgeSettings(key, options.unsafe, not options.no_self_check, TimeLimits(**seconds), memory)
    return judge(options.student or "student", submitted, release, only, how), late, key


def _late_rule(options: argparse.Namespace) -> LateRule | None:
    if bool(options.due) != bool(options.handed_in):
        raise _UsageError("expected --due TIME and --handed-in TIME together")
    if not options.due:
        return None
    lateness = Lateness(parse_local(options.due), parse_local(options.handed_in))
    percent = options.percent_per_day
    return LateRule(lateness, _usual_percent() if percent is None else percent)


def _usual_percent() -> float:
    """The percent of the course in this folder; 0 if there is none."""
    if not Path(CONFIGURATION).is_file():
        return 0.0
    from grader.marking.gradebook.course import Course
    from grader.marking.gradebook.late_days import LateDays

    return float(LateDays(parent=Course(Path.cwd()).app).percent_per_day)


def _written(options: argparse.Namespace, judged: Judged, late: LateRule | None, key: str) -> int:
    """Write all that was requested, or say why not; returns the exit status."""
    try:
        _write(options, judged, late, key)
    except CourseError as error:
        return _failed(str(error), NO_RESULT)
    except OSError as error:
        return _failed(f"{error.filename or 'a file'} could not be written ({error.strerror})", NO_RESULT)
    return 0


def _write(options: argparse.Namespace, judged: Judged, late: LateRule | None, key: str) -> None:
    """Write all that was requested; the result last. Raises CourseError, OSError."""
    data = report(judged, late)
    if options.receipt:
        from grader.marking.extras.one_submission.receipt_of_one import write_receipt

        write_receipt(judged, data, options.issuer, key, options.receipt)
    if options.page:
        from grader.marking.extras.one_submission.page_of_one import write_pages

        write_pages(judged, late, Path(CONFIGURATION), options.page)
    text = as_text(data, 1000 * options.output_kb)
    if options.out:
        write_atomically(options.out, text)
    else:
        print(text, end="")


def _failed(why: str, what: str = "Not judged") -> int:
    print(printable(f"{what}: {why.rstrip('.')}."), file=sys.stderr)
    return 1


def _number(word: str) -> float:
    number = _float(word)
    if not 1 <= number <= 100_000:
        raise argparse.ArgumentTypeError(f"expected a number from 1 to 100000, saw {word!r}")
    return number


def _percent(word: str) -> float:
    number = _float(word)
    if not 0 <= number <= 100:
        raise argparse.ArgumentTypeError(f"expected a number from 0 to 100, saw {word!r}")
    return number


def _float(word: str) -> float:
    try:
        return float(word)
    except ValueError:
        return -1.0
