"""What students do to cells, by accident or not, and what becomes of it."""

import copy

import nbformat
import pytest
from nbgrader.utils import compute_checksum

from tests.marking.submission.damage import (
    SOLVED,
    STARTER,
    cell,
    own,
    position,
    rebuilt,
    same,
)


def delete(*names):
    return lambda notebook: [notebook["cells"].pop(position(notebook, name)) for name in names]


def change(name, **fields):
    return lambda notebook: cell(notebook, name).update(fields)


def settings(name, **fields):
    return lambda notebook: cell(notebook, name)["metadata"]["nbgrader"].update(fields)


def copy_behind(name, **fields):
    def damage(notebook):
        again = {**copy.deepcopy(cell(notebook, name)), "id": "c0de", **fields}
        notebook["cells"].insert(position(notebook, name) + 1, again)

    return damage


def every(**fields):
    return lambda notebook: [cell.update(copy.deepcopy(fields)) for cell in notebook["cells"]]


def nameless(notebook):
    for each in notebook["cells"]:
        each["metadata"] = {}
        del each["id"]


def swap_names(notebook):
    one, other = (cell(notebook, name)["metadata"]["nbgrader"] for name in ("hello", "counter"))
    one["grade_id"], other["grade_id"] = "counter", "hello"


def older_test(notebook):
    """The cell as a version of the assignment had it in which it gave 12 points."""
    cell(notebook, "hello-points")["source"] = "nodes.greeting.grade(Hello)"
    older = nbformat.from_dict(cell(notebook, "hello-points"))
    older.metadata.nbgrader.points = 12
    settings("hello-points", points=12, checksum=compute_checksum(older))(notebook)


ALL = "`hello`, `hello-points`, `counter`, `counter-points`, `battery` and 8 more"
BY_ID = f"The cells {ALL} had lost their names; they were found by their ids."
BY_LOOK = f"The cells {ALL} had lost their names; they were found by their text and place."
EDITED = "The test cell `hello-points` was edited; the instructor's own was run."
TWICE = "The cell `hello` was in the notebook more than once; the last one with an answer was marked."
UNTOUCHED = next(cell.source for cell in STARTER.cells if cell.id == "hello")

HARMLESS = {
    "a text is gone": delete("goal"),
    "a text as a list of lines": lambda notebook: cell(notebook, "hello").update(
        source=cell(notebook, "hello")["source"].splitlines(keepends=True)
    ),
    "Windows line ends": lambda notebook: cell(notebook, "hello").update(
        source=cell(notebook, "hello")["source"].replace("\n", "\r\n")
    ),
    "no ids, as in format 4.4": lambda notebook: [cell.pop("id") for cell in notebook["cells"]],
    "a newer minor format": lambda notebook: notebook.update(nbformat_minor=99),
    "no metadata": lambda notebook: notebook.update(metadata=None),
    "another kernel of Python": lambda notebook: notebook["metadata"].update(
        kernelspec={"name": "ros2", "display_name": "ros2 (env)", "language": "python"}
    ),
    "a kernel that makes no sense": lambda notebook: notebook.update(
        metadata={"kernelspec": {"name": [], "language": {"name": "R"}}, "language_info": "Python"}
    ),
    "outputs, counts and widgets": lambda notebook: [
        notebook["metadata"].update(widgets={"state": {}}),
        cell(notebook, "hello").update(outputs=[{"output_type": "nonsense"}], execution_count="many"),
        cell(notebook, "title").update(attachments={"picture.png": {"image/png": "AAAA"}}),
    ],
}

