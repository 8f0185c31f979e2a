"""Programs of the course that several exercises use."""

import functools

from std_msgs.msg import Float64, String

from grader.companions.qos import LATCHED
from grader.companions.schedule import Schedule
from sim import run


def test_a_schedule_publishes_each_message_once_and_at_its_time():
    rows = [(0.29, "/level", Float64(data=1.0)), (1.7, "/level", Float64(data=2.0)), (0.5, "/word", String())]
    recording = run(functools.partial(Schedule, "sender", rows), seconds=3)
    assert [(row.stamp, row.message.data) for row in recording.messages("/level")] == [
        (0.29, 1.0),
        (1.7, 2.0),
    ]
    assert [row.stamp for row in recording.messages("/word")] == [0.5]


def test_its_quality_of_service_holds_for_all_topics():
    recording = run(functools.partial(Schedule, "sender", [(0.1, "/word", String())], LATCHED), seconds=1)
    (end,) = recording.graph.publishers("/word")
    assert (end.qos["durability"], end.qos["depth"]) == ("transient_local", 1)
