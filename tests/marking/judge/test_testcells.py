import nbformat
import pytest

from grader import Exercise
from grader.exercises import topics
from grader.marking.errors import UnknownTest
from grader.marking.judge.testcells import exercise_names, find_exercise
from tests.marking.tiny import ROOT, answer, grade

IMPORT = nbformat.v4.new_code_cell("from grader.exercises import topics")


def notebook(*cells: nbformat.NotebookNode) -> nbformat.NotebookNode:
    return nbformat.v4.new_notebook(cells=list(cells))


@pytest.mark.parametrize("path", sorted(ROOT.glob("exercises/*/*.ipynb")), ids=lambda path: path.stem)
def test_every_test_cell_of_the_course_names_an_exercise(path):
    found = exercise_names(nbformat.read(path, 4))
    assert found
    assert all(isinstance(find_exercise(name), Exercise) for name in found.values())


@pytest.mark.parametrize(
    "setup",
    [
        "from grader.exercises import topics",
        "%matplotlib inline\nfrom grader.exercises import topics",
        "import grader.exercises.topics as topics",
        "from grader.exercises.topics import square\nfrom grader import exercises",
    ],
)
def test_an_exercise_is_found_by_its_import(setup):
    line = "square.grade(Driver)" if "import square" in setup else "topics.square.grade(Driver)"
    if setup.startswith("%"):
        cells = [nbformat.v4.new_code_cell(part) for part in setup.split("\n")]
    else:
        cells = [nbformat.v4.new_code_cell(setup)]
    found = exercise_names(notebook(*cells, answer("a", "Driver = None"), grade("points", 3, line)))
    assert found == {"points": "grader.exercises.topics.square"}
    assert find_exercise(found["points"]) is topics.square


@pytest.mark.parametrize(
    "line",
    [
        "topics.square.grade",
        "%matplotlib inline",
        "x = topics.square.grade(Driver)",
        "topics.square.grade(Driver)\nprint()",
        "topics().square.grade(Driver)",
        "others.square.grade(Driver)",
        "topics['square'].grade(Driver)",
        "this is no Python",
        "",
    ],
)
def test_another_test_cell_is_refused_with_a_way_out(line):
    with pytest.raises(UnknownTest) as refused:
        exercise_names(notebook(IMPORT, grade("my_points", 3, line)))
    assert str(refused.value) == (
        "The test cell `my_points` can't be marked here: "
        "expected a line such as `topics.square.grade(Driver)` "
        "and a cell that imports `topics` from grader.exercises, or Python that calls no `grade`, such as "
        "`assert double(3) == 6`."
    )


@pytest.mark.parametrize("line", ["assert double(3) == 6", "points = 1.5\npoints", "import math"])
def test_plain_python_is_a_test_without_an_exercise(line):
    assert exercise_names(notebook(IMPORT, grade("my_points", 3, line))) == {"my_points": ""}


def test_an_import_of_something_else_is_no_exercise():
    imports = nbformat.v4.new_code_cell("from os import path as topics\nfrom .grader.exercises import topics")
    with pytest.raises(UnknownTest):
        exercise_names(notebook(imports, grade("points", 3, "topics.square.grade(Driver)")))


def test_answers_and_cells_that_are_graded_by_hand_are_no_tests():
    by_hand = answer("essay", "text = ''")
    by_hand.metadata.nbgrader.update(grade=True, points=5)
    assert exercise_names(notebook(IMPORT, by_hand, nbformat.v4.new_markdown_cell("x"))) == {}


@pytest.mark.parametrize("name", ["grader.exercises.topics.cube", "grader.exercises.cube.x"])
def test_an_exercise_that_is_not_there_is_named(name):
    with pytest.raises(UnknownTest) as refused:
        find_exercise(name)
    assert str(refused.value) == (
        f"A test cell grades {name}, but there is no such exercise. Is the release from this course?"
    )
