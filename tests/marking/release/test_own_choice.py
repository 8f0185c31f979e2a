"""class/course.toml: exercises that are left out and points that are changed."""
import nbformat
import pytest
from nbgrader.api import Gradebook

from grader.marking.command.check_release import check_release
from grader.marking.errors import CourseError
from grader.marking.gradebook.book import Book
from grader.marking.gradebook.course import Course
from grader.marking.judge.personal_release import has_variants
from grader.marking.release.make_exercises import differences, release
from grader.marking.release.own_choice import choose, read_choice
from tests.marking.tiny import ROOT, answer, course, grade

NODES = ROOT / "solutions" / "01_nodes" / "nodes.ipynb"
FILE = "class/course.toml"


def nodes(**choice) -> nbformat.NotebookNode:
    return choose(nbformat.read(NODES, 4), choice, "01_nodes")


def ids(notebook) -> list[str]:
    return [cell.id for cell in notebook.cells]


def test_an_exercise_is_left_out_with_its_section_and_its_row():
    before, after = nodes(), nodes(leave_out=["heart"])
    section = {f"heart{part}" for part in ("-task", "", "-see", "-hints", "-points")}
    assert set(ids(before)) - set(ids(after)) == section
    rows = set(before.cells[0].source.splitlines()) - set(after.cells[0].source.splitlines())
    assert len(rows) == 1
    assert rows.pop().startswith("| 4 | a heart with two timers |")


def test_points_are_changed_in_the_test_cell_the_heading_and_the_row():
    before, after = nodes(), nodes(points={"counter": 7.5})
    changed = {new.id: new for old, new in zip(before.cells, after.cells, strict=True) if old != new}
    assert sorted(changed) == ["counter-points", "counter-task", "title"]
    assert changed["counter-points"].metadata.nbgrader.points == 7.5
    assert changed["counter-task"].source.startswith("## 2. A node that counts (7.5 points)\n")
    assert "use a timer and remember something | 7.5 |\n" in changed["title"].source


def test_what_other_cells_need_can_t_be_left_out_alone():
    notebook = nbformat.v4.new_notebook(cells=[
        nbformat.v4.new_markdown_cell("## 1. One"),
        answer("one", "def one(): return 1"),
        grade("one-points", 1, "assert one() == 1"),
        nbformat.v4.new_markdown_cell("## 2. Two"),
        answer("two", "%time\ndef two(x): return one() + x"),
        grade("two-points", 1, "assert two(1) == 2"),
    ])  # fmt: skip
    with pytest.raises(CourseError) as refused:
        choose(notebook, {"leave_out": ["one"]}, "x")
    assert str(refused.value) == f"{FILE}: 'one' can't be left out: other cells use `one`, which it defines"
    assert len(choose(notebook, {"leave_out": ["one", "two"]}, "x").cells) == 0


def test_an_assignment_with_variants_has_a_tag_and_nothing_else_changes():
    before, after, off = nodes(), nodes(variants=True), nodes(variants=False)
    assert (off, has_variants([off]), has_variants([after])) == (before, False, True)
    after.cells[0].metadata.pop("tags")
    assert after == before


def test_variants_are_refused_where_there_are_none():
    path = ROOT / "solutions" / "11c_testing" / "testing.ipynb"
    with pytest.raises(CourseError) as refused:
        choose(nbformat.read(path, 4), {"variants": True}, "11c_testing")
    why = "11c_testing has no exercise with variants: leave out `variants = true` in class/course.toml"
    assert str(refused.value) == why


@pytest.mark.parametrize("choice", [{"leave_out": ["hallo"]}, {"points": {"hallo": 3}}])
def test_an_exercise_that_isn_t_there_is_named(choice):
    with pytest.raises(CourseError) as refused:
        nodes(**choice)
    known = "hello, counter, battery, heart, main, weather"
    assert str(refused.value) == f"{FILE}: 01_nodes has no exercise 'hallo': it has {known}"


@pytest.mark.parametrize(
    ("text", "saw"),
    [
        ("[a]\nleave = []", "{'leave': []}"),
        ("[a]\nleave_out = 'b'", "{'leave_out': 'b'}"),
        ("[a]\npoints = {b = 'c'}", "{'points': {'b': 'c'}}"),
        ("[a]\nvariants = 'b'", "{'variants': 'b'}"),
    ],
)
def test_a_file_with_other_lines_is_refused(tmp_path, text, saw):
    (tmp_path / "course.toml").write_text(text)
    with pytest.raises(CourseError) as refused:
        read_choice(tmp_path / "course.toml")
    lines = 'leave_out = ["hello"], points = { counter = 10 } and variants = true'
    expected = f"expected lines such as {lines} below ['a'], saw {saw}"
    assert str(refused.value) == f"{tmp_path}/course.toml: {expected}"


def test_a_file_that_can_t_be_read_is_named(tmp_path):
    (tmp_path / "course.toml").write_text("[")
    with pytest.raises(CourseError, match=r"^/.*course\.toml can't be read \("):
        read_choice(tmp_path / "course.toml")


@pytest.fixture
def chosen(tmp_path, monkeypatch) -> Course:
    """A course in which one of two exercises is left out, and the other one gives other points."""
    folder = course(
        tmp_path / "course",
        nbformat.v4.new_markdown_cell("## 1. Double", id="head1"),
        answer("double", "def double(x):\n    ### BEGIN SOLUTION\n    return x + x\n    ### END SOLUTION"),
        grade("double-points", 2, "assert double(3) == 6"),
        nbformat.v4.new_markdown_cell("## 2. Triple (3 points)", id="head2"),
        answer("triple", "def triple(x):\n    ### BEGIN SOLUTION\n    return x * 3\n    ### END SOLUTION"),
        grade("triple-points", 3, "assert triple(2) == 6"),
    )
    (folder / "class").mkdir()
    (folder / FILE).write_text('["01_tiny"]\nleave_out = ["double"]\npoints = { triple = 9 }\n')
    monkeypatch.chdir(folder)
    release(folder)
    return Course(folder)


def test_release_gradebook_and_marking_agree_on_the_choice(chosen):
    made = nbformat.read(chosen.release("01_tiny") / "tiny.ipynb", 4)
    assert ids(made) == ["head2", "triple", "triple-points"]
    assert differences(chosen.root) == []
    with Gradebook(chosen.database) as book:
        assert book.find_assignment("01_tiny").max_score == 9
    with Book(chosen) as book:
        check_release(chosen, "01_tiny", book.cells("01_tiny"))


def test_a_wrong_choice_stops_the_release_with_its_sentence(chosen):
    (chosen.root / FILE).write_text('["01_tiny"]\nleave_out = ["treble"]\n')
    with pytest.raises(CourseError) as refused:
        release(chosen.root)
    assert str(refused.value) == f"{FILE}: 01_tiny has no exercise 'treble': it has double, triple"


def test_hidden_tests_are_refused_because_marking_doesn_t_run_them(chosen):
    path = chosen.source("01_tiny") / "tiny.ipynb"
    notebook = nbformat.read(path, 4)
    notebook.cells[-1].source += "\n### BEGIN HIDDEN TESTS\nassert triple(0) == 0\n### END HIDDEN TESTS"
    nbformat.write(notebook, path)
    release(chosen.root)
    with Book(chosen) as book, pytest.raises(CourseError) as refused:
        check_release(chosen, "01_tiny", book.cells("01_tiny"))
    why = "has hidden tests, which only `nbgrader autograde` runs: show these tests"
    assert str(refused.value) == f"solutions/01_tiny/tiny.ipynb {why}"