REPAIRED = {
    "answer deleted": (delete("hello"), "The answer `hello` was missing; an empty cell took its place."),
    "test deleted": (
        delete("hello-points"),
        "The test cell `hello-points` was missing; the instructor's own was run.",
    ),
    "tests deleted": (
        delete("hello-points", "counter-points"),
        "The test cells `hello-points` and `counter-points` were missing; the instructor's own were run.",
    ),
    "set-up deleted": (
        delete("setup"),
        "The cell `setup` was missing; the one that was handed out was run.",
    ),
    "answer copied": (copy_behind("hello"), TWICE),
    "answer copied, the last untouched": (copy_behind("hello", source=UNTOUCHED), TWICE),
    "test copied": (
        copy_behind("hello-points"),
        "The test cell `hello-points` was in the notebook more than once; it was run once.",
    ),
    "answer renamed": (
        settings("hello", grade_id="Hello!"),
        "The cell `hello` had lost its name; it was found by its id.",
    ),
    "answer made Markdown": (
        change("hello", cell_type="markdown"),
        "The type of the cell `hello` was changed; its text was used anyway.",
    ),
    "answer made raw": (
        change("hello", cell_type="raw"),
        "The type of the cell `hello` was changed; its text was used anyway.",
    ),
    "test made Markdown": (
        change("hello-points", cell_type="markdown"),
        "The type of the test cell `hello-points` was changed; the instructor's own was run.",
    ),
    "unknown type": (
        change("hello", cell_type="banana\n`"),
        "Cell 5 of the notebook has the unknown type `banana??`; it was read anyway.",
    ),
    "no type": (
        change("hello", cell_type=[]),
        "Cell 5 of the notebook has no type; it was read anyway.",
    ),
    "text is a number": (
        change("hello", source=5),
        "Cell 5 of the notebook contains a number for its text; that was left out.",
    ),
    "text is nothing": (
        change("hello", source=None),
        "Cell 5 of the notebook contains nothing for its text; that was left out.",
    ),
    "text too long": (
        change("hello", source="#" * 1_100_000),
        "Cell 5 of the notebook contains 1.1 million characters, more than can be run; it counts as empty.",
    ),
    "a cell is a number": (
        lambda notebook: notebook["cells"].insert(0, 7),
        "Cell 1 of the notebook is a number; it was left out.",
    ),
    "all metadata is null": (every(metadata=None), BY_ID),
    "all metadata of nbgrader is text": (every(metadata={"nbgrader": "x"}), BY_ID),
    "names of nbgrader are numbers": (every(metadata={"nbgrader": {"grade_id": 5}}), BY_ID),
    "neither names nor ids": (nameless, BY_LOOK),
    "test of an older version": (
        older_test,
        "The test cell `hello-points` came from another version of the assignment; the current one was run.",
    ),
    "kernel of R": (
        lambda notebook: notebook["metadata"].update(
            kernelspec={"name": "ir", "display_name": "R", "language": "R"}
        ),
        "The notebook was saved for the kernel `R`; it was run with Python 3.",
    ),
    "kernel of Python 2": (
        lambda notebook: notebook["metadata"].update(kernelspec={"name": "python2"}),
        "The notebook was saved for the kernel `python2`; it was run with Python 3.",
    ),
    "only the language of R": (
        lambda notebook: notebook.update(metadata={"language_info": {"name": "R"}}),
        "The notebook was saved for the kernel `R`; it was run with Python 3.",
    ),
}
LOSES_THE_ANSWER = {"answer deleted", "text is a number", "text is nothing", "text too long"}

FLAGGED = {
    "test edited": (change("hello-points", source="10.0"), [], EDITED),
    "locked settings changed": (
        settings("hello-points", points=100, locked=False),
        [],
        "The points or other settings of the cell `hello-points` were changed; the instructor's own count.",
    ),
    "points without end": (
        settings("hello-points", points=10**400),
        [],
        "The points or other settings of the cell `hello-points` were changed; the instructor's own count.",
    ),
    "answer made a test": (
        settings("hello", grade=True, points=50),
        [],
        "The points or other settings of the cell `hello` were changed; the instructor's own count.",
    ),
    "test tagged": (
        lambda notebook: cell(notebook, "hello-points")["metadata"].update(tags=["skip-execution"]),
        [],
        "The test cell `hello-points` was tagged `skip-execution`; it was run.",
    ),
    "test copied and edited": (
        copy_behind("hello-points", source="10.0"),
        ["The test cell `hello-points` was in the notebook more than once; it was run once."],
        EDITED,
    ),
    "names exchanged": (
        swap_names,
        [],
        "The cells `hello` and `counter` had the names of others; they were recognized by their ids.",
    ),
    "name of another": (
        settings("hello", grade_id="counter"),
        [],
        "The cell `hello` had the name of another; it was recognized by its id.",
    ),
}


@pytest.mark.parametrize("damage", HARMLESS.values(), ids=HARMLESS)
def test_what_changes_nothing_is_passed_over_in_silence(damage):
    result = rebuilt(damage)
    assert (result.repairs, result.flags) == ([], [])
    assert same(result.notebook)


@pytest.mark.parametrize(("damage", "words"), REPAIRED.values(), ids=REPAIRED)
def test_an_accident_is_repaired_and_reported(damage, words, request):
    result = rebuilt(damage)
    assert (result.repairs, result.flags) == ([words], [])
    if request.node.callspec.id in LOSES_THE_ANSWER:
        assert next(cell.source for cell in result.notebook.cells if cell.id == "hello") == ""
    else:
        assert same(result.notebook)


