"""What run() refuses, and with which words; a refused run leaves nothing behind."""

import math

import pytest
import rclpy
from rclpy.node import Node

from sim import Process, World, run
from sim.ros.fibers.scheduler import active
from sim.world import WorldError
from tests.students.engine import mains


class NotANode:
    pass


@pytest.fixture
def a_node():
    rclpy.init()
    node = mains.Counter()
    yield node
    node.destroy_node()
    rclpy.shutdown()


def refused(kind, *arguments, **keywords):
    """The words of the refusal."""
    with pytest.raises(kind) as caught:
        run(*arguments, quiet=True, **keywords)
    assert active() is None
    return str(caught.value)


def test_an_object_is_not_a_class(a_node):
    with pytest.raises(TypeError) as caught:
        run("Counter")
    assert str(caught.value) == "run() takes the class itself: write run(Counter), without quotes."
    with pytest.raises(TypeError) as caught:
        run([mains.Counter, mains.Counter])
    assert str(caught.value) == "run() takes programs one by one: write run(A, B), without a list."
    words = "run() takes the class, not an object of it: write run(Counter), not run(Counter())."
    assert refused(TypeError, a_node) == words


def test_a_class_must_be_a_node():
    assert refused(TypeError, NotANode) == "NotANode is not a ROS node: write `class NotANode(Node):`."


@pytest.mark.parametrize("thing", [None, 3, "two words"])
def test_nothing_else_can_be_run(thing):
    words = "run() takes Node classes, functions that return a node, or main() functions; this is {!r}."
    assert refused(TypeError, thing) == words.format(thing)
    assert refused(TypeError, Process(thing)) == words.format(thing)


@pytest.mark.parametrize("seconds", [0, -1, math.nan, math.inf, 1e6])
def test_seconds_are_positive_and_finite(seconds):
    words = f"seconds must be more than 0 and less than a million; it is {seconds!r}."
    assert refused(ValueError, mains.Counter, seconds=seconds) == words


@pytest.mark.parametrize("seed", ["three", 1.5, None, -1])
def test_a_seed_is_a_whole_number(seed):
    import random

    before = random.getstate()
    words = f"seed must be a whole number, 0 or more; it is {seed!r}."
    assert refused(ValueError, mains.Counter, seed=seed) == words
    assert random.getstate() == before


def test_a_world_has_a_known_name():
    assert refused(WorldError, mains.Counter, world="moon") == (
        f"There is no world 'moon'. The worlds are {', '.join(World.names())}."
    )


def test_no_nodes_at_all_is_a_robot_alone():
    recording = run(world="yard", seconds=1, quiet=True)
    assert recording.graph.nodes == ["/robot"]
    assert tuple(recording.ended) == ("time", 1.0, "All 1 s were run.")


def test_a_world_may_be_an_object():
    world = World.load("yard")
    assert run(mains.Counter, world=world, seconds=1, quiet=True).world is world


def test_the_goal_ends_a_run():
    seen = []

    def goal(recording):
        seen.append(recording.stamp)
        return len(recording.messages("/count")) >= 2

    recording = run(mains.Counter, seconds=9, until=goal, quiet=True)
    assert tuple(recording.ended) == ("goal", 1.0, "The goal was reached at t = 1 s.")
    assert seen == sorted(seen) and seen[-1] == 1.0


def test_an_exception_in_the_goal_is_the_callers():
    def goal(recording):
        raise LookupError("my own goal")

    assert refused(LookupError, mains.Counter, until=goal) == "my own goal"
    assert run(mains.Counter, seconds=1, quiet=True).ended.reason == "time"


def test_a_run_in_another_thread_works():
    """There the guard can't watch; all else is the same."""
    import threading

    results = []
    thread = threading.Thread(target=lambda: results.append(run(mains.Counter, seconds=1, quiet=True)))
    thread.start()
    thread.join()
    assert results[0].digest == run(mains.Counter, seconds=1, quiet=True).digest


def test_runs_in_several_threads_take_turns():
    from concurrent.futures import ThreadPoolExecutor

    def digest(seconds):
        return run(mains.classic, world="room", seconds=seconds, quiet=True).digest

    lengths = [1, 2, 3, 4]
    with ThreadPoolExecutor(3) as threads:
        assert list(threads.map(digest, lengths)) == [digest(seconds) for seconds in lengths]


def test_rclpy_is_as_it_was_before_a_refusal():
    refused(WorldError, mains.Counter, world="moon")
    assert not rclpy.ok()
    rclpy.init()
    node = Node("mine")
    assert rclpy.ok()
    node.destroy_node()
    rclpy.shutdown()
