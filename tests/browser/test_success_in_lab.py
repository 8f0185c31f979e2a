"""What is reached is seen and announced: the star, full points, a finished lesson, a passed assignment."""

import re

import nbformat
import pytest

from tests.browser.lab import SHOWN, write_notebook
from tests.browser.test_play_in_lab import live, replay
from tests.browser.test_validate import GRADE
from tests.patience import until

pytestmark = pytest.mark.browser
ANNOUNCED = "document.querySelector('.ros2-course-announcement')?.textContent"
AHEAD = """
from dataclasses import replace
from rclpy.node import Node
from geometry_msgs.msg import Twist
from sim import World, play

class Ahead(Node):
    def __init__(self):
        super().__init__("ahead")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_timer(0.1, self.tick)

    def tick(self):
        twist = Twist()
        twist.linear.x = {speed}
        self.publisher.publish(twist)

ahead = replace(World.load("corridor"), goal=(6.0, 0.4))
player = play(Ahead, world=ahead, seconds=900, speed=4)
"""
LESSON = (
    "from sim.view import predict\nguess = predict('Does it fall?', a='yes', b='no')",
    "guess.outcome('b')",
)


@pytest.fixture
def titled(students_folder):
    """Write a notebook with a title and cells of code beside those of lesson 1; it is deleted afterwards."""
    written = []

    def write(folder: str, title: str, *sources: str) -> str:
        path = students_folder / folder / "01_nodes" / f"small_{len(written)}.ipynb"
        write_notebook(path, *sources)
        notebook = nbformat.read(path, 4)
        notebook.cells.insert(0, nbformat.v4.new_markdown_cell(title))
        nbformat.write(notebook, path)
        written.append(path)
        return path.relative_to(students_folder).as_posix()

    yield write
    for path in written:
        path.unlink()
        path.with_name("predictions.json").unlink(missing_ok=True)


def line(lab):
    return lab.page.locator(f"{SHOWN} .ros2-course-success")


def announced(lab, text):
    until(lambda: lab.page.evaluate(ANNOUNCED) == text, text)


def test_the_star_is_filled_and_the_time_announced_live_and_in_the_replay(students_folder, open_lab):
    name = "pictures/star.ipynb"
    write_notebook(students_folder / name, AHEAD.format(speed=0.4), AHEAD.format(speed=0.5))
    with open_lab(name) as lab:
        lab.page.evaluate("localStorage.removeItem('ros2-course-best-times')")
        lab.run_cell(0)
        time = re.compile(r"Reached the star in \d+\.\d s\.")
        said = live(lab).root.locator(".say.success[role=status]", has_text=time)
        said.wait_for()
        assert "best time" not in said.inner_text()
        lab.screenshot("star-reached")
        live(lab).click("End the run")
        replay(lab).root.wait_for()
        lab.run_cell(1)
        live(lab).root.get_by_text(re.compile(r"Your best time here; before: \d+\.\d s\.")).wait_for()
        lab.screenshot("star-best")
        live(lab).click("End the run")
        replay(lab).root.wait_for()
        replay(lab).root.get_by_role("button", name="Reached the star").click()
        replay(lab).root.locator(".say.success", has_text="Reached the star in").wait_for()
        lab.screenshot("star-replay")


def test_a_finished_lesson_says_so_below_its_last_cell_and_leads_on(titled, students_folder, open_lab):
    name = titled("course", "# Lesson 1: nodes", *LESSON)
    with open_lab(name) as lab:
        lab.run_cell(1)
        lab.cell(1).locator("button", has_text="no").click()
        until((students_folder / name).with_name("predictions.json").exists, "the saved prediction")
        assert line(lab).count() == 0
        lab.run_cell(2)
        line(lab).wait_for()
        assert line(lab).inner_text() == "✔ Lesson 1 done, 1 of 1 predictions right. Next: 1 Nodes: exercises"
        announced(lab, "Lesson 1 done, 1 of 1 predictions right.")
        last, below = (each.bounding_box() for each in (lab.cell(2), line(lab)))
        assert last["y"] + last["height"] <= below["y"]
        lab.screenshot("lesson-done")
        with lab.narrow_and_dark():
            line(lab).scroll_into_view_if_needed()
            lab.screenshot("lesson-done-narrow-dark")
        line(lab).get_by_role("button").click()
        lab.page.get_by_role("tab", name="1 Nodes: exercises").wait_for()


def test_points_are_announced_and_a_passed_assignment_says_so(titled, open_lab):
    name = titled("exercises", "# Assignment 1: nodes", "1.5", "2.0")
    with open_lab(name) as lab:
        for index in (1, 2):
            lab.page.evaluate(GRADE, [index, 2])
        lab.run_cell(1)
        announced(lab, "Assignment 1: nodes: 1.5 of 2 points.")
        lab.run_cell(2)
        announced(lab, "Assignment 1: nodes: 2 of 2 points. Full points.")
        assert line(lab).count() == 0
        lab.page.evaluate("window.notebook().content.model.cells.get(1).sharedModel.setSource('2.0')")
        lab.run_cell(1)
        announced(lab, "Assignment 1: nodes: 2 of 2 points. Full points. Assignment 1 passed, 4 of 4 points.")
        line(lab).wait_for()
        assert line(lab).inner_text() == "✔ Assignment 1 passed, 4 of 4 points. Next: 2 Topics: lesson"
        lab.screenshot("assignment-passed")