@pytest.mark.parametrize(("damage", "repairs", "words"), FLAGGED.values(), ids=FLAGGED)
def test_what_honest_work_does_not_lead_to_changes_nothing_and_is_flagged(damage, repairs, words):
    result = rebuilt(damage)
    assert (result.repairs, result.flags) == (repairs, [words])
    assert same(result.notebook)


def test_a_missing_answer_is_distinguished_from_an_untouched_and_an_empty_one():
    def damage(notebook):
        cell(notebook, "counter")["source"] = next(c.source for c in STARTER.cells if c.id == "counter")
        cell(notebook, "battery")["source"] = ""
        delete("hello")(notebook)

    answers = rebuilt(damage).answers
    assert [answers[name] for name in ("hello", "counter", "battery", "heart")] == [
        "missing",
        "untouched",
        "answered",
        "answered",
    ]


def test_released_cells_that_give_no_points_are_run_as_the_student_changed_them():
    def damage(notebook):
        cell(notebook, "setup")["source"] += "\nimport math"
        cell(notebook, "goal").update(cell_type="code", source="goal = 1")
        cell(notebook, "hello-see").update(cell_type="markdown", source="not now", attachments={})

    result = rebuilt(damage)
    cells = {cell.id: cell for cell in result.notebook.cells}
    assert cells["setup"].source.endswith("\nimport math")
    assert (cells["goal"].cell_type, cells["goal"].source, cells["goal"].outputs) == ("code", "goal = 1", [])
    assert (cells["hello-see"].cell_type, cells["hello-see"].source) == ("markdown", "not now")
    assert (result.repairs, result.flags) == ([], [])


def test_the_students_own_cells_stay_in_their_place_without_outputs_and_metadata():
    metadata = {"tags": ["skip-execution"], "nbgrader": {"grade": True, "points": 50}}

    def damage(notebook):
        mine = own("speed = 0.2", metadata=metadata, outputs=[{"output_type": "stream"}], execution_count=3)
        notebook["cells"].insert(position(notebook, "hello-points"), mine)
        notebook["cells"].append(own("", cell_type="raw", id="not an id"))

    result = rebuilt(damage)
    at = [cell.id for cell in result.notebook.cells].index("f00d")
    mine = result.notebook.cells[at]
    assert dict(mine) == {**own("speed = 0.2"), "metadata": {}}
    assert result.notebook.cells[at + 1].id == "hello-points"
    assert result.notebook.cells[-1] == {"id": "cell-1", "cell_type": "raw", "metadata": {}, "source": ""}
    assert (result.repairs, result.flags) == ([], [])


def test_an_own_cell_cannot_take_the_id_of_a_released_cell():
    def damage(notebook):
        notebook["cells"].insert(0, own("x = 1", id="hello"))
        notebook["cells"].insert(0, own("x = 2", id="cell-1"))

    ids = [cell.id for cell in rebuilt(damage).notebook.cells]
    assert ids[:2] == ["cell-1", "cell-2"]
    assert ids[2:] == [cell.id for cell in SOLVED.cells]


def test_an_earlier_copy_of_an_answer_runs_before_the_one_that_is_marked():
    result = rebuilt(copy_behind("hello", source="class Hello(Rover):\n    pass"))
    at = [cell.id for cell in result.notebook.cells].index("hello")
    first, last = result.notebook.cells[at - 1 : at + 1]
    assert first.source == next(cell.source for cell in SOLVED.cells if cell.id == "hello")
    assert last.source == "class Hello(Rover):\n    pass"
    assert "nbgrader" not in first.metadata


def test_an_answer_that_was_deleted_and_written_anew_is_found_by_what_it_defines():
    def damage(notebook):
        at = position(notebook, "hello")
        both = [own("speed = 1", id="a"), own("class Hello(Node):\n    pass", id="b")]
        notebook["cells"][at : at + 1] = both

    result = rebuilt(damage)
    assert [cell.id for cell in result.notebook.cells[4:6]] == ["a", "hello"]
    assert result.repairs == ["The cell `hello` had lost its name; it was found by its text and place."]


def test_the_only_cell_in_the_place_of_an_answer_is_taken_for_it():
    def damage(notebook):
        notebook["cells"][position(notebook, "hello")] = own("from elsewhere import Hello", id="a")

    result = rebuilt(damage)
    answer = result.notebook.cells[4]
    assert (answer.id, answer.source) == ("hello", "from elsewhere import Hello")
    assert result.repairs == ["The cell `hello` had lost its name; it was found by its text and place."]


def test_where_two_cells_could_be_the_answer_neither_is_and_both_run():
    def damage(notebook):
        at = position(notebook, "hello")
        both = [own("class Hello(Node):\n    a = 1", id="a"), own("class Hello(Node):\n    b = 1", id="b")]
        notebook["cells"][at : at + 1] = both

    result = rebuilt(damage)
    assert [cell.id for cell in result.notebook.cells[4:7]] == ["hello", "a", "b"]
    assert result.answers["hello"] == "missing"
    assert result.repairs == ["The answer `hello` was missing; an empty cell took its place."]


