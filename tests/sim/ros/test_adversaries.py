"""What no tutorial shows: the run ends with a verdict, and the next one in the same process is as usual."""

import gc
import sys

import pytest

from sim import run
from sim.ros.engine import guard
from sim.ros.recorder import base as recorder
from tests.sim.ros.evidence import logged, raised, times, why
from tests.students.engine import adversaries, mains

TICKS = [1.0, 2.0, 3.0]


@pytest.fixture(autouse=True)
def usual():
    before = run(mains.classic, seconds=2, quiet=True).digest
    yield
    assert run(mains.classic, seconds=2, quiet=True).digest == before


def after(program):
    return run(program, seconds=3, quiet=True)


@pytest.mark.parametrize("program", [
    adversaries.SpinsInInit, adversaries.UsesRosNamesForItself, adversaries.ReplacesSleep,
    adversaries.ExitsInThread, adversaries.DestroyForgetsSuper, adversaries.MeddlesWithTheTrace,
])  # fmt: skip
def test_odd_nodes_tick_all_the_same(program):
    limit = sys.getrecursionlimit()
    recording = after(program)
    sys.setrecursionlimit(limit)
    sys.settrace(None)
    assert times(recording, "tick") == TICKS
    assert recording.errors == []


@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
def test_an_error_in_del_is_pythons_to_ignore():
    assert times(after(adversaries.DelRaises), "tick") == TICKS
    gc.collect()


def test_a_node_may_destroy_itself():
    recording = after(adversaries.DestroysItself)
    assert times(recording, "tick") == [1.0]
    assert recording.errors == []


def test_spin_once_in_a_callback_works_in_the_default_group():
    recording = after(adversaries.SpinsOnceInCallback)
    assert logged(recording)[:4] == [(1.0, "tick"), (1.1, "spun"), (2.0, "tick"), (2.1, "spun")]


def test_a_rate_in_a_callback_of_a_single_threaded_executor_blocks():
    reason, stamp, detail = why(after(adversaries.SleepsByRateInCallback))
    assert (reason, stamp) == ("blocked", 3.0)
    assert detail.startswith(
        "SleepsByRateInCallback.tick of node /ticking has waited since t = 1 s and never returned, at line "
    )


@pytest.mark.parametrize("program, error", [
    (adversaries.AwaitsAsyncio, ("AwaitsAsyncio.tick", "RuntimeError", "no running event loop")),
    (adversaries.PublishesText, (
        "PublishesText.tick", "TypeError",
        "Expected <class 'std_msgs.msg._int32.Int32'>, got <class 'str'>",
    )),
    (adversaries.RaisesBaseException, ("RaisesBaseException.tick", "BaseException", "bare")),
], ids=lambda value: getattr(value, "__name__", ""))  # fmt: skip
def test_odd_errors_are_kept(program, error):
    assert raised(after(program)) == [(1.0, "/ticking", *error)]


@pytest.mark.parametrize("program", [
    adversaries.RaisesKeyboardInterrupt, adversaries.RaisesGeneratorExit, adversaries.exits_in_parallel,
])  # fmt: skip
def test_leaving_by_an_exit_is_no_error(program):
    recording = after(program)
    assert why(recording) == ("finished", 2.0, "Every program had ended by t = 1 s.")
    assert recording.errors == []


def test_a_main_that_returns_leaves_its_thread_spinning():
    assert times(after(adversaries.leaves_everything), "tick") == TICKS


def test_shutdown_in_a_thread_ends_spin():
    recording = after(adversaries.shutdown_in_another_thread)
    assert times(recording, "tick") == [1.0]
    assert why(recording) == ("finished", 2.5, "Every program had ended by t = 1.5 s.")


def test_sleeping_refuses_what_pythons_does():
    """sleep(True) takes a second."""
    kinds = ["ValueError", "TypeError", "ValueError", "OverflowError", "TypeError"]
    assert logged(after(adversaries.SleepsOddly)) == [(stamp, kind) for stamp in (2.0, 3.0) for kind in kinds]


