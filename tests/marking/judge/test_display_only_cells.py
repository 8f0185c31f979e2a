import nbformat
import pytest

from grader.marking.judge.display_only_cells import display_only_cells
from grader.marking.judge.marking_state import cell_name
from tests.marking.tiny import ROOT

SETUP = "from sim import run"
NODE = "class Talker:\n    pass"
SEE = "recording = run(Talker, seconds=3)\ntell(recording)"
PLOT = "plot_path(recording)"
LOOP = "for received in recording.messages():\n    print(received.stamp)"


def left_out(*sources: str) -> list[str]:
    """The released cells among these that need not be run; the student's begin with `#`."""
    own = {place for place, source in enumerate(sources) if not source.startswith("#")}
    return [sources[place] for place in sorted(display_only_cells(sources, own))]


def test_a_cell_that_looks_at_a_run_is_left_out_with_those_that_use_what_it_made():
    assert left_out(SETUP, NODE, SEE, PLOT, LOOP) == [SEE, PLOT, LOOP]


def test_a_run_without_a_name_and_the_words_of_ros2_are_looks():
    looks = ["plot_graph(run(Talker, seconds=1))", "%ros2 node info /watcher\n%ros2 topic list"]
    assert left_out(SETUP, *looks) == looks


def test_what_a_student_uses_is_run():
    assert left_out(SETUP, SEE, "# mine\nprint(recording)") == []
    assert left_out(SETUP, SEE, "# mine\ndef f():\n    return recording") == []
    assert left_out(SETUP, SEE, "# mine\nclass C:\n    it = recording") == []
    assert left_out(SETUP, SEE, PLOT, "# mine\nprint([recording for _ in '12'])") == []


def test_a_run_cell_is_found_to_be_needed_by_another_that_is_run():
    first, second = "world = made()\nrecording = run(Talker, world=world)", "again = run(Talker, world=world)"
    assert left_out(first, second) == [first, second]
    assert left_out(first, second, "# mine\nprint(again)") == []


def test_names_of_a_function_of_its_own_are_others():
    assert left_out(SEE, LOOP, "# mine\ndef f(recording):\n    b = 1\n    return recording, b") == [
        SEE,
        LOOP,
    ]


@pytest.mark.parametrize(
    "hiding",
    ["globals()['recording']", "eval('recording')", "%matplotlib recording", f"{'-' * 100_000}recording"],
)
def test_a_cell_that_hides_names_may_use_all_its_words(hiding):
    assert left_out(SEE, f"# mine\n{hiding}") == []


def test_what_a_cell_writes_into_a_file_is_no_name_of_the_notebook():
    assert left_out(SEE, "# mine") == left_out(SEE, "%%writefile mine.py\nprint(recording)") == [SEE]
    assert left_out(SEE, "%%writefile {recording}.py\n") == []


@pytest.mark.parametrize(
    "more",
    ["Talker.rate = 2", "rates[0] = 2", "del Talker", "with open('it') as file:\n    pass", "!ls", "%cd ws"],
)
def test_a_cell_that_changes_something_is_run(more):
    assert left_out(f"{SEE}\n{more}") == []


def test_a_source_that_is_shown_is_left_out():
    source = "print(inspect.getsource(topics.OneMeter))"
    assert left_out("import inspect", source) == [source]


def test_what_only_makes_something_is_run():
    assert left_out(SETUP, NODE, "import math", "it = plot(1, 1)", "def f():\n    return recording") == []


@pytest.mark.parametrize("path", sorted(ROOT.glob("solutions/*/*.ipynb")), ids=lambda path: path.stem)
def test_the_cells_that_look_are_left_out_of_every_assignment(path):
    cells = [cell for cell in nbformat.read(path, 4).cells if cell.cell_type == "code"]
    own = {place for place, cell in enumerate(cells) if not cell_name(cell)}
    found = {cells[place].id for place in display_only_cells([cell.source for cell in cells], own)}
    assert {cell.id for cell in cells if cell.id.endswith("-see")} <= found
    assert not any(name in found for name in ("setup", *(f"{cell.id}-given" for cell in cells)))


def test_the_questions_of_a_shift_are_shown_beside_the_answers():
    cells = nbformat.read(ROOT / "solutions" / "13b_delivery" / "delivery.ipynb", 4).cells
    code = [cell for cell in cells if cell.cell_type == "code"]
    indices = display_only_cells([cell.source for cell in code], set(range(len(code))))
    found = {code[index].id for index in indices}
    assert {"report-shift", "report-questions"} <= {cell.id for cell in code} - found
