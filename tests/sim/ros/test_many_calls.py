"""A loop that calls a service again and again makes progress: it is no livelock, and answers take time."""

import pytest

from sim import run
from tests.students.engine import many_calls
from tests.students.engine.services import Adder

CALLS = {many_calls.spins_once_for_each: 1000, many_calls.spins_until_each_is_there: 1300}


@pytest.mark.parametrize("program", CALLS, ids=lambda it: it.__name__)
def test_many_calls_in_a_row_come_to_their_end_and_each_after_a_thousand_takes_a_millisecond(program):
    recording, calls = run(Adder, program, seconds=5, quiet=True), CALLS[program]
    assert recording.ended.reason == "time"
    assert "".join(text for _, text in recording.prints) == f"{sum(range(1, calls + 1))}\n"
    stamps = [call.requested for call in recording.calls]
    assert len(stamps) == calls
    assert stamps[999] == stamps[0]
    assert stamps[-1] - stamps[0] == pytest.approx((calls - 1000) / 1000, abs=0.05)


def test_a_loop_of_calls_without_end_is_as_fast_as_one_call_in_a_millisecond():
    recording = run(Adder, many_calls.never_stops, seconds=0.5, quiet=True)
    assert recording.ended.reason == "time"
    assert 1100 < len(recording.calls) <= 1501
