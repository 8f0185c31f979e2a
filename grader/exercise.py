"""An exercise is one object: the notebook's test cell, the tests' score tables and marking all use it."""

from __future__ import annotations

import hashlib
import hmac
import inspect
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from grader.admission import refusal
from grader.checks.check import Check
from grader.checks.judge import Verdict, broken, faulty, judge, skipped, worst
from grader.quiet import quiet_stderr
from grader.score import Score
from sim.recording import CallbackError, Recording, Seconds
from sim.ros.remote import Remote

SECRET = "COURSE_SECRET"  # environment variable that only an instructor's marking sets

offer: Callable[[Exercise, tuple[Any, ...]], Any] | None = None
"""Set in a process whose nodes another one judges: what `Exercise.grade` does there, and gives."""

Companions = Sequence[Any] | Callable[[int], Sequence[Any]]


class CompanionError(Exception):
    """A node of ours, not the student's, raised: our mistake."""


@dataclass(frozen=True)
class Scenario:
    """One run of the student's nodes.

    world: the name of a world, or None for a run without a robot; or a function of the seed that gives a
        World, such as `lambda seed: World.generate("maze", seed=seed)`.
    companions: nodes of ours that run alongside, as for sim.run; or a function of the seed that gives them.
    until: a function of the growing recording that ends the run early, as in sim.run.
    """

    world: Any = None
    seconds: Seconds = 10.0
    seed: int = 0
    companions: Companions = ()
    until: Callable[[Recording], bool] | None = None

    def run(self, nodes: Sequence[Any], seed: int) -> Recording:
        """Run the student's nodes. Ours come first, as a robot's drivers are up before one's own node is.

        Raises CompanionError when one of ours raised.
        """
        from sim import run

        companions = self.companions(seed) if callable(self.companions) else self.companions
        recording = run(
            *companions,
            *nodes,
            world=self._world(seed),
            seconds=self.seconds,
            seed=seed,
            until=self.until,
            quiet=True,
        )
        told = [error for node in nodes if isinstance(node, Remote) for error in node.errors]
        for error in recording.errors:
            # What another process tells is never taken for a mistake of ours: that would give points.
            if not any(error is claim for claim in told) and _is_companion(error, companions):
                raise CompanionError(f"{error.node}: {error.type}{error.says}\n{error.traceback}")
        return recording

    def _world(self, seed: int) -> Any:
        if not callable(self.world):
            return self.world
        world = self.world(seed)
        # Scores and replays show the name, and in marking the seed is a private one.
        return replace(world, name=world.name.removesuffix(f"_{seed}"))


@dataclass(frozen=True)
class Exercise:
    """A task with its checks and the runs they judge. The simplest has one run:

        counter = Exercise("counter", "A counting node", checks=[counts, logs_once_a_second], seconds=5)
        counter.grade(CountingNode)

    name: unique in the course. title: what the student reads.
    world, seconds, companions, until: the one scenario, run once for each of `seeds`.
    scenarios: in place of these, several scenarios; a check holds only if it holds in all of them.

    Raises ValueError for an exercise that can't work.
    """

    name: str
    title: str
    checks: Sequence[Check]
    world: Any = None
    seconds: Seconds = 10.0
    companions: Companions = ()
    until: Callable[[Recording], bool] | None = None
    seeds: Sequence[int] = (0,)
    scenarios: Sequence[Scenario] = ()

    def __post_init__(self) -> None:
        names: set[str] = set()
        for item in self.checks:
            if item.name in names:
                raise ValueError(f"exercise {self.name}: two checks are called {item.name}")
            late = [before.name for before in item.after if before.name not in names]
            if late:
                raise ValueError(
                    f"exercise {self.name}: {item.name} comes after {late[0]}, so list {late[0]} first"
                )
            names.add(item.name)
        if not self.points > 0:
            raise ValueError(f"exercise {self.name}: its checks have no points")
        if not self.seeds:
            raise ValueError(f"exercise {self.name}: give at least one seed")

    @property
    def points(self) -> float:
        """What can be reached."""
        return sum(item.points for item in self.checks)

    @property
    def runs(self) -> list[tuple[Scenario, int]]:
        """Scenarios with their seeds: public ones, or private ones where the instructor's secret is set."""
        one = Scenario(self.world, self.seconds, 0, self.companions, self.until)
        public = [(scenario, scenario.seed) for scenario in self.scenarios] or [(one, s) for s in self.seeds]
        secret = os.environ.get(SECRET, "")
        if not secret:
            return public
        return [(run[0], private_seed(secret, self.name, index)) for index, run in enumerate(public)]

    def grade(self, *nodes: Any) -> Score:
        """Run the student's nodes, judge the recordings, give the score. No mistake of the student's raises.

        nodes: what sim.run takes: Node classes, callables that return a node, main() functions. Or one
            Remote, for nodes that live in another process; then RemoteLost is raised when that process is
            gone, silent or sends what can't be.
        """
        if offer is not None:
            return offer(self, nodes)
        for node in nodes:
            if isinstance(node, Remote):
                node.secret, node.preparation = os.environ.get(SECRET, "").encode(), ""
        with quiet_stderr():
            refused = refusal(nodes)
            if refused:
                reason = "Not judged: there is nothing to run."
                verdicts = [faulty(refused), *(skipped(item, reason) for item in self.checks)]
                return Score(self.name, verdicts, title=self.title)
            return self._run_and_judge(nodes)

    def _run_and_judge(self, nodes: Sequence[Any]) -> Score:
        recordings: list[Recording] = []
        judged: list[list[Verdict]] = []
        for scenario, seed in self.runs:
            try:
                recording = scenario.run(nodes, seed)
            except Exception as error:
                recordings.append(Recording(seed=seed))
                judged.append([broken(item, error) for item in self.checks])
            else:
                recordings.append(recording)
                judged.append(judge(self.checks, recording))
        return Score(self.name, worst(judged), recordings, title=self.title)


def private_seed(secret: str, exercise: str, index: int) -> int:
    """The seed of an exercise's run: the first 4 bytes of HMAC-SHA256(secret, "exercise index")."""
    digest = hmac.new(secret.encode(), f"{exercise} {index}".encode(), hashlib.sha256).digest()
    return int.from_bytes(digest[:4], "big")


def _is_companion(error: CallbackError, companions: Sequence[Any]) -> bool:
    """By name and file: a student's class may be called as one of ours."""
    targets = [getattr(companion, "target", companion) for companion in companions]
    named = [t for t in targets if error.callback.split(".")[0] == getattr(t, "__name__", "")]
    return any((inspect.getsourcefile(target) or "") in error.traceback for target in named)
