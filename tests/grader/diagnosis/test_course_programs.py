"""What is broken between programs of the course, or by tools, is no flaw of the student's."""

import pytest
from rclpy.node import Node

from grader.diagnosis import explain, find_flaw
from grader.exercises.silence import silent_systems, terminal
from sim import run
from sim.evidence import BUNDLED
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
def test_what_is_broken_between_programs_of_the_course_is_not_explained(fault):
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


MIMIC = """
<launch>
  <node pkg="turtlesim" exec="turtlesim_node" name="sim" namespace="turtlesim1"/>
  <node pkg="turtlesim" exec="turtlesim_node" name="sim" namespace="turtlesim2"/>
  <node pkg="turtlesim" exec="mimic" name="mimic">
    <remap from="/input/pose" to="/turtlesim1/turtle1/pose"/>
    <remap from="/output/cmd_vel" to="/turtlesim2/turtle1/cmd_vel"/>
  </node>
</launch>
"""


def test_programs_that_a_launch_file_starts_and_the_course_includes_are_not_the_students(tmp_path):
    file = tmp_path / "mimic.launch.xml"
    file.write_text(MIMIC)
    recording = run(str(file), world="turtlesim", seconds=2, quiet=True)
    assert {row.node for row in recording.node_facts if row.fact == BUNDLED} == {
        *("/turtlesim1/sim", "/turtlesim2/sim", "/mimic"),
    }
    assert find_flaw(recording) == explain(recording) == ""