def test_a_cell_like_a_deleted_test_is_the_students_own():
    def damage(notebook):
        mine = own("nodes.hello.grade(Hello)\nprint('done')")
        notebook["cells"][position(notebook, "hello-points")] = mine

    result = rebuilt(damage)
    assert "f00d" in [cell.id for cell in result.notebook.cells]
    assert (result.repairs, result.flags) == (
        ["The test cell `hello-points` was missing; the instructor's own was run."],
        [],
    )


def test_many_odd_cells_are_reported_in_a_few_sentences():
    def damage(notebook):
        notebook["cells"] += [{"cell_type": "code", "source": 5}] * 300

    repairs = rebuilt(damage).repairs
    assert len(repairs) == 6
    assert repairs[4:] == [
        "Cell 44 of the notebook contains a number for its text; that was left out.",
        "The notebook has 295 more such oddities.",
    ]


def test_all_is_found_by_text_and_place_among_cells_of_the_students_own():
    def damage(notebook):
        nameless(notebook)
        notebook["cells"].insert(20, own("x = 1"))
        notebook["cells"].insert(5, own("y = 1", id="beef"))

    result = rebuilt(damage)
    kept = [cell for cell in result.notebook.cells if cell.id not in ("f00d", "beef")]
    assert kept == SOLVED.cells
    assert (result.notebook.cells[5].id, result.notebook.cells[20 + 1].id) == ("beef", "f00d")
    assert result.repairs == [BY_LOOK]


def test_words_and_own_cells_stay_where_the_student_had_them():
    def damage(notebook):
        notebook["cells"].insert(2, notebook["cells"].pop(position(notebook, "counter-task")))
        notebook["cells"].insert(position(notebook, "hello"), own("x = 1"))

    ids = [cell.id for cell in SOLVED.cells]
    ids.insert(2, ids.pop(ids.index("counter-task")))
    ids.insert(ids.index("hello"), "f00d")
    result = rebuilt(damage)
    assert [cell.id for cell in result.notebook.cells] == ids
    assert (result.repairs, result.flags) == ([], [])


def move(name, where):
    return lambda notebook: notebook["cells"].insert(where, notebook["cells"].pop(position(notebook, name)))


@pytest.mark.parametrize(
    ("name", "where"),
    [
        ("setup", 100),
        ("hello", 100),
        ("hello-points", 0),
        ("counter", 2),
        ("main-given", 100),
        ("hello-see", 9),
    ],
)
def test_a_cell_that_has_left_its_place_runs_there(name, where):
    result = rebuilt(move(name, where))
    assert [cell.id for cell in result.notebook.cells] == [cell.id for cell in SOLVED.cells]
    assert result.repairs == [f"The cell `{name}` was not in its place in the assignment; it was run there."]


def test_a_missing_cell_has_its_place_though_words_have_left_their_own():
    def damage(notebook):
        move("counter-task", 1)(notebook)
        delete("hello-points", "setup")(notebook)

    result = rebuilt(damage)
    assert [cell.id for cell in result.notebook.cells] == [cell.id for cell in SOLVED.cells]


def test_a_notebook_from_back_to_front_runs_as_it_was_handed_out():
    def damage(notebook):
        notebook["cells"].insert(position(notebook, "counter") + 1, own("x = 1"))
        notebook["cells"].reverse()

    result = rebuilt(damage)
    ids = [cell.id for cell in SOLVED.cells]
    ids.insert(ids.index("counter"), "f00d")
    assert [cell.id for cell in result.notebook.cells] == ids
    assert result.repairs == [
        "The cells `hello`, `hello-see`, `hello-points`, `counter`, `counter-see` and 16 more were not in "
        "their places in the assignment; they were run there."
    ]


def test_own_cells_run_before_a_test_that_was_deleted_behind_them():
    def damage(notebook):
        notebook["cells"][position(notebook, "hello-points")] = own("print('done')")

    ids = [cell.id for cell in rebuilt(damage).notebook.cells]
    assert ids.index("f00d") + 1 == ids.index("hello-points")


def test_characters_that_no_file_can_hold_are_replaced():
    def damage(notebook):
        cell(notebook, "hello")["source"] = "name = 'half: \ud800, zero: \0'"

    answer = next(cell for cell in rebuilt(damage).notebook.cells if cell.id == "hello")
    assert answer.source == "name = 'half: ?, zero: '"
