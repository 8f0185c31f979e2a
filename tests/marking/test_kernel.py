"""In a real kernel: what nbgrader reads from a test cell, and what the student sees."""

import textwrap

import nbformat
import pytest
from nbgrader.utils import determine_grade

from grader.course_files.notebook_client import notebook_client
from tests.patience import PATIENCE

SETUP = """
    import logging, os, sys, warnings
    logging.basicConfig(level=logging.INFO)          # its handler keeps the kernel's own stderr
    from grader import Exercise, Missed, check
    from grader.checks import arrives, publishes
    from tests.students import misfits, mistakes
    from tests.students.engine import output

    @check(points=2.5)
    def sends(recording):
        "The node sends text on /chatter."
        publishes(recording, "/chatter", "std_msgs/msg/String")

    @check(points=1.5)
    def comes(recording):
        "The robot comes to its goal."
        arrives(recording, (1.0, 0.0))

    drive = Exercise("drive", "Drive", checks=[sends, comes], world="yard", seconds=3)

    class Noisy(misfits.Talker):
        def tick(self):
            logging.info("python logging")
            warnings.warn("a warning")
            os.write(2, b"descriptor")
            print("python", file=sys.stderr)
            self.get_logger().error("rclpy logging")
            super().tick()
"""
CASES = {
    "drive.grade(misfits.Talker)": 2.5,
    "drive.grade(Noisy)": 2.5,
    "drive.grade(output.writes_everywhere)": 0.0,
    "drive.grade(mistakes.NotStarted)": 0.0,
    "drive.grade(misfits.main_that_never_ends)": 0.0,
    "drive.grade(None)": 0.0,
    "drive.grade()": 0.0,
    "drive.grade('Talker')": 0.0,
}


@pytest.fixture(scope="module")
def cells():
    sources = [textwrap.dedent(SETUP), *CASES]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(source) for source in sources])
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
    notebook_client(notebook, PATIENCE, allow_errors=False).execute()
    return {cell.source: cell for cell in notebook.cells}


@pytest.mark.parametrize("source", CASES)
def test_nbgrader_reads_the_points_from_the_cell(cells, source):
    cell = cells[source]
    cell.metadata["nbgrader"] = {"grade": True, "solution": False, "points": 4}
    assert determine_grade(cell) == (CASES[source], 4.0)


@pytest.mark.parametrize("source", CASES)
def test_nothing_of_a_test_cell_is_on_stderr(cells, source):
    assert [output for output in cells[source].outputs if output.get("name") == "stderr"] == []


def test_the_cell_shows_the_table_then_a_replay(cells):
    outputs = [out for out in cells["drive.grade(misfits.Talker)"].outputs if out.output_type != "stream"]
    assert [output.output_type for output in outputs] == ["execute_result", "display_data"]
    assert outputs[1].data["text/html"].startswith('<div class="ros2-replay" data-replay="')
    assert '<img src="data:image/png;base64,iVBORw0KGgo' in outputs[1].data["text/html"]
    assert outputs[0].data["text/plain"] == "2.5"
    assert outputs[0].data["text/html"].startswith("<table")


def test_what_would_have_gone_to_stderr_is_not_lost_outside_a_run(cells):
    assert "✘ missed" in cells["drive.grade(None)"].outputs[0].data["text/html"]
