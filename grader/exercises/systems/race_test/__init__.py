"""A test that finds races: it fails on programs that have one, and passes on those that are right."""

import re
from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

from grader.checks import Missed, publishes
from grader.companions.race_test_runner import FAILED, MOST_RUNS, MOST_SECONDS, PASSED, VERDICTS, try_test
from grader.exercise import Exercise, Scenario
from grader.exercises.systems.race_test.depots import candidates, shown
from grader.exercises.systems.race_test.racy_depots import ANSWERS, NEGATIVE
from grader.programs import Prepare
from sim.evidence import Recording

LOCKED, UNLOCKED = "Locked", "Depot"  # the classes in the notebook
FEW = 10  # orders
SECONDS = 60.0  # of a run in which only the verdicts are published: it costs as much as their runs do
TOO_STRICT = ("Require no more than the contract does. Answers may come in any order and up to 0.1 s late, "
              "and /stock may repeat a number.")
ERROR = "That is an error of the test itself: call test_depot(locked) in a cell, and read its traceback."
RETURNS = "A test fails with an exception, and what it returns doesn't count: use assert."


class ProgramVerdict(NamedTuple):
    """The outcome of the test on a program. runs: how often it was run. sleeps: how often the test slept."""

    passed: bool
    runs: int
    sleeps: int
    reason: str

    @property
    def hint(self) -> str:
        """Return what to do if it failed on a program that is right."""
        return ERROR if re.match(r"\w*(Error|Exception): ", self.reason) else TOO_STRICT


def preparation(seed: int) -> Prepare:
    """Return the `prepare` of a seed: it tries a test on the notebook's programs, and on the seed's."""
    known = [(LOCKED, shown(right=True), PASSED), (UNLOCKED, shown(right=False), FAILED)]
    return partial(try_test, [*known, *((str(each.number), each.source) for each in candidates(seed))])


race_test = Exercise("race_test", "A test that finds races", scenarios=[
    Scenario(seconds=SECONDS, seed=1, waits=False, any_order=False, prepare_for=preparation),
])


@race_test.check(2)
def judges_what_you_have(run: Recording) -> None:
    """The test runs both programs of the notebook, passes on the one with the lock and fails on the other."""
    found = _verdicts(run)
    locked = _verdict(found, LOCKED)
    if not locked.runs:
        hint = "Call run(program, Users, ...) in your test: what it was given, and nothing of your own."
        raise Missed(f"runs of {LOCKED}", locked.reason or "none", hint)
    if not locked.passed:
        raise Missed(f"the test passing on {LOCKED}: it is right", locked.reason, locked.hint)
    unlocked = _verdict(found, UNLOCKED)
    if unlocked.passed:
        hint = RETURNS if unlocked.reason else _what_is_missing(found)
        raise Missed(f"the test failing on {UNLOCKED}", _passed(unlocked), hint)


@race_test.check(2, after=judges_what_you_have)
def passes_what_is_right(run: Recording) -> None:
    """The test passes on all five correct programs, whatever their design and their names."""
    found = _verdicts(run)
    for each in candidates(run.seed):
        verdict = _verdict(found, str(each.number))
        if each.right and not (verdict.passed and verdict.runs):
            saw = f"in its run number {verdict.runs}: {verdict.reason}" if verdict.runs else "no run of it"
            raise Missed(f"the test passing on program {each.number}: it is right", saw, verdict.hint)


@race_test.check(9, after=passes_what_is_right)
def catches_races(run: Recording) -> None:
    """The test fails on all eight programs that have a race."""
    found = _verdicts(run)
    racy = {each.design: _verdict(found, str(each.number)) for each in candidates(run.seed) if not each.right}
    missed = [design for design, verdict in racy.items() if verdict.passed or not verdict.runs]
    if missed:
        caught = len(racy) - len(missed)
        saw = f"{caught}; on another one it {_passed(racy[missed[0]])}"
        hint = _what_is_missing(found, missed)
        raise Missed(f"{len(racy)} of {len(racy)} caught", saw, hint, credit=caught / len(racy))


@race_test.check(1, after=judges_what_you_have)
def takes_no_time(run: Recording) -> None:
    """The test never sleeps, and runs no program more than 60 times."""
    found = _verdicts(run)
    sleeps = sum(verdict.sleeps for verdict in found.values())
    if sleeps:
        hint = "run(...) returns when the run is over: there is nothing to wait for."
        raise Missed("no call of sleep in the test", f"{sleeps} calls", hint)
    most = max(verdict.runs for verdict in found.values())
    if most > MOST_RUNS:
        hint = "Send more in one run, and try fewer orders: most of a run's time is its start."
        raise Missed(f"at most {MOST_RUNS} runs of a program", "more", hint)


def _what_is_missing(found: dict[str, ProgramVerdict], designs: Sequence[str] = ()) -> str:
    """Return the hint for a test that passes on programs of these racy designs."""
    if found[LOCKED].runs < FEW:
        return ("A race shows in some orders only. Run the program in 20 or more: run(..., order=number), "
                "with numbers from 0 on.")
    if set(ANSWERS) <= set(designs):
        return "Some of these programs answer a robot twice, or not at all: does your test count the answers?"
    if set(NEGATIVE) <= set(designs):
        return ("Some of these programs hand out boxes that they don't have. Does your test look for "
                "negative numbers, and do the boxes run out in your bursts?")
    return ("Does your test look at each pause, and not only at the end? And do several messages on both "
            "topics meet in a burst?")


def _passed(verdict: ProgramVerdict) -> str:
    runs = f"passed in {verdict.runs} runs" if verdict.runs != 1 else "passed in its only run"
    return f"{runs} and {verdict.reason}" if verdict.reason else runs


def _verdict(found: dict[str, ProgramVerdict], name: str) -> ProgramVerdict:
    """The verdict on the program of this name. Raises Missed if there is none."""
    if name not in found:
        saw = f"none: the test took more than {MOST_SECONDS:g} s of computing on those before"
        raise Missed(f"the outcome of the test on program {name}", saw)
    return found[name]


def _verdicts(run: Recording) -> dict[str, ProgramVerdict]:
    """The verdicts by the programs' names."""
    found: dict[str, ProgramVerdict] = {}
    for row in publishes(run, VERDICTS, "std_msgs/msg/String"):
        name, outcome, runs, sleeps, reason = [*row.message.data.split(" ", 4), "", "", "", "", ""][:5]
        if runs.isdigit() and sleeps.isdigit():
            found.setdefault(name, ProgramVerdict(outcome == PASSED, int(runs), int(sleeps), reason))
    return found
