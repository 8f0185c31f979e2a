"""Test cells of plain Python: an assert, partial points, hints, and what can't be counted."""
import nbformat
import pytest

from grader.marking.judge.mark_submission import mark_submission, result_text
from grader.marking.judge.plain_tests import read_points
from grader.marking.result import Result
from tests.marking.assignment import task
from tests.marking.tiny import answer, grade

SETUP = "import rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\nfrom sim import run"
TALKER = """\
class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        self.publisher = self.create_publisher(String, "/chatter", 10)
        self.create_timer(0.5, self.talk)

    def talk(self):
        self.get_logger().warning("on stderr, which costs nothing")
        self.publisher.publish(String(data="hello"))
"""
TESTS = {
    "doubled": 'assert double(3) == 6, "Hint: double(3) is 6."',
    "tripled": "points = 0\nif triple(0) == 0:\n    points += 1\nif triple(2) == 6:\n    points += 2\npoints",
    "talks": 'assert len(run(Talker, seconds=2).messages("/chatter")) == 4, "Hint: publish at 2 Hz."',
}
RIGHT = {"doubled": "double = lambda x: 2 * x", "tripled": "triple = lambda x: 3 * x", "talks": TALKER}


@pytest.fixture
def marked(tmp_path, start_student):
    """Marks a submission with these answers, by the test that tests them."""

    def do(**answers: str) -> Result:
        cells = [nbformat.v4.new_code_cell(SETUP, id="setup")]
        for name, text in TESTS.items():
            cells += [answer(f"{name}-answer", "pass"), grade(name, 3, text)]
        for folder in ("90_mine", "ann"):
            (tmp_path / folder).mkdir()
            nbformat.write(nbformat.v4.new_notebook(cells=cells), tmp_path / folder / "mine.ipynb")
            for at, name in enumerate(TESTS):
                cells[1 + 2 * at].source = (RIGHT | answers)[name]
        done = mark_submission(
            task(tmp_path / "ann", tmp_path / "90_mine"), "", lambda: start_student("x", begun=False).student
        )
        return Result.from_json(result_text(done))

    return do


def points(result: Result) -> dict[str, float]:
    return {cell.cell: cell.points for cell in result.notebooks[0].cells}


def test_right_answers_earn_everything(marked):
    result = marked()
    assert (result.verdict, result.flags) == ("marked", [])
    assert points(result) == {"doubled": 3.0, "tripled": 3.0, "talks": 3.0}


def test_wrong_answers_earn_what_the_cell_says_and_get_its_hint(marked):
    result = marked(doubled="double = lambda x: x", tripled="triple = lambda x: 2 * x", talks="Talker = None")
    assert points(result) == {"doubled": 0.0, "tripled": 1.0, "talks": 0.0}
    doubled, tripled, talks = (cell.verdicts[0] for cell in result.notebooks[0].cells)
    assert (doubled["status"], doubled["saw"]) == ("failed", "Hint: double(3) is 6.")
    assert tripled["saw"] == "1 of 3 points"
    assert talks["saw"].startswith("TypeError: ")
    shown = str(result.notebooks[0].notebook)
    assert "Hint: double(3) is 6." in shown


def test_a_cell_after_a_crash_is_judged_and_the_crash_earns_nothing(marked):
    result = marked(doubled="import os\ndef double(x): os._exit(0)")
    assert points(result) == {"doubled": 0.0, "tripled": 3.0, "talks": 3.0}


def output(kind: str, **fields: object) -> dict:
    return {"output_type": kind, **fields}


def value(text: str) -> dict:
    return output("execute_result", data={"text/plain": text})


@pytest.mark.parametrize(
    ("outputs", "earned"),
    [
        ([], 4.0),
        ([output("stream", text="log")], 4.0),
        ([value("2.5")], 2.5),
        ([value("0")], 0.0),
        ([value("4.0"), output("error", ename="ValueError", evalue="x")], 0.0),
    ],
)
def test_the_points_are_those_of_the_outputs(outputs, earned):
    result, problem = read_points("mine", 4.0, outputs)
    assert (result.points, result.needs_look, problem) == (earned, False, "")


@pytest.mark.parametrize("text", ["True", "nan", "5", "-1", "'done'", "inf"])
def test_a_value_that_is_no_number_of_points_is_for_the_instructor_to_see(text):
    result, problem = read_points("mine", 4.0, [value(text)])
    assert problem == f"its last line gives {text!r}; expected a number of points from 0 to 4"
    assert (result.points, result.needs_look) == (0.0, True)
