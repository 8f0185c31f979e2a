"""Programs that are killed during a run, and started again."""

import functools
import itertools

from rclpy.node import Node
from std_msgs.msg import Int32

from grader.exercise import Scenario
from grader.programs import LocalPrograms, RemotePrograms
from sim import Process, run
from sim.ros.launching.respawned import respawned
from tests.sim.ros.remote.follower_process import FollowerProcess


class Counter(Node):
    """Counts ten times a second, from 1 on."""

    def __init__(self):
        super().__init__("counter")
        self.count = 0
        self.publisher = self.create_publisher(Int32, "/count", 10)
        self.create_timer(0.1, self.tick)

    def tick(self):
        self.count += 1
        self.publisher.publish(Int32(data=self.count))


class Quitter(Counter):
    def tick(self):
        super().tick()
        if self.count == 8:
            raise SystemExit


def counts(recording, topic="/count"):
    return [item.message.data for item in recording.messages(topic)]


def test_a_program_is_killed_and_begins_anew_later():
    recording = run(respawned(Counter, 1.0, 2.0, 0.5), seconds=5)
    stamps = [item.stamp for item in recording.messages("/count")]
    ((last, first),) = [(a, b) for a, b in itertools.pairwise(stamps) if b - a > 0.15]
    assert 0.9 < last < 2.0
    assert 0.5 < first - last < 0.75
    lived = round(last / 0.1)
    assert counts(recording) == [*range(1, lived + 1), *range(1, len(stamps) - lived + 1)]
    assert recording.errors == []
    assert recording.ended.reason == "time"


def test_each_program_dies_at_its_own_time_and_keeps_its_settings():
    prepare = functools.partial(respawned, 1.0, 3.0, 0.5)
    cast = LocalPrograms([Counter, Process(Counter, remappings=[("/count", "/other")])])
    recording = run(*[prepare.func(program, *prepare.args) for program in cast.programs()], seconds=5)
    assert counts(recording).index(1, 1) != counts(recording, "/other").index(1, 1)


def test_a_program_that_ends_by_itself_is_not_restarted():
    recording = run(respawned(Quitter, 0.3, 0.5, 0.1), seconds=5)
    assert counts(recording)[-1] == 8
    assert recording.all_exited_at is not None and recording.all_exited_at < 2.0


def test_a_program_in_another_process_is_killed_at_the_same_time():
    scenario = Scenario(None, 5.0, prepare=functools.partial(respawned, 1.0, 2.0, 0.5))
    follower = FollowerProcess()
    with follower.serving(__name__, "Counter") as remote:
        there = counts(scenario.run(RemotePrograms(remote), 0))
    follower.close()
    assert there == counts(scenario.run(LocalPrograms([Counter]), 0))
