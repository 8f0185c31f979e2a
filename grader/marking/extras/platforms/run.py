"""Judges a submission in a platform's container: `python -m grader.marking.extras.platforms.run PLATFORM`.

The working folder is the bundle's. If no verdict was reached, no result is written, and the exit status is
not 0: each of the platforms then reports to the instructor that the autograder failed.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from grader.marking import secret
from grader.marking.atomic_file import write_atomically
from grader.marking.errors import CourseError
from grader.marking.extras.one_submission import cli as mark_one
from grader.marking.extras.platforms import classroom50, gradescope, prairielearn
from grader.marking.extras.platforms.bundle import SECRET, PlatformSettings
from grader.marking.extras.platforms.texts import instructor_text
from grader.marking.progress_line import printable

AUTOGRADER, GRADE = Path("/autograder"), Path("/grade")


@dataclass(frozen=True)
class PlatformJob:
    """A submission that a platform wants judged.

    outputs: makes the content of its files from a report, by path. closed: folders that no student's process
    may enter. late: the options of `mark-one` on lateness. instructors_read: what is printed is shown to
    instructors, and to no student.
    """

    submission: Path
    student: str
    outputs: Callable[[dict[str, Any]], Mapping[Path, str]]
    closed: tuple[Path, ...] = ()
    late: list[str] = field(default_factory=list)
    output_kb: int = 1000
    instructors_read: bool = False


def run_gradescope(settings: PlatformSettings, root: Path = AUTOGRADER) -> PlatformJob:
    """The job of Gradescope. Raises CourseError for metadata that say too little."""
    about = gradescope.read_metadata(root / "submission_metadata.json")
    late = []
    if settings.percent_per_day and about.due:
        late = ["--due", about.due, "--handed-in", about.handed_in]
        late += ["--percent-per-day", f"{settings.percent_per_day:g}"]

    def outputs(data: dict[str, Any]) -> Mapping[Path, str]:
        columns = _leaderboard(root / "submission", settings) if settings.league else []
        found = gradescope.results(data, settings.visibility, columns)
        return {root / "results" / "results.json": _json(found)}

    return PlatformJob(root / "submission", about.student, outputs, (root,), late, instructors_read=True)


def _leaderboard(submission: Path, settings: PlatformSettings) -> list[dict[str, Any]]:
    from grader.marking.extras.platforms import leaderboard  # most bundles leave the league out

    how = leaderboard.LeagueSettings(settings.seconds, _secret())
    columns, note = leaderboard.columns_and_note(submission, _release(settings), how)
    if note:
        print(printable(f"Leaderboard: {note.rstrip('.')}."))
    return columns


def _secret() -> str:
    return secret.read_file(Path(SECRET)) if Path(SECRET).exists() else ""


def _release(settings: PlatformSettings) -> Path:
    return Path("release", settings.assignment).absolute()


def run_prairielearn(settings: PlatformSettings, root: Path = GRADE) -> PlatformJob:
    """The job of PrairieLearn."""
    try:
        student = prairielearn.student_of(json.loads((root / "data" / "data.json").read_text("utf-8")))
    except (OSError, ValueError, AttributeError):
        student = "variant"

    def outputs(data: dict[str, Any]) -> Mapping[Path, str]:
        return {root / "results" / "results.json": _json(prairielearn.results(data))}

    return PlatformJob(root / "student", student, outputs, (root,), output_kb=prairielearn.MAX_KB)


def run_classroom50(settings: PlatformSettings, submission: Path) -> PlatformJob:
    """The job of Classroom 50, in the student's checkout."""
    student = os.environ.get("USERNAME") or "student"

    def outputs(data: dict[str, Any]) -> Mapping[Path, str]:
        return {
            submission / "release-body.md": classroom50.release_body(data),
            submission / "result.json": _json(classroom50.result(data, os.environ)),
        }

    return PlatformJob(submission, student, outputs)


def execute(job: PlatformJob, settings: PlatformSettings) -> int:
    """Judge, and write the platform's files; returns the exit status of `mark-one`."""
    for folder in job.closed:
        os.chmod(folder, 0o700)
    with tempfile.TemporaryDirectory() as place:
        report = Path(place) / "report.json"
        words = [str(job.submission), "--assignment", settings.assignment, "--student", job.student]
        words += ["--release", str(_release(settings)), "--out", str(report)]
        words += ["--seconds", f"{settings.seconds:g}", "--output-kb", str(job.output_kb), *job.late]
        words += ["--secret", SECRET] if Path(SECRET).exists() else []
        words += [word for name in settings.exercises for word in ("--exercise", name)]
        if status := _mark_one(words):
            return status
        data = json.loads(report.read_text(encoding="utf-8"))
    for path, text in job.outputs(data).items():
        write_atomically(path, text)
    print(f"{data['points']:g} of {data['max_points']:g} points; isolation: {data['isolation']}")
    if job.instructors_read:
        print("\n".join(map(printable, instructor_text(data).splitlines())))
    return 0


def _mark_one(words: list[str]) -> int:
    try:
        return mark_one.main(words)
    except SystemExit as end:  # a wrong command line
        return int(end.code or 0)


def _json(data: dict[str, Any]) -> str:
    return json.dumps(data, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit status."""
    form = argparse.ArgumentParser("python -m grader.marking.extras.platforms.run")
    form.add_argument("platform", choices=("gradescope", "classroom50", "prairielearn"))
    form.add_argument("--submission", type=Path, help="the student's checkout, for classroom50")
    options = form.parse_args(arguments)
    os.environ |= {"PYTHONHASHSEED": "0", "OPENBLAS_NUM_THREADS": "1"}
    try:
        settings = PlatformSettings.read(Path.cwd())
        if options.platform == "classroom50":
            return execute(run_classroom50(settings, options.submission or Path.cwd()), settings)
        makers = {"gradescope": run_gradescope, "prairielearn": run_prairielearn}
        return execute(makers[options.platform](settings), settings)
    except (CourseError, OSError) as error:
        print(f"Not judged: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
