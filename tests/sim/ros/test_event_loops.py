"""asyncio in student code: its clock is the run's, its waiting takes simulated time, and others go on."""

import asyncio

import pytest

from sim import run
from tests.sim.ros.evidence import logged, times, why
from tests.students.engine import actions, event_loops

pytestmark = pytest.mark.pythons


@pytest.mark.parametrize("program, expected", [
    (event_loops.RunsInTimer, [(0.7, "tick"), (1.2, "tick"), (1.7, "tick")]),
    (event_loops.gather_beside_a_spin_thread, [
        (0.3, "a 0"), (0.4, "b 0"), (0.5, "tick"), (0.6, "a 1"), (0.8, "b 1"), (1.0, "tick"),
        (1.0, "['a', 'b', None]"), (1.5, "tick"), (2.0, "tick"),
    ]),
    (event_loops.spins_in_a_coroutine, [(stamp, "tick") for stamp in (0.5, 1.0, 1.5, 2.0)]),
    (event_loops.wakes_another_loop, [(0.75, "True"), (1.25, "True"), (1.75, "True")]),
    (event_loops.polls_without_waiting, [(stamp, "tick") for stamp in (0.5, 1.0, 1.5, 2.0)]),
], ids=lambda value: getattr(value, "__name__", ""))  # fmt: skip
def test_an_event_loop_waits_in_simulated_time(program, expected):
    recording = run(program, seconds=2, quiet=True)
    assert logged(recording) == expected
    assert (recording.errors, recording.stderr) == ([], "")
    assert why(recording) == ("time", 2.0, "All 2 s were run.")


def test_a_coroutine_can_await_an_actions_futures():
    recording = run(actions.parallel_server, event_loops.awaits_an_action, seconds=5, quiet=True)
    assert recording.errors == []
    assert logged(recording) == [(3.104, "result [0, 1, 1, 2, 3]")]


def test_two_programs_have_their_own_event_loops():
    recording = run(event_loops.own_loops, event_loops.own_loops, seconds=2, quiet=True)
    assert times(recording, "True") == [0.5, 0.5]
    assert why(recording) == ("finished", 2.0, "Every program had ended by t = 1 s.")


def test_waiting_for_ever_in_an_event_loop_is_reported():
    reason, stamp, detail = why(run(event_loops.waits_for_nothing, seconds=2, quiet=True))
    assert (reason, stamp) == ("blocked", 2.0)
    words = "<lambda> of node /waiting has waited since t = 0.5 s and never returned, at line "
    assert detail.startswith(words)
    assert detail.endswith(
        ": node.create_timer(0.5, lambda: asyncio.run(asyncio.Event().wait())). "
        "It waits for an event in asyncio's loop."
    )


def test_the_users_own_event_loop_is_as_it_was():
    async def work():
        loop, policy = asyncio.get_running_loop(), asyncio.get_event_loop_policy()
        run(event_loops.RunsInTimer, seconds=1, quiet=True)
        await asyncio.sleep(0.01)
        return asyncio.get_running_loop() is loop and asyncio.get_event_loop_policy() is policy

    assert asyncio.run(work())
