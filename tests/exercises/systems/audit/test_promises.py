"""The given systems: two keep their promises in every order, four don't, and the repaired ones do."""

import functools

import pytest

from grader.exercises.systems.audit.deliveries import BEGIN, LASTS, PLAYS, TICK, Trials
from grader.exercises.systems.audit.promises import broken_promise
from grader.exercises.systems.audit.six_systems import SYSTEMS
from sim import run
from tests.exercises.systems.audit.students import (
    RepairedCollector,
    RepairedDock,
    RepairedLabeler,
    RepairedRider,
)

SECONDS = (BEGIN + LASTS * PLAYS) * TICK
RIGHT = "job_starter", "speed_gate"
REPAIRED = {"labeler": RepairedLabeler, "dock": RepairedDock, "collector": RepairedCollector,
            "rider": RepairedRider}  # fmt: skip
SEEDS = [*range(2), *(pytest.param(seed, marks=pytest.mark.soak) for seed in range(2, 40))]


@functools.cache
def broken_plays(seed, *nodes):
    """The numbers of the plays in which each system breaks its promise."""
    recording = run(*nodes, companions=[functools.partial(Trials, seed)], seconds=SECONDS, seed=seed, quiet=True,
                    order=seed)  # fmt: skip
    return {name: [number for number in range(PLAYS) if broken_promise(recording, name, number)]
            for name in SYSTEMS}  # fmt: skip


@pytest.mark.parametrize("seed", SEEDS)
def test_the_given_systems_are_right_without_delays_and_four_are_not_with_some(seed):
    broken = broken_plays(seed, *(parts.node for parts in SYSTEMS.values()))
    assert [name for name in SYSTEMS if not broken[name]] == [*RIGHT]
    assert [name for name in SYSTEMS if 0 in broken[name]] == []
    assert [name for name in REPAIRED if 1 not in broken[name] or 3 not in broken[name]] == []


@pytest.mark.parametrize("seed", SEEDS)
def test_repaired_systems_are_right_in_all_orders(seed):
    broken = broken_plays(seed, *REPAIRED.values())
    assert [name for name in REPAIRED if broken[name]] == []
