"""What ran and what stands there: the page tells the kernel, so that nothing old is judged or shown."""

import nbformat
import pytest

from tests.browser.lab import write_notebook
from tests.patience import until

pytestmark = pytest.mark.browser
SETUP = """
from rclpy.node import Node
from std_msgs.msg import String
from grader.exercises import topics
from sim import play, run
"""
ANSWER = """
class Greeter(Node):
    def __init__(self):
        super().__init__("greeter")
        self.publisher = self.create_publisher(String, "/greeting", 10)
        self.create_timer(0.5, self.greet)

    def greet(self):
        self.publisher.publish(String(data="Hello!"))
"""
SEE = "run(Greeter, seconds=2).ended.reason"
CHECK = "topics.greeting.grade(Greeter)"
EDIT = """([index, text]) => window.notebook().content.model.cells.get(index).sharedModel.setSource(text)"""
CHANGED = "the cell with Greeter was changed, and has not run since"


@pytest.fixture
def greeter(request, students_folder, open_lab):
    """JupyterLab with a notebook of four cells, none run: set-up, answer, see it, check."""
    name = f"cells/{request.node.originalname}.ipynb"
    write_notebook(students_folder / name, SETUP, ANSWER, SEE, CHECK)
    with open_lab(name) as lab:
        yield lab


def says(lab, index: int) -> str:
    """Run a cell, and return the text of its first output."""
    lab.run_cell(index)
    output = lab.outputs(index)[0]  # behind it may be pictures
    if output["output_type"] == "error":
        return "\n".join(output["traceback"])
    data = output["data"]
    return data["text/html"] if "text/html" in data else data["text/plain"]


def test_an_edit_that_was_not_run_is_not_judged_and_neither_is_what_was_before(greeter):
    lab = greeter
    lab.run_all()
    assert "8 of 8 points" in lab.output()
    lab.page.evaluate(EDIT, [1, ANSWER.replace("0.5", "5.0")])
    assert says(lab, 2) == (
        f"Your last version did not run: {CHANGED}. Run that cell (Shift+Enter); then run this one again."
    )
    judged = says(lab, 3)
    assert "0 of 8 points" in judged and "Your last version did not run." in judged and CHANGED in judged
    lab.cell(3).evaluate("cell => cell.scrollIntoView({block: 'center'})")
    lab.screenshot("last-version")
    lab.run_cell(1)
    assert says(lab, 2) == "'time'"
    assert "5 of 8 points" in says(lab, 3)


def test_a_comment_changes_nothing(greeter):
    greeter.run_all()
    greeter.page.evaluate(EDIT, [1, f"# mine\n\n{ANSWER}"])
    assert "8 of 8 points" in says(greeter, 3)


def test_a_page_that_is_loaded_again_tells_of_edits_too(greeter):
    greeter.run_all()
    greeter.save()
    greeter.page.reload()
    greeter.wait_for_kernel()
    assert "8 of 8 points" in says(greeter, 3)
    greeter.page.evaluate(EDIT, [1, ANSWER.replace("0.5", "5.0")])
    assert CHANGED in says(greeter, 3)


def test_a_restarted_kernel_has_to_run_what_is_above(greeter):
    lab = greeter
    lab.run_all()
    lab.page.evaluate("window.notebook().sessionContext.session.kernel.restart()")
    lab.wait_for_kernel()
    assert says(lab, 3) == (
        "NameError: A cell above defines `topics`, and it has not run: "
        "choose Run > Run All Above Selected Cell, then run this cell again."
    )
    lab.cell(3).evaluate("cell => cell.scrollIntoView({block: 'center'})")
    lab.screenshot("after-a-restart")
    lab.run_cell(0)
    assert "defines `Greeter`, and it has not run" in says(lab, 2)
    lab.page.evaluate(EDIT, [1, ANSWER.replace("):", ")", 1)])
    lab.run_cell(1)
    assert says(lab, 3) == (
        "NameError: The cell above that defines `Greeter` ended with SyntaxError: expected ':' (line 1). "
        "Fix that cell and run it first."
    )
    lab.page.evaluate(EDIT, [1, ANSWER])
    lab.run_cell(1)
    assert "8 of 8 points" in says(lab, 3)


