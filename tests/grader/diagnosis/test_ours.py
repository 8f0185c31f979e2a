"""What is broken between programs of ours, or by tools, is no flaw of the student's."""

import pytest
from rclpy.node import Node

from grader.diagnosis import explain, find_flaw
from grader.exercises.silence import silent_systems, terminal
from sim import run
from tests.students import misfits

BROKEN = {
    "name": (misfits.MisspeltTopic, misfits.Listener),
    "reliability": (misfits.BestEffortTalker, misfits.Listener),
    "durability": (misfits.Talker, misfits.LatchedListener),
}


class Bystander(Node):
    def __init__(self):
        super().__init__("bystander")
        self.create_timer(1.0, self.get_logger)


@pytest.mark.parametrize("fault", BROKEN)
def test_what_is_broken_between_programs_of_ours_is_not_explained(fault):
    assert explain(run(Bystander, companions=BROKEN[fault], seconds=2, quiet=True)) == ""
    talker, listener = BROKEN[fault]
    assert explain(run(listener, companions=[talker], seconds=2, quiet=True)) != ""


def test_the_six_silent_systems_alone_show_no_flaw():
    assert find_flaw(run(companions=silent_systems(3), seconds=2, quiet=True)) == ""


def test_a_tool_may_speak_before_it_was_found():
    command = terminal("ros2 topic pub -r 10 /chatter std_msgs/msg/String '{data: Hello}'")
    recording = run(misfits.Listener, command, seconds=2, quiet=True)
    assert [row.node for row in recording.undelivered] == ["/_ros2cli"]
    assert find_flaw(recording) == ""
