"""All that waits, waits in simulated time; every clock shows it."""

import pytest

from sim import run
from tests.sim.ros.evidence import logged, times
from tests.students.engine import timing

pytestmark = pytest.mark.pythons


def stamps(program, seconds=4):
    recording = run(program, seconds=seconds, quiet=True)
    assert (recording.errors, recording.stderr) == ([], "")
    return logged(recording)


def test_timers_on_every_kind_of_clock_tick_together():
    names = ["node", "steady", "system", "ros"]
    assert stamps(timing.Timers, 2) == [(stamp, name) for stamp in (1.0, 2.0) for name in names]


def test_timers_can_be_canceled_reset_and_made_faster():
    assert [stamp for stamp, _ in stamps(timing.ResetCancelChange)] == [0.5, 1.0, 2.5, 3.0, 3.5, 3.75, 4.0]
    assert [stamp for stamp, _ in stamps(timing.Autostart, 2.5)] == [1.5, 2.0, 2.5]


def test_a_callback_that_sleeps_holds_up_its_own_node():
    recording = run(timing.SlowCallback, seconds=4, quiet=True)
    assert times(recording, "slow") == [3.0]
    assert times(recording, "fast") == [
        0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0, 3.0, 3.25, 3.5, 3.75, 4.0,
    ]  # fmt: skip
    held = [run for run in recording.callbacks if run.duration]
    assert [tuple(run) for run in held] == [(2.0, 1.0, "/slow", "SlowCallback.slow", "timer")]


def test_ticks_stay_exact_for_ten_minutes():
    recording = run(timing.Timers, seconds=600, quiet=True)
    assert times(recording, "steady") == [float(second) for second in range(1, 601)]


@pytest.mark.parametrize("program, expected", [
    (timing.sleep_loop, [(0.0, "0"), (0.7, "1"), (1.4, "2")]),
    (timing.early_bound_sleep, [(1.5, "1.5")]),
    (timing.rate_in_a_thread, [(0.25, "rate"), (0.5, "rate"), (0.75, "rate"), (1.0, "rate")]),
    (timing.rate_in_a_parallel_callback, [(1.0, "rate"), (1.5, "rate"), (2.0, "rate")]),
    (timing.clock_sleeps, [(1.5, "for"), (4.0, "until"), (4.5, "system")]),
    (timing.selects, [
        (0.5, "0 ready"), (0.75, "0 ready"), (0.75, "0 ready"), (1.5, "1 ready"), (1.5, "1 ready"),
    ]),
    (timing.goes_by_a_schedule, [(0.5, "after 0.5"), (1.5, "after 1.5")]),
    (timing.busy_wait, [(1.0, "over")]),
    (timing.busy_wait_on_the_node_clock, [(1.0, "over")]),
], ids=lambda value: getattr(value, "__name__", ""))  # fmt: skip
def test_waiting_takes_simulated_time(program, expected):
    assert stamps(program, 5) == expected


def test_another_process_takes_no_simulated_time():
    assert stamps(timing.waits_for_children) == [
        (0.0, "0"), (0.0, "too slow"), (0.0, "alive: True"), (0.0, "alive: False"),
    ]  # fmt: skip


def test_all_clocks_show_simulated_time():
    names = ["time", "time_ns", "gettime", "gettime_ns"]
    names += ["monotonic", "perf_counter", "computing", "process_time", "node", "steady", "system"]
    assert stamps(timing.all_clocks) == [(2.5, f"{name} 2.5") for name in names]


def test_a_second_before_the_start_there_was_time_too():
    """All clocks that show what time it is agree, from the first moment on."""
    expected = []
    for stamp, nanoseconds, seconds, steady in [
        (0.0, 1_735_689_599_000_000_000, 1735689599.0, 10_799_000_000_000),
        (0.25, 1_735_689_599_250_000_000, 1735689599.25, 10_799_250_000_000),
    ]:
        expected += [(stamp, f"{clock} {nanoseconds}") for clock in ("node", "ros", "system")]
        expected.append((stamp, f"steady {steady}"))
        expected.append((stamp, f"time {nanoseconds} {seconds}"))
    assert stamps(timing.looks_back, 0.25) == expected


def test_a_message_comes_with_the_time_of_the_same_clock():
    assert stamps(timing.knows_when_a_message_came, 1) == [
        (0.5, "1735689600 500000000 1735689600500000000 1735689600500000000"),
        (1.0, "1735689601 0 1735689601000000000 1735689601000000000"),
    ]


def test_the_calendar_begins_with_2025():
    assert stamps(timing.calendar, 4000) == [(3661.0, "2025-01-01 01:01:01")]


@pytest.mark.xfail(strict=True, reason="datetime is a type in C, whose now() can't be replaced")
def test_datetime_shows_simulated_time():
    assert stamps(timing.date_and_time, 4000) == [(3661.0, "2025-01-01 01:01:01")]


def test_timeouts_add_up():
    """One may end a nanosecond late, because rclpy adds it to the time in floating point."""
    assert [stamp for stamp, _ in stamps(timing.three_timeouts)] == [0.2, 0.400000001, 0.600000001]


def test_a_logger_throttles_by_simulated_time():
    texts = stamps(timing.throttled_log)
    assert [line for line in texts if line[1].startswith("throttled")] == [
        (0.0, "throttled 0"), (1.0, "throttled 4"), (2.0, "throttled 8"),
    ]  # fmt: skip
    assert [line for line in texts if line[1] == "once"] == [(0.0, "once")]
    skipped = [line for line in texts if line[1].startswith("not the first")]
    assert skipped == [(0.25 * count, f"not the first {count}") for count in range(1, 10)]


def test_once_means_once_in_each_run():
    for _ in range(2):
        assert (0.0, "once") in stamps(timing.throttled_log)


def test_time_passes_and_never_jumps_for_clocks_that_are_gone_or_kept():
    assert stamps(timing.JumpCallbacks, 1.5) == [
        (0.5, "tick 1735689600500000000"),
        (1.0, "tick 1735689601000000000"),
        (1.5, "tick 1735689601500000000"),
    ]


def test_a_switch_of_use_sim_time_is_reported_and_time_goes_on():
    assert stamps(timing.SwitchesTime, 2) == [
        (0.5, "kept before: False"), (0.5, "kept after: True, ROS_TIME_ACTIVATED"),
        (0.5, "1735689600500000000"), (1.0, "1735689601000000000"),
        (1.5, "kept before: True"), (1.5, "kept after: False, ROS_TIME_DEACTIVATED"),
        (1.5, "1735689601500000000"),
    ]  # fmt: skip


def test_a_switch_of_use_sim_time_ends_a_sleep():
    assert stamps(timing.switch_ends_a_sleep, 3) == [(0.5, "False"), (2.5, "True")]


def test_a_clock_goes_by_the_switch_of_its_time_source():
    assert [text for _, text in stamps(timing.clock_of_a_time_source, 1)] == ["True", "False"]