def test_an_interrupted_run_says_so_in_one_line(greeter, students_folder):
    lab = greeter
    lab.run_cell(0)
    lab.run_cell(1)
    lab.page.evaluate(EDIT, [2, "run(Greeter, seconds=100_000, until=lambda _: open('begun', 'w').close())"])
    lab.run_cell(2, wait=False)
    until((students_folder / "cells" / "begun").exists, "the run")
    lab.page.evaluate("window.notebook().sessionContext.session.kernel.interrupt()")
    lab.wait_for_cell(2)
    (output,) = lab.outputs(2)
    assert output["traceback"] == ["KeyboardInterrupt: The run was interrupted."]


def test_an_endless_loop_that_prints_leaves_the_page_usable_and_is_interrupted(students_folder, open_lab):
    name = "cells/endless.ipynb"
    write_notebook(students_folder / name, "while True: print('OK')", "'after'")
    with open_lab(name) as lab:
        lab.run_cell(0, wait=False)
        lab.cell(0).locator(".jp-OutputArea-output", has_text="■ stops the cell").wait_for()
        lab.screenshot("endless-loop")
        lab.command("notebook:interrupt-kernel")
        lab.wait_for_cell(0)
        texts = ["".join(output.get("text", "")) for output in lab.outputs(0)]
        assert sum(map(len, texts)) < 10_000
        assert any(text.startswith("... and ") and text.endswith(" more lines.\n") for text in texts)
        assert says(lab, 1) == "'after'"


MODULE = "%%writefile my_greeting.py\nTEXT = 'Hello!'\n"
USES_MODULE = f"import importlib\nimport my_greeting\nimportlib.reload(my_greeting)\n{ANSWER}".replace(
    '"Hello!"', "my_greeting.TEXT"
)


def test_a_module_that_was_changed_and_not_written_or_not_reloaded_is_not_judged(students_folder, open_lab):
    name = "cells/module.ipynb"
    write_notebook(students_folder / name, SETUP, MODULE, USES_MODULE, CHECK)
    with open_lab(name) as lab:
        lab.run_all()
        assert "8 of 8 points" in lab.output()
        lab.page.evaluate(EDIT, [1, MODULE.replace("!", "")])
        judged = says(lab, 3)
        assert "0 of 8 points" in judged
        assert "the cell that writes my_greeting.py was changed, and has not run since" in judged
        lab.run_cell(1)
        assert "the module has not been reloaded since" in says(lab, 3)
        lab.run_cell(2)
        assert "8 of 8 points" in says(lab, 3)  # a greeting is any text


def test_the_checks_of_a_notebook_that_is_run_whole_are_saved_without_a_question(students_folder, open_lab):
    name = "cells/many_checks.ipynb"
    write_notebook(students_folder / name, SETUP, ANSWER, *[CHECK] * 8)
    notebook = nbformat.read(students_folder / name, 4)
    for number, cell in enumerate(notebook.cells[2:]):
        cell.metadata["nbgrader"] = {"grade": True, "grade_id": f"check-{number}", "points": 8}
    nbformat.write(notebook, students_folder / name)
    with open_lab(name) as lab:
        for _ in range(3):
            lab.run_all()
            until(lambda: _all_have_points(students_folder / name), "the saved points")
            assert lab.page.locator(".jp-Dialog").count() == 0


def _all_have_points(path):
    try:
        checks = nbformat.read(path, 4).cells[2:]
    except ValueError:
        return False  # it is being saved
    return all(any(output.output_type == "execute_result" for output in cell.outputs) for cell in checks)
