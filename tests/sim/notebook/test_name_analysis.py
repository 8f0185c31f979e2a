import functools

from sim.notebook.name_analysis import bound_names, defined_names, is_same_code, looked_up_names

CELL = """
import math, numpy as np
from rclpy.node import Node
%matplotlib inline
speed, (a, b) = 1.0, (2, 3)

class Robot(Node):
    wheel = 0.1

    def turn(self):
        inner = 1

def main():
    local = 2

for step in range(3):
    late = step
"""


def test_a_cell_defines_classes_functions_and_values():
    assert defined_names(CELL) == {"speed", "a", "b", "Robot", "main", "step", "late"}
    assert bound_names(CELL) - defined_names(CELL) == {"math", "np", "Node"}


def test_of_code_that_is_no_python_the_beginnings_of_lines_are_read():
    source = "class Robot(Node)\n    def turn(self):\n        x = = 3\n\nasync def main():\n    pass\n"
    assert defined_names(source) == bound_names(source) == {"Robot", "main"}


def test_a_file_that_a_cell_writes_defines_nothing():
    assert bound_names("%%writefile robot.py\nclass Robot:\n    pass\n") == set()


def test_comments_and_blank_lines_make_no_other_code():
    assert is_same_code("x = 1\n\n# one\n", "x = 1")
    assert not is_same_code("x = 1", "x = 2")
    assert is_same_code("x = = 1", "x =  = 1 ") and not is_same_code("x = = 1", "x = = 2")


def helper():
    return other()


def other():
    return 1


def test_a_class_looks_up_what_its_methods_and_what_is_in_them_name():
    class Robot:
        size = property(lambda self: SIZE)  # noqa: F821

        def turn(self):
            return [helper() for _ in range(2)]

        @staticmethod
        def halt():
            return (lambda: other())()

    assert {"SIZE", "helper", "other"} <= set(looked_up_names(Robot))
    assert "other" in set(looked_up_names(helper))
    assert list(looked_up_names(3)) == list(looked_up_names(functools.partial(helper))) == []
