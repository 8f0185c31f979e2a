"""What a judge does with an entry of a league in place of marking it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from grader.marking.extras.league.contest import Contest


@dataclass(frozen=True)
class ContestProcedure:
    """Runs the contest with the programs of a submission; a `Procedure` of a MarkingTask."""

    contest: Contest

    def run(self, marking: Any) -> None:
        """Work like Procedure."""
        from grader.marking.extras.league.contest_run import run_contest  # in the judge's process only

        run_contest(marking, self.contest)
