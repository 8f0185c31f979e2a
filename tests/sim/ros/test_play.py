"""What is played leaves the recording of a run, however it is cut, and whatever comes in between."""

import inspect
import itertools
import math
import random

import matplotlib.pyplot as plt
import numpy as np
import pytest
import rclpy
from rclpy.node import Node

from sim import play, run
from sim.ros.fibers.scheduler import active
from tests.patience import until
from tests.sim.ros import playing, programs
from tests.students.engine import (
    actions,
    adversaries,
    drivers,
    errors,
    event_loops,
    executors,
    hangs,
    mains,
    names,
    output,
    services,
    styles,
    threads,
    timing,
)

MODULES = (
    actions, drivers, errors, event_loops, executors, mains, names, services, styles, threads, timing,
)  # fmt: skip
LATE_FAULTS = (adversaries.coroutine_main, hangs.Pipe, hangs.PingPong, output.logs_at_every_level)


def runnable(thing, module):
    """Whether a name of a module is a student's program."""
    if getattr(thing, "__module__", None) != module.__name__:
        return False
    if inspect.isclass(thing):
        return issubclass(thing, Node) and not list(inspect.signature(thing).parameters)
    return inspect.isfunction(thing) and not set(inspect.signature(thing).parameters) - {"args"}


SLOW = {"Flood"}  # computes for 20 s
PROGRAMS = [
    thing
    for module in MODULES
    for name, thing in vars(module).items()
    if name not in SLOW and runnable(thing, module)
]
DAILY = {services.await_reentrant}  # no node offers its service, which once looked blocked in slices only
PARTS = [  # every day a third of them: in each module are some
    pytest.param(
        thing, id=thing.__qualname__, marks=[pytest.mark.soak] if number % 3 and thing not in DAILY else []
    )
    for number, thing in enumerate(PROGRAMS)
]


def test_there_are_many_kinds_of_programs():
    assert len(PROGRAMS) > 100


@pytest.mark.parametrize("program", PARTS)
def test_it_is_equal_to_run_in_slices_of_odd_lengths(program):
    usual = run(program, seconds=3, quiet=True)
    played = playing.to_the_end(playing.player(program, seconds=3))
    assert (played.ended, played.digest) == (usual.ended, usual.digest)
    assert (played.prints, played.stderr) == (usual.prints, usual.stderr)


@pytest.mark.parametrize("speed", [0.3, 7.0, math.inf])
def test_it_is_equal_at_every_speed(speed):
    scenario = {"world": "room", "seconds": 8, "seed": 3}
    usual = run(programs.Wanderer, services.Adder, quiet=True, **scenario)
    made = playing.player(programs.Wanderer, services.Adder, speed=speed, **scenario)
    playing.watched(made)
    assert playing.to_the_end(made).digest == usual.digest


def test_pauses_steps_and_speeds_change_nothing():
    usual = run(programs.Wanderer, services.Adder, world="room", seconds=8, quiet=True)
    made = playing.player(programs.Wanderer, services.Adder, world="room", seconds=8)
    playing.watched(made)
    acts = itertools.cycle([
        made.pause, made.step, made.step, made.resume, lambda: setattr(made, "speed", 3.3),
        lambda: setattr(made, "speed", 0.7), made.step, made.resume,
    ])  # fmt: skip
    assert playing.to_the_end(made, lambda: next(acts)()).digest == usual.digest


def other_work():
    """What a user may do in other cells, a bit of it after each frame."""
    while True:
        yield random.random(), np.random.random()
        yield random.seed(4), np.random.seed(4)
        yield run(mains.classic, seconds=1, quiet=True)
        yield print("printed in another cell")
        figure = plt.figure()
        figure.gca().plot([1, 2], [3, 4])
        figure.canvas.draw()
        yield plt.close(figure)
        rclpy.init()
        node = rclpy.create_node("mine")
        yield node.create_timer(1.0, lambda: None)
        yield rclpy.spin_once(node, timeout_sec=0.0)
        node.destroy_node()
        yield rclpy.shutdown()
        yield rclpy.logging.get_logger("levels").set_level(rclpy.logging.LoggingSeverity.DEBUG)
        yield rclpy.logging.get_logger("levels").set_level(rclpy.logging.LoggingSeverity.UNSET)


