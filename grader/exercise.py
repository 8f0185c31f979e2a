"""An exercise is one object: the notebook's test cell, the tests' score tables and marking all use it."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, cast

from grader import seeds
from grader.checks.check import Check, Hints, new_check
from grader.checks.verdicts import Verdict, broken, faulty, judge, skipped, worst
from grader.diagnosis.fault import Fault
from grader.grading import current_grading
from grader.orders import USUAL, OrderDifference, judge_in_orders, order_of_run
from grader.programs import LocalPrograms, ProgramSource, serialize_preparation
from grader.scenario import Companions, Scenario
from grader.score import Score
from grader.stderr_redirect import redirect_stderr
from grader.typos import (
    MAX_CHAINED,
    auto_correct,
    only_wrong_types,
    partial_credit,
    typos_of,
    with_right_types,
)
from grader.variants import Varied
from grader.workspace.interfaces import Interfaces
from grader.workspace.near_misses import Correction
from grader.workspace.package import Package
from grader.workspace.package_xml import PYTHON
from sim.evidence import Recording, Seconds
from sim.network import Network


@dataclass(eq=False)
class Exercise(Varied):
    '''A task with its checks and the runs they judge. The simplest has one run:

        counter = Exercise("counter", "A counting node", seconds=5)
        @counter.check(3)
        def counts(recording):
            \"""The node counts from 1 on.\"""

        counter.grade(CountingNode)

    name: unique in the course. title: what the student reads.
    world, seconds, companions, until, network, waits: the one scenario, run once for each of `seeds`.
    scenarios: in place of these, several scenarios; a check holds only if it holds in all that judge it.
    may_end: its programs come to their end when they are done; else the time after that is not earned.
    package: the name of the package that is built and run. `grade` then takes the folder of a workspace,
        `prepare` of each scenario says which of its programs runs, and checks are given a `PackageRun`.
    build_type: that of the package. uses: a package of interfaces in the same workspace that it imports.
    names_count: names are a part of the task, so those alone may earn more than 30 % of the points.
    extra_allowed: messages beyond those that the task wants cost nothing.
    near_misses: corrections of a package's files, which earns half of the points then. variants: see Varied.

    Raises ValueError for an exercise that can't work.
    '''

    name: str
    title: str
    checks: list[Check] = field(default_factory=list)
    world: Any = None
    seconds: Seconds = 10.0
    companions: Companions = ()
    until: Callable[[Recording], bool] | None = None
    seeds: Sequence[int] = (0,)
    scenarios: Sequence[Scenario] = ()
    may_end: bool = False
    network: Network | None = None
    waits: bool = True
    package: str = ""
    build_type: str = PYTHON
    uses: Interfaces | None = None
    names_count: bool = False
    extra_allowed: bool = False
    near_misses: Sequence[Correction] = ()

    def __post_init__(self) -> None:
        if not self.seeds:
            raise ValueError(f"exercise {self.name}: give at least one seed")
        given, self.checks = self.checks, []
        for item in given:
            self._add(item)

    def check(
        self,
        points: float,
        *,
        after: Check | tuple[Check, ...] = (),
        only: str | tuple[str, ...] = (),
        guess: str | Hints = "",
        lasts: bool = False,
        hints: Hints | None = None,
    ) -> Callable[[Callable[..., Any]], Check]:
        """Make the next check of this exercise of a function whose docstring the student reads.

        points: its weight. after: what must have earned something, in the scenarios where that holds; the
        function is handed what these checks have returned, if it takes more than a recording. only: the
        names of the scenarios in which it holds.
        guess: what is most likely missing, where a miss has no hint and no diagnosis fits; or a table.
        hints: sentences with their causes, for a miss without a hint of its own; see `Hints`.
        lasts: it speaks of all the time, though it builds on no other: time not run is not earned.
        Raises ValueError for a check that can't work, as `new_check` does.
        """
        return lambda function: self._add(new_check(function, points, after, only, guess, lasts, hints))

    def _add(self, item: Check) -> Check:
        known, where = {before.name for before in self.checks}, f"exercise {self.name}: {item.name}"
        if item.name in known:
            raise ValueError(f"exercise {self.name}: two checks are called {item.name}")
        for before in item.after:
            if before.name not in known:
                raise ValueError(f"{where} comes after {before.name}, so list {before.name} first")
            if item.takes_measured and before.only and not (item.only and set(item.only) <= set(before.only)):
                places = ", ".join(before.only)
                raise ValueError(f"{where} receives what {before.name} measures only in {places}")
        strange = set(item.only) - {scenario.name for scenario in self.scenarios}
        if strange:
            raise ValueError(f"{where} applies to {strange.pop()!r}, which is not one of its scenarios")
        self.checks.append(item)
        return item

    @property
    def points(self) -> float:
        """Return what can be reached."""
        return sum(item.points for item in self.checks)

    @property
    def varies(self) -> bool:
        """Return whether the right answer depends on what a run shows, and not on the task's text alone.

        Something varies if the course sends messages, draws worlds or the like, or builds a package.
        """
        runs = [scenario for scenario, _ in self.runs()]
        drawn = any(callable(one.world) or one.companions or one.prepare_for for one in runs)
        return drawn or bool(self.package) or len({seed for _, seed in self.runs()}) > 1

    def runs(self, secret: str = "") -> list[tuple[Scenario, int]]:
        """Scenarios with their seeds: public ones, or private ones from a secret."""
        common = self.world, self.seconds, 0, self.companions, self.until
        one = Scenario(*common, network=self.network, waits=self.waits)
        public = [(scenario, scenario.seed) for scenario in self.scenarios] or [(one, s) for s in self.seeds]
        if not secret:
            return public
        return [(s, seeds.private_seed(secret, self.name, i, s.fair)) for i, (s, _) in enumerate(public)]

    def grade(self, *nodes: Any) -> Score:
        """Run a student's nodes, judge the recordings, give the score. No mistake of the student's raises.

        nodes: what sim.run takes: Node classes, callables that return a node, main() functions.
        """
        grading = current_grading()
        if grading.hand_over is not None:
            return cast("Score", grading.hand_over(self.name, nodes))
        return self.judge(LocalPrograms(nodes), grading.secret)

    def in_order(self, *nodes: Any, order: int | str) -> tuple[Recording, bool]:
        """Run the nodes with all runs in this order, for `sim.explore`.

        Returns the run to look at, and whether the nodes earn full points.
        """
        score = self.judge(LocalPrograms(nodes), order="" if order == 0 else str(order))
        missed = (verdict.run for verdict in score.verdicts if verdict.status != "passed")
        recordings = score.recordings or (Recording(),)
        return recordings[next(missed, 0)], float(score) == score.max

    def judge(self, source: ProgramSource, secret: str = "", order: str | None = None) -> Score:
        """The same for programs wherever they live, on private worlds where there is a secret.

        order: of all runs; None for those of `grader.orders`. Raises ValueError without points.
        """
        if not self.points > 0:
            raise ValueError(f"exercise {self.name}: its checks have no points")
        with redirect_stderr(), self.in_use():
            package = self.package, self.build_type, self.uses
            found = source.package(*package) if self.package else source.refusal()
            score = self._score(source, secret, found, order)
            if self.near_misses and score < score.max:
                found = source.package(*package, self.near_misses)
                if isinstance(found, Package):
                    without = self._score(source, secret, found, order)
                    score = score.with_verdicts(partial_credit(score.verdicts, without.verdicts))
            return score

    def _score(self, source: ProgramSource, secret: str, found: Any, order: str | None) -> Score:
        """Return what the programs earn, or those of the package that was found."""
        if isinstance(found, Fault):
            reason = "Not graded: there is nothing to run."
            verdicts = [faulty(found), *(skipped(item, reason) for item in self.checks)]
            return Score(self.name, verdicts, title=self.title)
        try:
            return self._run_and_judge(source, secret, found, order)
        finally:
            source.leave()

    def _run_and_judge(
        self, source: ProgramSource, secret: str, package: Package | None, order: str | None
    ) -> Score:
        recordings: list[Recording] = []
        judged: list[list[Verdict]] = []
        differences: list[OrderDifference] = []
        for index, (scenario, seed) in enumerate(self.runs(secret)):
            run = functools.partial(Scenario.run, source=source, seed=seed, package=package)
            in_order = functools.partial(self._judged, scenario, run)
            try:
                if order is None:
                    chosen = order_of_run(index, seed, public=not secret) if scenario.any_order else USUAL
                    (recording, verdicts), difference = judge_in_orders(chosen, in_order, judged, not secret)
                    differences += filter(None, [difference])
                else:
                    recording, verdicts = in_order(order)
            except Exception as error:
                recording = Recording(seed=seed)
                verdicts = [broken(item, error) for item in self.checks if item.holds_in(scenario.name)]
            recordings.append(recording)
            judged.append(verdicts)
        verdicts = worst(self.checks, judged)
        return Score(self.name, verdicts, recordings, title=self.title, differences=differences)

    def _judged(
        self, scenario: Scenario, run: Callable[..., Recording], order: str
    ) -> tuple[Recording, list[Verdict]]:
        """One run and its verdicts; where it shows a typo, with half of what the corrected program earns."""
        run = functools.partial(run, order=order)
        recording = run(scenario)
        verdicts = judge(self.checks, recording, scenario.name, may_end=self.may_end)
        return recording, partial_credit(verdicts, self._without_typos(scenario, run, recording, verdicts))

    def _without_typos(
        self, scenario: Scenario, run: Callable[..., Recording], recording: Recording, verdicts: list[Verdict]
    ) -> list[Verdict]:
        """The verdicts on the program with its typos corrected; the same verdicts if it has none.

        One typo may hide another, as a misspelt name hides that the topic has another type.
        """
        typos: list[str] = []
        for _ in range(MAX_CHAINED):
            new = [typo for typo in typos_of(recording, verdicts) if typo not in typos]
            if not new:
                break
            typos += new
            if not only_wrong_types(new):
                prepare = functools.partial(auto_correct, serialize_preparation(scenario.prepare), *typos)
                recording = run(replace(scenario, prepare=prepare))
            corrected = with_right_types(recording, typos)
            verdicts = judge(self.checks, corrected, scenario.name, may_end=self.may_end)
        return verdicts
