"""Gradescope's leaderboard: what a robot does in the league's warehouses, the same ones for all students."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from grader.marking.errors import CourseError, SandboxFailed, SandboxMissing, UnknownTest
from grader.marking.extras.league.contest import Contest
from grader.marking.extras.league.contest_procedure import ContestProcedure
from grader.marking.extras.league.standings import LeagueRow, standings
from grader.marking.extras.one_submission.judge_one import read_release, read_submission
from grader.marking.judge.testcells import exercise_names
from grader.marking.pool import Pool
from grader.marking.sandbox import ResourceLimits
from grader.marking.submission.assignment_release import Release
from grader.marking.task import MarkingTask, TimeLimits
from grader.seeds import private_seed

CAPSTONE = "deliver"  # the exercise that receives the programs of a whole robot
NOT_STORED = "00"  # in place of the key by which `mark` finds a result again
USUAL = ResourceLimits()


@dataclass(frozen=True)
class LeagueSettings:
    """Settings of a robot's work there. seconds: for all warehouses. secret: the warehouses depend on it."""

    seconds: float
    secret: str = field(default="", repr=False)

    @property
    def contest(self) -> Contest:
        """The contest of this class, in public warehouses without a secret."""
        return Contest(str(private_seed(self.secret, "leaderboard", 0)) if self.secret else "")


def require_capstone(release: Release) -> None:
    """Raise CourseError unless the last exercise of a release receives the programs of a whole robot."""
    try:
        last = [name for notebook in release.notebooks.values() for name in exercise_names(notebook).values()]
    except UnknownTest as error:
        raise CourseError(str(error).rstrip(".")) from None
    if not last or last[-1].rpartition(".")[2] != CAPSTONE:
        raise CourseError(
            f"--league needs an assignment that ends with the exercise `{CAPSTONE}`, such as 13b_delivery; "
            f"leave it out for {release.assignment}"
        )


def play(submission: Path, release_folder: Path, how: LeagueSettings) -> LeagueRow:
    """The robot's row in the league's table. Raises CourseError, SandboxMissing and SandboxFailed."""
    release = read_release(release_folder)
    submitted = read_submission(submission, release)
    task = MarkingTask("robot", release, submitted, NOT_STORED, ContestProcedure(how.contest))
    whole = int(how.contest.worlds * how.contest.seconds)
    limits = replace(USUAL, cpu_s=USUAL.cpu_s + whole, wall_s=USUAL.wall_s + whole)
    times = TimeLimits(test=how.seconds, notebook=how.seconds)
    with Pool(1, time_limits=times, limits=limits) as pool:
        (result,) = pool.mark([task])
    if result.verdict == "broken":
        raise CourseError(result.reason.rstrip("."))
    (row,) = standings([result], how.contest, {"robot": "robot"})
    return row


def columns(row: LeagueRow) -> list[dict[str, Any]]:
    """The columns of a row of the league's table, in the order in which robots are ranked."""
    if not row.games:
        return []
    pace = [{"name": "Seconds per order", "value": round(row.pace, 1), "order": "asc"}] if row.pace else []
    return [
        {"name": "Orders delivered", "value": row.delivered},
        {"name": "People touched", "value": row.people, "order": "asc"},
        {"name": "Other contacts", "value": row.contacts, "order": "asc"},
        *pace,
    ]


def columns_and_note(
    submission: Path, release_folder: Path, how: LeagueSettings
) -> tuple[list[dict[str, Any]], str]:
    """The columns, and what the instructor should know: why there are none, or what went wrong; or "".

    Raises nothing, because the mark counts without a leaderboard.
    """
    try:
        row = play(submission, release_folder, how)
    except (CourseError, SandboxMissing, SandboxFailed) as error:
        return [], f"no entry: {error}"
    if not row.games:
        return [], "no entry: the robot's programs could not be run in any warehouse"
    return columns(row), row.note