@pytest.mark.parametrize("nodes", [
    (programs.Wanderer, services.Adder), (threads.lock_across_sleeps, threads.queues),
    (actions.parallel_server, actions.Impatient), (mains.shuts_itself_down, output.logs_at_every_level),
], ids=lambda nodes: nodes[0].__qualname__)  # fmt: skip
def test_other_work_in_between_changes_nothing(nodes, capsys):
    usual = run(*nodes, world="room", seconds=4, quiet=True)
    work = other_work()
    played = playing.to_the_end(playing.player(*nodes, world="room", seconds=4), lambda: next(work))
    assert played.digest == usual.digest
    assert set(capsys.readouterr().out.splitlines()) == {"printed in another cell"}
    if rclpy.ok():
        rclpy.shutdown()


@pytest.mark.parametrize("stream", ["stdout", "stderr"])
def test_it_goes_on_while_the_user_has_no_stream(stream, monkeypatch):
    usual = run(mains.classic, output.writes_everywhere, seconds=1, quiet=True)
    made = playing.player(mains.classic, output.writes_everywhere, seconds=1)
    monkeypatch.setattr(f"sys.{stream}", None)
    played = playing.to_the_end(made)
    monkeypatch.undo()
    assert (played.ended, played.digest) == (usual.ended, usual.digest)


def test_the_users_chance_is_not_the_runs():
    made = playing.player(programs.Wanderer, world="room", seconds=2)
    random.seed(1)
    np.random.seed(1)
    expected = [(random.random(), np.random.random()) for _ in range(30)]
    random.seed(1)
    np.random.seed(1)
    found = []
    playing.to_the_end(made, lambda: found.append((random.random(), np.random.random())))
    assert found[:30] == expected[: len(found)] and len(found) > 10


def test_between_two_frames_nothing_of_the_run_is_visible(capsys):
    import os
    import signal
    import sys

    def surroundings():
        return (
            sys.stdout, sys.stderr, os.fstat(2).st_ino, signal.getsignal(signal.SIGINT),
            signal.getsignal(signal.SIGALRM), signal.getitimer(signal.ITIMER_REAL)[1], active(),
            rclpy.ok(), rclpy.utilities.g_default_context, rclpy.__dict__["__executor"],
            "write" in vars(sys.stderr), rclpy.context.g_logging_ref_count - 1,
        )  # fmt: skip

    before = surroundings()
    made = playing.player(mains.classic, output.writes_everywhere, threads.queues, world="room", seconds=2)
    seen = []
    playing.to_the_end(made, lambda: seen.append(surroundings()))
    assert len(seen) > 10
    # the run's own context keeps rclpy's logging configured while it goes on, and is counted for that
    assert all(one[:-1] == before[:-1] for one in seen)
    assert surroundings() == before


def test_the_users_alarm_rings_while_something_plays():
    import signal

    rung = []
    before = signal.signal(signal.SIGALRM, lambda *_: rung.append(1))
    try:
        made = playing.player(mains.classic, world="room", seconds=600)
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        until(lambda: made.play_frame() or rung)
        made.stop()
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    assert rung == [1]


def test_no_alarm_of_the_users_rings_for_the_guard(monkeypatch):
    """While the handler of alarms changes, the user's timer stands still."""
    import signal

    from sim.ros.engine import guard

    def changes(number, handler):
        if number == signal.SIGALRM:
            left.append(signal.getitimer(signal.ITIMER_REAL)[0])
        return usual(number, handler)

    left: list[float] = []
    usual = signal.signal
    made = playing.player(mains.classic, world="room", seconds=600)
    monkeypatch.setattr(guard.signal, "signal", changes)
    try:
        signal.setitimer(signal.ITIMER_REAL, 1_000)
        made.play_frame()
        kept = signal.getitimer(signal.ITIMER_REAL)[0]
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        made.stop()
    assert len(left) >= 2 and set(left[:2]) == {0.0}
    assert 0 < kept <= 1_000


