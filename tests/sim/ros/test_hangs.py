"""Code that never gives control back is stopped and named; the next run in the same process is as usual."""

import re
import signal
from pathlib import Path

import pytest

from sim import run
from sim.ros.engine import guard
from tests.sim.ros.evidence import raised, why
from tests.students.engine import hangs, mains, timing

LOOP = "{} computed for {} s without finishing, at line {}: {}."
STUCK = (
    "{}.tick of node /hanging has waited since t = 1 s and never returned, at line {}: {}. It waits for {}."
)
BUSY = "{} of node /hanging at t = 1 s"


def line_in(node, text, method="tick"):
    """Number of the line of a class that reads so."""
    code = getattr(node, method).__code__
    with open(code.co_filename) as file:
        lines = file.readlines()
    start = code.co_firstlineno
    return next(number for number in range(start, len(lines)) if lines[number - 1].strip() == text)


@pytest.fixture
def usual(monkeypatch):
    """The digest of a usual run before; afterwards it must be the same. Hangs are noticed sooner here."""
    monkeypatch.setattr(guard, "COMPUTING_LIMIT", 0.4)
    before = run(mains.classic, world="yard", seconds=2, quiet=True).digest
    yield
    monkeypatch.undo()
    assert run(mains.classic, world="yard", seconds=2, quiet=True).digest == before


def test_a_loop_is_stopped_after_two_seconds_of_computing():
    recording = run(hangs.Loop, seconds=3, quiet=True)
    detail = LOOP.format(BUSY.format("Loop.tick"), 2, line_in(hangs.Loop, "while True:"), "while True:")
    assert why(recording) == ("hang", 1.0, detail)
    assert recording.errors == []


@pytest.mark.parametrize("node, where, stamp, method", [
    (hangs.LoopInMain, "main() at t = 0 s", 0.0, "main"),
    (hangs.LoopInInit, "LoopInInit() at t = 0 s", 0.0, "__init__"),
], ids=["main", "init"])  # fmt: skip
@pytest.mark.usefixtures("usual")
def test_a_loop_is_named_wherever_it_is(node, where, stamp, method):
    recording = run(getattr(node, "main", node), seconds=3, quiet=True)
    detail = LOOP.format(where, 0.4, line_in(node, "while True:", method), "while True:")
    assert why(recording) == ("hang", stamp, detail)


@pytest.mark.parametrize("node", [
    hangs.LoopThatSwallows, hangs.LoopThatSwallowsExceptions, hangs.Allocates,
])  # fmt: skip
@pytest.mark.usefixtures("usual")
def test_a_loop_is_stopped_whatever_it_does(node):
    recording = run(node, seconds=3, quiet=True)
    reason, stamp, detail = why(recording)
    assert (reason, stamp) == ("hang", 1.0)
    name = f"{node.__name__}.tick"
    assert detail.startswith(f"{BUSY.format(name)} computed for 0.4 s without finishing, at line ")


def test_a_call_that_no_one_answers_is_interrupted(usual, monkeypatch):
    def impatient(recording):  # from the start on, which a busy machine may hold up
        monkeypatch.setattr(guard, "WAITING_LIMIT", 1.0)

    recording = run(hangs.Pipe, seconds=3, until=impatient, quiet=True)
    line = line_in(hangs.Pipe, "os.read(read, 1)")
    assert why(recording) == (
        "hang", 1.0, "Pipe.tick of node /hanging at t = 1 s waited for 1 s in a call that simulated time "
        f"can't shorten, at line {line}: os.read(read, 1).",
    )  # fmt: skip


def test_time_in_which_no_core_is_free_is_no_waiting(usual, monkeypatch):
    monkeypatch.setattr(guard, "WAITING_LIMIT", 0.3)
    monkeypatch.setattr(guard, "wall_time", lambda: 0.0)
    recording = run(hangs.WaitsForASecond, seconds=2, quiet=True)
    assert why(recording) == ("time", 2.0, "All 2 s were run.")


def test_wall_time_is_without_that_in_the_queue_for_a_core(tmp_path, monkeypatch):
    statistics = tmp_path / "schedstat"
    statistics.write_text("17 2000000000 3\n")
    monkeypatch.setattr(guard, "SCHEDULING", str(statistics))
    monkeypatch.setattr(guard, "monotonic", lambda: 10.0)
    assert guard.wall_time() == 8.0
    statistics.unlink()
    assert guard.wall_time() == 10.0


def test_the_kernel_says_how_long_a_thread_was_in_the_queue():
    assert Path(guard.SCHEDULING).read_text().split()[1].isdigit()


def test_many_short_waits_in_real_time_have_an_end(usual, monkeypatch):
    def impatient(recording):
        if recording.stamp >= 1.0:
            monkeypatch.setattr(guard, "SECOND_LIMIT", 1.0)

    reason, stamp, detail = why(run(hangs.WaitsALittle, seconds=3, until=impatient, quiet=True))
    assert (reason, 1.0 <= stamp < 2.0) == ("hang", True)
    assert detail.startswith(
        "One simulated second took 1 s of real time; the nodes were stopped in thread WaitsALittle.work() at "
        f"t = {stamp:g} s, at line {line_in(hangs.WaitsALittle, 'while True:', 'work') + 1}: select.poll("
    )


