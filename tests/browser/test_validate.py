"""Validate shows all checks at once, results as they arrive, and the total at the end."""

import re

import pytest

from tests.browser.lab import write_notebook

pytestmark = pytest.mark.browser
SLOW = "import os, time\nwhile not os.path.exists({!r}): time.sleep(0.1)\n1.5"
GRADE = """([index, points]) => {
    const cell = window.notebook().content.model.cells.get(index);
    const grade_id = `check-${index}`;
    cell.setMetadata('nbgrader', {grade: true, points, grade_id, locked: true, schema_version: 3});
}"""

SET_FIRST = "text => window.notebook().content.model.cells.get(0).sharedModel.setSource(text)"


@pytest.fixture
def checked(students_folder, open_lab):
    """A notebook with a quick check and one that waits for a file, of 2 points each."""
    go = students_folder / "validate" / "go"
    write_notebook(go.with_name("two.ipynb"), "x = 1", "2.0", SLOW.format(str(go)))
    with open_lab("validate/two.ipynb") as lab:
        for index in (1, 2):
            lab.page.evaluate(GRADE, [index, 2])
        yield lab


def rows(dialog):
    return [" | ".join(row.locator("th, td").all_inner_texts()) for row in dialog.locator("tr").all()][1:]


def test_rows_come_as_they_arrive_and_the_total_at_the_end(checked, students_folder):
    checked.page.locator(".validate-button").first.click()
    dialog = checked.page.locator(".jp-Dialog", has_text="Validation Results")
    dialog.locator("td", has_text="2 of 2").wait_for()
    assert len(rows(dialog)) == 2  # and no total
    assert rows(dialog)[0] == " | 2 of 2 | ✔"
    dialog.locator("td", has_text=re.compile(r"^runs, [1-9]\d* s$")).wait_for()
    assert dialog.locator("p[role='status']").inner_text().startswith("Check 2 of 2: ")
    checked.screenshot("validate-running")
    (students_folder / "validate" / "go").touch()
    dialog.locator("tfoot tr").wait_for()
    assert rows(dialog) == [
        " | 2 of 2 | ✔",
        " | 1.5 of 2 | in part: run its check to see why",
        "Total | 3.5 of 4 | ",
    ]
    assert dialog.locator("caption").inner_text() == "Points of each check"
    assert dialog.locator("th[scope='col']").count() == 3
    dialog.locator("button.jp-mod-accept").click()


def test_a_slow_cell_before_a_check_is_named_with_its_time(checked, students_folder):
    folder = students_folder / "validate"
    checked.page.evaluate(SET_FIRST, SLOW.format(str(folder / "on")))
    (folder / "go").touch()
    checked.page.locator(".validate-button").first.click()
    dialog = checked.page.locator(".jp-Dialog", has_text="Validation Results")
    dialog.locator("p[role='status']", has_text="Cell [1]: import os, time ...").wait_for()
    dialog.locator("p[aria-hidden]", has_text=re.compile(r"^runs, [1-9]\d* s$")).wait_for()
    checked.screenshot("validate-slow-cell")
    (folder / "on").touch()
    dialog.locator("tfoot tr").wait_for()
    assert dialog.locator("p[aria-hidden]").inner_text() == ""
    dialog.locator("button.jp-mod-accept").click()


def test_a_check_that_runs_saves_the_notebook(checked):
    assert checked.page.evaluate("window.notebook().context.model.dirty")
    checked.run_cell(0)
    assert checked.page.evaluate("window.notebook().context.model.dirty")
    checked.page.evaluate(
        "window.savedTimes = 0; window.notebook().context.saveState.connect((_, state) => {"
        " if (state === 'completed') window.savedTimes += 1; })"
    )
    checked.run_cell(1)
    checked.page.wait_for_function("window.savedTimes >= 1")
