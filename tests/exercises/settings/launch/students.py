"""Ways to launch a cruiser: right ones, and wrong ones named by their defect."""

import rclpy
from rclpy.parameter import Parameter

from sim import Process
from tests.exercises.settings.parameters.students import (
    AnotherName,
    Cruiser,
    CruiserWithDescriptor,
    CruiserWithField,
    ReadOnceInInit,
)


def launch():
    return Process(Cruiser, parameters={"speed": 0.3})


def launch_with_list():
    return Process(CruiserWithField, parameters=[{"speed": 0.3}])


def launch_with_words():
    """A design of its own: the words of the command line."""
    return Process(CruiserWithDescriptor, arguments=["--ros-args", "-p", "speed:=0.3"])


as_process = Process(CruiserWithDescriptor, name="cruiser", parameters={"speed": 0.3})


def main():
    rclpy.init(args=["--ros-args", "-p", "speed:=0.3"])
    rclpy.spin(Cruiser())
    rclpy.shutdown()


def of_a_node_that_reads_it_once():
    """The cruiser isn't judged here."""
    return Process(ReadOnceInInit, parameters={"speed": 0.3})


def sets_it_in_the_program():
    """Sets the speed in the program in place of at the launch, and to something else."""
    node = Cruiser()
    node.set_parameters([Parameter("speed", value=0.45)])
    return node


def misspelt_setting():
    return Process(Cruiser, parameters={"sped": 0.3})


def whole_number_setting():
    return Process(Cruiser, parameters={"speed": 1})


def text_setting():
    return Process(Cruiser, parameters={"speed": "0.3"})


def setting_of_another_node():
    return Process(AnotherName, parameters={"speed": 0.3})


def forgets_to_return():
    Process(Cruiser, parameters={"speed": 0.3})


def renames_it():
    return Process(Cruiser, name="fast_cruiser", parameters={"speed": 0.3})


def with_a_keyword():
    return Process(Cruiser, speed=0.3)


def with_text():
    return Process(Cruiser, parameters="speed:=0.3")
