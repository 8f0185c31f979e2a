"""Programs that are killed during a run, and started again."""

import itertools

from rclpy.node import Node
from std_msgs.msg import Int32

from sim import Process, run
from sim.ros.launching.respawned import respawned


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
    programs = Process(Counter), Process(Counter, remappings=[("/count", "/other")])
    recording = run(*[respawned(program, 1.0, 3.0, 0.5) for program in programs], seconds=5)
    assert counts(recording).index(1, 1) != counts(recording, "/other").index(1, 1)


def test_a_program_that_ends_by_itself_is_not_restarted():
    recording = run(respawned(Quitter, 0.3, 0.5, 0.1), seconds=5)
    assert counts(recording)[-1] == 8
    assert recording.all_exited_at is not None and recording.all_exited_at < 2.0
