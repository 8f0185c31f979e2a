import pytest

from sim.notebook.cell_history import CellHistory, OutdatedName

ROBOT = "class Robot:\n    def turn(self):\n        return turns()\n"
TURNS = "def turns():\n    return 1\n"
BROKEN = "class Robot\n    pass\n"


class Notebook:
    """Cells that run as in a kernel, and a page that shows them."""

    def __init__(self) -> None:
        self.namespace = {"__name__": "__main__"}
        self.cells = CellHistory(self.namespace)
        self.texts = {}

    def run(self, cell: str, source: str) -> None:
        self.texts[cell] = source
        self.send_page()
        self.cells.begin(cell, source)
        try:
            exec(source, self.namespace)
        except Exception as error:
            self.cells.end(cell, source, type(error).__name__)
        else:
            self.cells.end(cell, source, "")

    def edit(self, cell: str, source: str) -> None:
        self.texts[cell] = source
        self.send_page()

    def send_page(self) -> None:
        self.cells.update(list(self.texts), self.texts)

    def outdated(self, name: str) -> OutdatedName | None:
        return self.cells.outdated([self.namespace[name]])


@pytest.fixture
def notebook():
    notebook = Notebook()
    notebook.run("helper", TURNS)
    notebook.run("answer", ROBOT)
    return notebook


def test_code_that_ran_as_shown_is_not_outdated(notebook):
    assert notebook.outdated("Robot") is None


@pytest.mark.parametrize("source", [BROKEN, "1 / 0\n" + ROBOT])
def test_a_cell_that_failed_leaves_its_names_outdated_until_it_runs(notebook, source):
    notebook.run("answer", source)
    found = notebook.outdated("Robot")
    assert found == OutdatedName("Robot", "SyntaxError" if source == BROKEN else "ZeroDivisionError")
    assert found.saw == f"the cell with Robot ended with {found.error}"
    assert found.hint == "Fix that cell and run it; then run this one again."
    notebook.run("answer", ROBOT)
    assert notebook.outdated("Robot") is None


def test_a_try_in_another_cell_counts_too(notebook):
    notebook.run("second try", BROKEN)
    assert notebook.outdated("Robot") == OutdatedName("Robot", "SyntaxError")


def test_a_class_that_was_made_before_its_cell_failed_is_the_newest(notebook):
    notebook.run("answer", f"{ROBOT}\n1 / 0")
    assert notebook.outdated("Robot") is None


def test_an_edit_that_did_not_run_is_seen(notebook):
    notebook.edit("answer", ROBOT.replace("return", "return 2 *"))
    found = notebook.outdated("Robot")
    assert found == OutdatedName("Robot")
    assert found.saw == "the cell with Robot was changed, and has not run since"
    assert found.hint == "Run that cell (Shift+Enter); then run this one again."


def test_what_a_class_calls_is_looked_at_too(notebook):
    notebook.edit("helper", TURNS.replace("1", "2"))
    assert notebook.outdated("Robot") == OutdatedName("turns")
    assert notebook.cells.outdated([lambda: notebook.namespace["Robot"]]) is None


def test_a_value_made_from_a_class_is_known_by_its_name(notebook):
    notebook.run("two", "pair = (Robot, 2)")
    notebook.edit("two", "pair = (Robot, 3)")
    assert notebook.outdated("pair") == OutdatedName("pair")


def test_deleted_cells_and_other_cells_are_not_outdated(notebook):
    notebook.run("other", "speed = 1")
    notebook.edit("other", "speed = 2")
    del notebook.texts["answer"]
    notebook.send_page()
    assert notebook.outdated("Robot") is None


def test_a_missing_name_that_a_cell_above_defines_is_explained(notebook):
    fresh = CellHistory({})
    fresh.update(["helper", "answer", "use"], {"helper": TURNS, "answer": BROKEN, "use": "later = 1"})
    fresh.begin("use", "turns()")
    assert fresh.explain_missing("turns") == (
        "A cell above defines `turns`, and it has not run: "
        "choose Run > Run All Above Selected Cell, then run this cell again."
    )
    fresh.end("answer", BROKEN, "SyntaxError: expected ':' (line 1)")
    assert fresh.explain_missing("Robot") == (
        "The cell above that defines `Robot` ended with SyntaxError: expected ':' (line 1). "
        "Fix that cell and run it first."
    )
    assert fresh.explain_missing("later") == fresh.explain_missing("nowhere") == ""


def test_a_name_that_is_nearly_a_defined_one_is_suggested(notebook):
    assert notebook.cells.suggest("Robbot") == "There is no `Robbot`. Did you mean `Robot`?"
    assert notebook.cells.suggest("Rob") == notebook.cells.suggest("elsewhere") == ""


def test_without_a_page_the_notebooks_file_is_read(notebook):
    fresh = CellHistory({})
    assert fresh.explain_missing("turns") == ""
    assert "has not run" in fresh.explain_missing("turns", ["helper"], {"helper": TURNS})
