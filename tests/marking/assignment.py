"""A small assignment on disk, and what someone handed in for it."""
import copy
from pathlib import Path

import nbformat
from nbformat.v4 import new_code_cell, new_notebook

from grader.marking.submission.assignment_release import load_release
from grader.marking.submission.submitted_files import read_folder
from grader.marking.task import MarkingTask
from tests.marking.tiny import answer, grade

GREETER = """\
class Greeter(Node):
    def __init__(self):
        super().__init__("greeter")
        self.publisher = self.create_publisher(String, "/greeting", 10)
        self.create_timer(0.5, lambda: self.publisher.publish(String(data="Hello!")))
"""
THERMOMETER = """\
class Thermometer(Node):
    def __init__(self):
        super().__init__("thermometer")
        self.publisher = self.create_publisher(Float32, "/sensor/temperature", 10)
        self.create_timer(1.0, self.measure)

    def measure(self):
        self.publisher.publish(Float32(data=random.uniform(20.0, 25.0)))
"""
SETUP = """\
import random
from rclpy.node import Node
from std_msgs.msg import Float32, String
from grader.exercises import topics
from sim import run
"""
RIGHT = {"greeting": GREETER, "temperature": THERMOMETER}


def release(folder: Path, name: str = "two") -> Path:
    """An assignment of two exercises of 02_topics, worth 8 and 15 points, and cells between them."""
    cells = [
        new_code_cell(SETUP, id="setup"),
        answer("greeting", "Greeter = None"),
        new_code_cell("run(Greeter, seconds=1)", id="greeting-see"),
        grade("greeting-points", 8, "topics.greeting.grade(Greeter)"),
        answer("temperature", "Thermometer = None"),
        grade("temperature-points", 15, "topics.temperature.grade(Thermometer)"),
    ]
    folder.mkdir(parents=True, exist_ok=True)
    nbformat.write(new_notebook(cells=cells), folder / f"{name}.ipynb")
    return folder


def hand_in(
    folder: Path, released: Path, answers: dict[str, str] | None = None, name: str = "two"
) -> MarkingTask:
    """Write a submission with these answers, by the cells' ids; all right where they aren't said."""
    answers = RIGHT | (answers or {})
    notebook = copy.deepcopy(nbformat.read(released / f"{name}.ipynb", 4))
    for cell in notebook.cells:
        cell.source = answers.get(cell.id, cell.source)
    folder.mkdir(parents=True, exist_ok=True)
    nbformat.write(notebook, folder / f"{name}.ipynb")
    return task(folder, released)


def task(folder: Path, released: Path) -> MarkingTask:
    """The task of marking what is in `folder` now, handed in by the student of that name."""
    known = load_release(released)
    return MarkingTask(folder.name, known, read_folder(folder, known), "0" * 64)
