"""A class with capstones: a small assignment whose last exercise is given the three programs of a robot."""

import copy
import shutil
from pathlib import Path

import nbformat
from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_notebook

from tests.bench import delivery
from tests.marking.tiny import ROOT, answer, grade

ASSIGNMENT, NOTEBOOK = "13_robot", "robot"
SETUP = "from rclpy.node import Node\nfrom grader.exercises import nodes, topics"
PROGRAMS = "Perception = Decision = Control = None"
CRASHES = """\
class Perception(Node):
    def __init__(self):
        super().__init__("perception")
        raise ValueError("<b>no map</b>")

Decision = Control = Perception
"""
IDLE = """\
class Perception(Node):
    def __init__(self):
        super().__init__("perception")

class Decision(Node):
    def __init__(self):
        super().__init__("decision")

class Control(Node):
    def __init__(self):
        super().__init__("control")
"""
ENDS_LATER = (
    IDLE
    + """
import ctypes

class Control(Node):
    made = 0

    def __init__(self):
        super().__init__("control")
        Control.made += 1
        if Control.made == 2:
            ctypes.string_at(0)
"""
)


ROLLS = (
    IDLE
    + """
from geometry_msgs.msg import Twist

class Control(Node):
    def __init__(self):
        super().__init__("control")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_timer(0.1, self.roll)

    def roll(self):
        command = Twist()
        command.linear.x = 0.1
        self.publisher.publish(command)
"""
)


def robot() -> str:
    """The three programs of tests/bench/delivery in one cell."""
    folder = Path(delivery.__file__).parent
    texts = [(folder / f"{name}.py").read_text() for name in ("floor", "perception", "decision", "control")]
    lines = "\n\n".join(texts).splitlines()
    return "\n".join(line for line in lines if not line.startswith("from tests."))


def notebook(programs: str = PROGRAMS) -> NotebookNode:
    """The assignment with these programs. Its first exercise has nothing to do with a robot."""
    cells = [
        new_code_cell(SETUP, id="setup"),
        answer("greeting", "Greeter = None"),
        grade("greeting-points", 8, "topics.greeting.grade(Greeter)"),
        answer("programs", programs),
        grade("robot-points", 4, "nodes.counter.grade(Perception, Decision, Control)"),
    ]
    return new_notebook(cells=copy.deepcopy(cells))


def write(path: Path, programs: str) -> Path:
    """Write a capstone with these programs."""
    path.parent.mkdir(parents=True, exist_ok=True)
    nbformat.write(notebook(programs), path)
    return path


def classroom(folder: Path, students: dict[str, str], reference: str = "") -> Path:
    """A course in which these have handed in these programs, with a reference where it is given."""
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copy(ROOT / "nbgrader_config.py", folder)
    write(folder / "exercises" / ASSIGNMENT / f"{NOTEBOOK}.ipynb", PROGRAMS)
    if reference:
        write(folder / "solutions" / ASSIGNMENT / f"{NOTEBOOK}.ipynb", reference)
    for student, programs in students.items():
        write(folder / "class" / "submitted" / student / ASSIGNMENT / f"{NOTEBOOK}.ipynb", programs)
    return folder
