"""Advice on values of parameters that YAML reads otherwise than they are meant, with the exact sentences."""

import pytest
from rclpy.node import Node

from grader.diagnosis import find_fault
from grader.diagnosis.parameter_files import mixed_list
from sim import Process, run
from sim.evidence import CallbackError


class Axis(Node):
    def __init__(self):
        super().__init__("axis")
        self.declare_parameter("axis", "x")
        self.declare_parameter("gains", [1.0])


def hint(*arguments):
    program = Process(Axis, arguments=["--ros-args", *arguments])
    return find_fault(run(program, seconds=1, quiet=True)).hint


@pytest.mark.parametrize(
    ("word", "words", "value", "quoted"),
    [("y", "y, yes, on", "true", "y"), ("off", "n, no, off", "false", "n")],
)
def test_a_word_that_yaml_reads_as_true_or_false_is_named(word, words, value, quoted):
    assert hint("-p", f"axis:={word}") == (
        f"The parameter `axis` is text, but YAML reads {words} and {value} without quotes as {value}. Quote it "
        f'in a parameter file: axis: "{quoted}". A launch file\'s parameters={{...}} loses the quotes: write '
        f"ros_arguments=['-p', 'axis:=\"{quoted}\"'] there."
    )


def test_the_launch_file_of_the_advice_gives_the_text(tmp_path):
    (tmp_path / "axis.py").write_text(
        "import rclpy\nrclpy.init()\nnode = rclpy.create_node('axis')\n"
        "node.declare_parameter('axis', 'x')\nprint(node.get_parameter('axis').value)\n"
    )
    file = tmp_path / "axis.launch.py"
    file.write_text(
        "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
        "def generate_launch_description():\n"
        f"    node = Node(executable='python3', arguments=['{tmp_path}/axis.py'],\n"
        "        ros_arguments=['-p', 'axis:=\"y\"'])\n    return LaunchDescription([node])\n"
    )
    recording = run(file, seconds=1, quiet=True)
    assert (recording.errors, "".join(text for _, text in recording.prints)) == ([], "y\n")


@pytest.mark.parametrize(
    ("values", "kind", "line"),
    [("[1.0, 2]", "integer", 3), ("\n    - 1.0\n    - big", "string", 5)],
)
def test_a_list_of_two_types_is_named_with_its_file_line_and_key(tmp_path, values, kind, line):
    file = tmp_path / "axis.yaml"
    file.write_text(f"/**:\n  ros__parameters:\n    gains: {values}\n    axis: x\n")
    assert hint("--params-file", str(file)) == (
        f"{file}, line {line}: the list `gains` has a value of type {kind} after one of another type, but all values of a list must have the same type. `1` and `1.0` have different types, and text is a third."
    )


def test_without_the_file_the_key_is_left_out():
    text = (
        "Couldn't parse params file: '--params-file no.yaml'. Error: Sequence should be of same type. "
        "Value type 'bool' do not belong at line_num 3, at"
    )
    assert mixed_list(CallbackError(0.0, "/n", "main", "RCLInvalidROSArgsError", text, "")) == (
        "no.yaml, line 3: a list has a value of type bool after one of another type, but all values of a list must have the same type. `1` and `1.0` have different types, and text is a third."
    )
