"""Further verbs of ros2: param delete, lifecycle list, wtf."""

import pytest
from rclpy.lifecycle import LifecycleNode
from rclpy.node import Node
from rclpy.parameter import Parameter

from sim import run
from sim.ros2.cli_program import terminal
from sim.ros2.parser import load_group


class Camera(LifecycleNode):
    def __init__(self):
        super().__init__("camera")


class Wheel(Node):
    def __init__(self):
        super().__init__("wheel")
        self.declare_parameter("radius", 0.1)
        self.declare_parameter("anything", Parameter.Type.STRING)


def output_of(command, node):
    recording = run(node, terminal(command), seconds=5, quiet=True)
    return "".join(text for _, text in recording.prints)


def test_the_transitions_of_a_lifecycle_node_are_listed():
    assert output_of("ros2 lifecycle list /camera", Camera) == (
        "- configure [1]\n\tStart: unconfigured\n\tGoal: configuring\n"
        "- shutdown [5]\n\tStart: unconfigured\n\tGoal: shuttingdown\n"
    )


def test_all_transitions_of_a_lifecycle_node_are_listed():
    assert "- activate [3]\n\tStart: inactive\n\tGoal: activating\n" in output_of(
        "ros2 lifecycle list -a /camera", Camera
    )


@pytest.mark.parametrize("name", ["radius", "none"])
def test_a_declared_parameter_is_not_deleted(name):
    assert output_of(f"ros2 param delete /wheel {name}", Wheel).startswith("Deleting parameter failed: ")


def test_wtf_is_doctor():
    assert load_group("wtf").verbs == load_group("doctor").verbs