def test_stdout_is_put_back():
    before = sys.stdout
    after(adversaries.RedirectsStdout)
    assert sys.stdout is before


def test_stdout_stays_open(monkeypatch):
    import io

    stream = io.StringIO()
    monkeypatch.setattr(sys, "stdout", stream)
    after(adversaries.ClosesStdout)
    assert not stream.closed


@pytest.mark.filterwarnings("ignore:This process")
def test_a_child_process_ends_as_it_should():
    assert times(after(adversaries.ForksByMultiprocessing), "exit code 0") == TICKS


@pytest.mark.parametrize(
    "node",
    [adversaries.DestroyRaises, adversaries.DestroyTimerRaises, adversaries.DestroyTimerRaisesInSlots],
)
def test_an_error_while_a_node_is_destroyed_stays_inside(node):
    assert times(after(node), "tick") == TICKS


def test_a_node_that_is_kept_has_its_own_class_again():
    kept = []
    run(lambda: kept.append(adversaries.DestroyRaises()) or kept[0], seconds=1, quiet=True)
    assert type(kept[0]) is adversaries.DestroyRaises


@pytest.mark.filterwarnings("ignore:This process")
def test_a_forked_child_leaves_the_run():
    assert times(after(adversaries.Forks), "tick") == TICKS


def test_a_loop_in_destroy_node_is_never_entered_by_the_tear_down():
    recording = after(adversaries.DestroyHangs)
    assert times(recording, "tick") == TICKS
    assert why(recording) == ("time", 3.0, "All 3 s were run.")


def test_a_timer_of_a_nanosecond_is_stopped():
    reason, stamp, detail = why(after(adversaries.NanosecondTimer))
    assert (reason, stamp) == ("livelock", pytest.approx(1.0, abs=0.001))
    assert detail == (
        "NanosecondTimer had more than 5000 callbacks or waits a second, faster than rclpy is on a robot, "
        f"until t = {stamp:g} s; a timer's period or a sleep is far too short."
    )


def test_an_async_main_is_refused():
    words = "coroutine_main is an `async def`, which nothing here awaits: write `def coroutine_main(...):`."
    recording = after(adversaries.coroutine_main)
    assert raised(recording) == [(0.0, "/coroutine_main", "coroutine_main", "TypeError", words)]
    assert recording.stderr == ""


def test_a_run_that_computes_too_long_in_all_is_stopped(monkeypatch):
    """No callback is long, but there is no end to them; a run may compute as long as it simulates."""
    monkeypatch.setattr(guard, "TOTAL_LIMIT", 0.5)
    reason, stamp, detail = why(run(adversaries.SlowByALittle, seconds=0.9, quiet=True))
    assert reason == "hang"
    places = "<lambda> of node /slow", "SlowByALittle()"  # in a callback or, seldom, between two
    words = "The nodes computed for 0.9 s in all, and were stopped in {} at t = {:g} s"
    assert detail.startswith(tuple(words.format(place, stamp) for place in places))
    assert 0 <= stamp < 0.9


def test_a_flood_of_bytes_is_stopped(monkeypatch):
    monkeypatch.setattr(recorder, "MAX_MESSAGE_BYTES", 10_000_000)
    recording = run(adversaries.Camera, seconds=3, quiet=True)
    assert why(recording) == ("livelock", 1.0, "the nodes sent more than 10 MB by t = 1 s.")
    assert len(recording.messages("/image")) == 9


def test_a_flood_of_small_messages_is_stopped(monkeypatch):
    monkeypatch.setattr(recorder, "MAX_MESSAGES", 9)
    recording = run(adversaries.Camera, seconds=3, quiet=True)
    assert why(recording) == ("livelock", 0.8, "the nodes sent more than 9 messages by t = 0.8 s.")
    assert len(recording.published) == 9
