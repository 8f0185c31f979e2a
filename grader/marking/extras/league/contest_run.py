"""Runs a contest with the programs that a notebook hands to its last exercise, instead of judging them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from nbformat import NotebookNode

from grader.diagnosis.fault import Fault
from grader.exercise import Exercise
from grader.marking.extras.league.contest import Contest, Game, game_of
from grader.marking.judge.cell_outputs import CellOutputs
from grader.marking.judge.mark_submission import find_exercises, flag_suspicious_code, rebuild_notebooks
from grader.marking.judge.marking_state import MarkingState, cell_name, no_points
from grader.marking.judge.notebook_run import NotebookRun
from grader.marking.judge.plain_tests import PlainTest
from grader.marking.judge.student_session import StudentSession
from grader.programs import ProgramSource
from grader.score import Score
from grader.stderr_redirect import redirect_stderr


def run_contest(marking: MarkingState, contest: Contest) -> None:
    """Run the contest with the programs of the release's last test cell. Raises Unusable, UnknownTest."""
    rebuild_notebooks(marking)
    find_exercises(marking)
    flag_suspicious_code(marking)
    name, exercises = list(marking.exercises.items())[-1]
    marking.exercises = {name: dict(list(exercises.items())[-1:])}
    marking.cells[name] = []
    if name in marking.rebuilt.notebooks:
        ContestRun(marking, name, contest).run_all()
    else:
        marking.stops.append(marking.rebuilt.missing[name])


class ContestJudge:
    """Replaces an exercise: runs a contest with the programs that are handed to it.

    games: the results so far. problem: why the programs could not be run, or "".
    """

    def __init__(self, exercise: Exercise | PlainTest, contest: Contest) -> None:
        self.name = exercise.name
        self.games: list[Game] = []
        self.problem = ""
        self._contest = contest

    def judge(self, source: ProgramSource, secret: str = "") -> Score:
        """Play. The score has no points. Raises what the cast raises."""
        with redirect_stderr():
            found = source.refusal()
            if isinstance(found, Fault):
                self.problem = f"Expected {found.expected}, saw {found.saw}. {found.hint}"
            else:
                self.games.extend(self._play(source))
        return Score(self.name, [])

    def _play(self, source: ProgramSource) -> Iterator[Game]:
        for scenario, seed in self._contest.rounds():
            yield game_of(scenario.run(source, seed))


class ContestRun(NotebookRun):
    """The run of a notebook for a contest: tests of other exercises are skipped."""

    def __init__(self, marking: MarkingState, name: str, contest: Contest) -> None:
        super().__init__(marking, name)
        self._contest = contest

    def _test(
        self, session: StudentSession, cell: NotebookNode, number: int, shown: CellOutputs
    ) -> list[dict[str, Any]]:
        if cell_name(cell) not in self._exercises:
            return []
        judge = ContestJudge(self._exercises[cell_name(cell)], self._contest)
        problem = "Its test cell ended before the programs could be run."
        try:
            tested = session.test(cell.source, judge, shown, self._contest.seed)
            self._flag(cell, tested.flags)
            if tested.error is not None:
                self._flag(cell, [f"could not be played, because of a bug in the course: {tested.error}"])
            problem = "" if tested.score is not None else tested.problem or problem
        finally:  # the games before its process ended count
            result = no_points(cell, self._exercises[cell_name(cell)])
            games = [game.as_dict() for game in judge.games]
            self._results.append(replace(result, max=0.0, games=games))
            self._marking.timings["judged"] += len(games) * self._contest.seconds
        if problem or judge.problem:
            self._marking.stops.append(judge.problem or problem)
        return shown.list