@pytest.mark.parametrize("program", LATE_FAULTS, ids=lambda program: program.__qualname__)
def test_it_ends_as_run_does(program, monkeypatch):
    from sim.ros.engine import guard

    def impatient(recording):  # from the start on, which a busy machine may hold up
        monkeypatch.setattr(guard, "WAITING_LIMIT", 1.0)

    usual = run(program, world="room", seconds=3, until=impatient, quiet=True)
    monkeypatch.undo()
    played = playing.to_the_end(playing.player(program, world="room", seconds=3, until=impatient))
    assert (played.ended, played.digest) == (usual.ended, usual.digest)


@pytest.mark.parametrize("program", [hangs.Loop, hangs.LoopThatSwallows, hangs.Sleep])
def test_a_hang_ends_it(program, monkeypatch):
    from sim.ros.engine import guard

    monkeypatch.setattr(guard, "COMPUTING_LIMIT", 0.5)
    usual = run(program, world="room", seconds=3, quiet=True)
    played = playing.to_the_end(playing.player(program, world="room", seconds=3))
    assert (played.ended, played.digest) == (usual.ended, usual.digest)
    assert playing.to_the_end(playing.player(mains.classic, seconds=1)).ended.reason == "time"


def test_computing_counts_over_all_frames(monkeypatch):
    """Each frame is short; together they are too much."""
    from sim.ros.engine import guard

    monkeypatch.setattr(guard, "TOTAL_LIMIT", 0.5)
    played = playing.to_the_end(playing.player(adversaries.SlowByALittle, seconds=0.9, speed=math.inf))
    assert played.ended.reason == "hang"
    assert played.ended.detail.startswith("The nodes computed for 0.9 s in all, and were stopped in ")


def test_time_between_two_frames_belongs_to_none(monkeypatch):
    """Waiting and computing in other cells is not the nodes'."""
    import time

    from sim.ros.engine import guard

    others = [0.0]
    monkeypatch.setattr(guard, "thread_time", lambda: time.thread_time() + others[0])
    made = playing.player(mains.classic, seconds=0.9)
    made.play_frame()
    others[0] = 100 * guard.TOTAL_LIMIT
    assert playing.to_the_end(made).ended.reason == "time"


def test_the_goal_is_asked_once_for_each_moment():
    def asked():
        stamps = []
        return stamps, lambda recording: stamps.append(recording.stamp) or len(stamps) == 25

    (usual, goal), (found, same) = asked(), asked()
    ended = run(mains.Counter, world="room", seconds=3, until=goal, quiet=True).ended
    played = playing.to_the_end(playing.player(mains.Counter, world="room", seconds=3, until=same))
    assert (found, played.ended) == (usual, ended)


def test_a_digest_asked_too_early_does_not_stay():
    usual = run(mains.Counter, seconds=2, quiet=True)
    made = playing.player(mains.Counter, seconds=2)
    early = set()
    assert playing.to_the_end(made, lambda: early.add(made.recording.digest)).digest == usual.digest


def test_what_nodes_write_is_shown_as_run_shows_it(capfd):
    run(output.writes_everywhere, seconds=1)
    usual = capfd.readouterr()
    playing.to_the_end(playing.player(output.writes_everywhere, seconds=1, quiet=False))
    assert capfd.readouterr() == usual
    assert usual.err == ""


def test_in_a_script_it_returns_when_it_is_over():
    player = play(mains.classic, world="room", seconds=5, speed=50, quiet=True)
    assert player.recording.digest == run(mains.classic, world="room", seconds=5, quiet=True).digest
    assert repr(player) == "<Player at 5.00 s of 5 s, ended: time>"
    assert player.result() is player.recording