@pytest.mark.parametrize("node, line, waits_for", [
    (hangs.Lock, "with lock, lock:", "a lock"),
    (hangs.EventNoOneSets, "threading.Event().wait()", "a lock"),
    (hangs.EmptyQueue, "queue.Queue().get()", "a lock"),
], ids=lambda value: getattr(value, "__name__", ""))  # fmt: skip
@pytest.mark.usefixtures("usual")
def test_waiting_for_ever_is_reported_with_its_line(node, line, waits_for):
    recording = run(node, seconds=3, quiet=True)
    detail = STUCK.format(node.__name__, line_in(node, line), line, waits_for)
    assert why(recording) == ("blocked", 3.0, detail)


def test_waiting_for_a_thread_is_reported_alike_each_time():
    first, second = (run(hangs.JoinsItself, seconds=3, quiet=True) for _ in range(2))
    assert first.ended == second.ended
    assert first.ended.reason == "blocked"


@pytest.mark.parametrize("program, reason", [
    (hangs.AsksForEver, "blocked"), (hangs.asks_in_a_program_that_ends, "finished"),
])  # fmt: skip
def test_a_coroutine_that_swallows_its_end_is_left_behind(usual, program, reason):
    """It goes on where it waited; when its node is gone, asking fails, and it asks again, forever."""
    recording = run(program, seconds=3, quiet=True)
    assert (recording.ended.reason, recording.errors, recording.stderr) == (reason, [], "")


@pytest.mark.parametrize("node", [hangs.Sleep, hangs.SleepLoop])
@pytest.mark.usefixtures("usual")
def test_sleeping_is_no_hang(node):
    assert why(run(node, seconds=3, quiet=True)) == ("time", 3.0, "All 3 s were run.")


@pytest.mark.parametrize(
    "node", [hangs.PingPong, hangs.GuardCondition, hangs.TaskThatMakesTasks, hangs.ZeroTimer]
)
@pytest.mark.usefixtures("usual")
def test_callbacks_that_never_let_time_go_on_are_stopped(node):
    assert why(run(node, seconds=3, quiet=True)) == (
        "livelock", 1.0, "20000 callbacks ran at t = 1 s without letting time advance.",
    )  # fmt: skip


def test_a_program_can_not_swallow_the_end_of_a_ping_pong(usual):
    assert why(run(hangs.swallows_ping_pong, seconds=3, quiet=True)) == (
        "livelock", 1.0, "20000 callbacks ran at t = 1 s without letting time advance.",
    )  # fmt: skip


def test_what_a_flood_leaves_is_bounded(usual):
    recording = run(hangs.LoopWithPrint, hangs.LoopWithLog, seconds=3, quiet=True)
    assert sum(len(text) for _, text in recording.prints) <= 1_000_000
    assert len(recording.logs) <= 100_000


def test_a_flood_shows_its_first_lines_only(usual, capsys):
    run(hangs.LoopWithLog, seconds=3)
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 101
    assert lines[0] == "[INFO] [1.000] [hanging]: still here"
    assert lines[-1].startswith("... and ") and lines[-1].endswith(" more lines, all in the recording")


def test_endless_recursion_is_an_error(usual):
    recording = run(hangs.Recursion, seconds=3, quiet=True)
    assert raised(recording) == [
        (1.0, "/hanging", "Recursion.tick", "RecursionError", "maximum recursion depth exceeded")
    ]
    assert len(recording.errors[0].traceback.splitlines()) < 20


def test_the_others_are_recorded_to_the_end_of_that_moment(usual):
    recording = run(hangs.Loop, mains.Counter, seconds=3, quiet=True)
    assert [received.stamp for received in recording.messages("/count")] == [0.5, 1.0]


@pytest.mark.parametrize("program, line", [
    (timing.waits_for_a_slow_child, 'subprocess.run(["sleep", "60"], check=True)'),
    (timing.waits_for_a_slow_shell, 'os.system("sleep 60")'),
    (timing.waits_for_a_slow_child_with_a_timeout, "child.wait(timeout=50)"),
    (timing.waits_for_a_slow_connection, "multiprocessing.connection.wait([here])"),
], ids=["run", "system", "wait", "connection"])  # fmt: skip
def test_waiting_for_another_process_has_a_limit_on_wall_time(program, line, monkeypatch):
    monkeypatch.setattr(guard, "WAITING_LIMIT", 0.3)
    recording = run(program, seconds=3, quiet=True)
    begin = f"{program.__name__}() at t = 0 s waited for 0.3 s of real time for another process"
    assert re.sub(r"line \d+", "line N", recording.ended.detail) == f"{begin}, at line N: {line}."
    assert (recording.ended.reason, recording.errors) == ("hang", [])


def test_a_shorter_wait_for_another_process_ends_as_it_does_without_a_run(monkeypatch):
    monkeypatch.setattr(guard, "WAITING_LIMIT", 60.0)
    recording = run(timing.waits_shortly_for_a_connection, seconds=3, quiet=True)
    assert [line.text for line in recording.logs] == ["0", "1"]


def test_the_shell_s_status_is_that_without_a_run():
    recording = run(timing.asks_the_shell, seconds=1, quiet=True)
    assert [line.text for line in recording.logs] == [f"{3 << 8} {int(signal.SIGKILL)}"]
