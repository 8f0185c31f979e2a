"""A day on a hub, by clicks alone: two teachers release, mark and return feedback; three students submit.

One of them is right, one is half right, and one is hostile.
"""

import json
from collections.abc import Iterator

import nbformat
import pytest
from playwright.sync_api import Browser, Page

from tests.browser.lab import ARTIFACTS, ROOT
from tests.browser.pictures import patient_page
from tests.marking.extras.hub.real_hub import COURSE, RealHub, real_hub, reason_to_skip
from tests.patience import until

ASSIGNMENT = "01_nodes"
NOTEBOOK = f"exercises/{ASSIGNMENT}/nodes.ipynb"
STUDENTS = ANNA, BOB, CAROL = "hubtest-00", "hubtest-01", "hubtest-02"
INES, TOM = "hubtest-ines", "hubtest-tom"
DIALOG = ".modal.in"
SCROLL_ON = """area => {
    const isAtEnd = area.scrollTop + area.clientHeight >= area.scrollHeight - 1;
    area.scrollTo(0, isAtEnd ? 0 : area.scrollTop + 300);
}"""

pytestmark = [
    pytest.mark.soak,
    pytest.mark.browser,
    pytest.mark.skipif(bool(reason_to_skip()), reason=reason_to_skip()),
]


@pytest.fixture(scope="module")
def hub() -> Iterator[RealHub]:
    with real_hub(len(STUDENTS)) as running:
        yield running


class Visitor:
    """A person with a browser of their own."""

    def __init__(self, browser: Browser, hub: RealHub, name: str) -> None:
        self.page = patient_page(browser, viewport={"width": 1440, "height": 900})
        self.hub, self.name = hub, name

    def log_in(self, path: str) -> Page:
        """Go to an address of the hub, by way of its login."""
        self.page.goto(f"{self.hub.address}{path}")
        self.page.fill("#username_input", self.name)
        self.page.fill("#password_input", self.hub.passwords[self.name])
        self.page.click("#login_submit")
        return self.page

    def photograph(self, what: str) -> None:
        """Save a picture of what shows."""
        self.page.screenshot(path=ARTIFACTS / f"hub_{what}_{self.name}.png")


class Student(Visitor):
    """Works in JupyterLab."""

    def arrive(self) -> None:
        """Log in, and see the map of the course."""
        self.log_in("/hub/")
        self.page.locator("#ros2-course-start a").first.wait_for()
        self.photograph("start")

    def answer(self, answers: dict[str, str]) -> None:
        """Open the assignment and replace these cells' text, by their ids; then save."""
        address = f"{self.hub.address}/user/{self.name}/lab/tree/{NOTEBOOK}"
        self.page.goto(address)
        panel = self.page.locator(".jp-NotebookPanel:not(.lm-mod-hidden)")
        panel.locator(".jp-Notebook .jp-Cell").first.wait_for()
        for text, replacement in answers.items():
            self._replace(text, replacement)
        self.page.keyboard.press("Control+s")
        self.page.locator(".lm-TabBar-tab.jp-mod-dirty").wait_for(state="detached")

    def _replace(self, text: str, replacement: str) -> None:
        """Find a cell by its first line, as a reader does: by scrolling."""
        scroller = self.page.locator(".jp-NotebookPanel:not(.lm-mod-hidden) .jp-WindowedPanel-outer")
        scroller.evaluate("area => area.scrollTo(0, 0)")
        first = text.strip().splitlines()[0]
        cell = self.page.locator(".jp-CodeCell", has_text=first).first
        # Lab draws what comes into sight, on a busy machine late: from the end it goes on at the top.
        until(lambda: cell.count() or scroller.evaluate(SCROLL_ON) or self.page.wait_for_timeout(50), first)
        cell.locator(".cm-content").click()
        self.page.keyboard.press("Control+a")
        self.page.keyboard.insert_text(replacement)

    def validate(self) -> str:
        """Click Validate, wait for the last row, and return the dialog's text."""
        self.page.locator(".validate-button").first.click()
        dialog = self.page.locator(".jp-Dialog", has_text="Validation Results")
        dialog.locator("tbody tr").first.wait_for()
        dialog.locator("p[role='status']:empty").wait_for(state="attached")
        self.photograph("validate")
        text = dialog.inner_text()
        dialog.locator("button.jp-mod-accept").click()
        return text

    def open_assignments(self) -> None:
        """Open nbgrader's list of assignments, from its menu."""
        self.page.locator(".lm-MenuBar-item", has_text="Nbgrader").click()
        self.page.locator(".lm-Menu-item", has_text="Assignment List").click()
        self.page.locator("#fetched_assignments_list .list_item", has_text=ASSIGNMENT).first.wait_for()

    def submit(self) -> None:
        """Click Submit in the list."""
        self.open_assignments()
        row = self.page.locator("#fetched_assignments_list .list_item", has_text=ASSIGNMENT).first
        row.get_by_role("button", name="Submit").click()
        self.page.locator("#submitted_assignments_list .list_item", has_text=ASSIGNMENT).first.wait_for()
        self.photograph("submitted")

    def fetch_feedback(self) -> str:
        """Click Fetch Feedback, open the page, and return its text."""
        self.page.locator("#refresh_assignments_list").click()
        row = self.page.locator("#submitted_assignments_list .list_item", has_text=ASSIGNMENT).first
        row.get_by_role("button", name="Fetch Feedback").click()
        listed = f"assignments?course_id={COURSE}"
        found = self.page.request.get(f"{self.hub.address}/user/{self.name}/{listed}").json()
        folder = found["value"][-1]["submissions"][0]["local_feedback_path"]
        self.page.goto(f"{self.hub.address}/user/{self.name}/files/{folder}/nodes.html")
        self.photograph("feedback")
        return self.page.locator("body").inner_text()


class Teacher(Visitor):
    """Uses the formgrader, in a tab of its own."""

    def open_formgrader(self) -> None:
        """Log in at the address of the course."""
        self.log_in(f"/services/{COURSE}/formgrader/manage_assignments")
        self.page.locator("tr", has_text=ASSIGNMENT).first.wait_for()

    def click(self, icon: str) -> str:
        """Click an icon in the assignment's row; returns what the dialog says when it is done."""
        self.page.goto(f"{self.hub.address}/services/{COURSE}/formgrader/manage_assignments")
        row = self.page.locator("tr", has_text=ASSIGNMENT).first
        row.locator(f".glyphicon-{icon}").click()
        return self._dismissed()

    def mark(self, student: str) -> str:
        """Click Autograde in a student's row."""
        self.page.goto(f"{self.hub.address}/services/{COURSE}/formgrader/manage_submissions/{ASSIGNMENT}")
        row = self.page.locator("tr", has_text=student).first
        row.locator(".glyphicon-flash").click()
        return self._dismissed()

    def _dismissed(self) -> str:
        dialog = self.page.locator(DIALOG)
        dialog.locator("button").last.wait_for()
        text = dialog.inner_text()
        self.photograph("dialog")
        dialog.locator("button").last.click()
        dialog.wait_for(state="detached")
        return text


def answers(only: int | None = None) -> dict[str, str]:
    """The cells to fill in, and what to write there; the first ones only."""
    given = nbformat.read(ROOT / NOTEBOOK, 4).cells
    solution = nbformat.read(ROOT / "solutions" / ASSIGNMENT / "nodes.ipynb", 4).cells
    solved = {cell.id: cell.source for cell in solution}
    every = {cell.source: solved[cell.id] for cell in given if cell.cell_type == "code"}
    return dict([item for item in every.items() if item[0] != item[1]][:only])


SECRET = "the-secret-of-this-class"
HOSTILE = """
import contextlib, glob, os, signal
type(nodes.hello).grade = lambda exercise, *programs: 100
for path in glob.glob("/srv/*/courses/*/course/.secret"):
    print(open(path).read())
print(glob.glob("/home/*"), glob.glob("/srv/*/courses/*/course/class/*"))
for process in range(2, 100_000):
    with contextlib.suppress(OSError):
        os.kill(process, signal.SIGKILL)
Hello = Counter = Battery = Heart = main = None
"""


def test_a_day_from_the_release_to_the_feedback(browser, hub):
    ines, tom = (Teacher(browser, hub, name) for name in (INES, TOM))
    students = {name: Student(browser, hub, name) for name in STUDENTS}
    ines.open_formgrader()
    assert "released" in ines.click("cloud-upload")
    hub.as_grader("sh", "-c", f"umask 077; echo {SECRET} > .secret")
    for name, given in ((ANNA, answers()), (BOB, answers(3)), (CAROL, {next(iter(answers())): HOSTILE})):
        students[name].arrive()
        students[name].answer(given)
    assert "100" in students[ANNA].validate()
    for student in students.values():
        student.submit()
    tom.open_formgrader()
    assert "collect" in tom.click("cloud-download").lower()
    for name in STUDENTS:
        assert "graded" in tom.mark(name)
    tom.photograph("marked")
    assert "feedback" in ines.click("comment").lower()
    assert "feedback" in ines.click("envelope").lower()
    pages = {name: student.fetch_feedback() for name, student in students.items()}
    rows = json.loads(hub.as_grader("python", "-c", POINTS))
    assert rows[ANNA] == 100
    assert rows[BOB] == 45  # the first three of six
    assert rows[CAROL] == 0  # who would like to have 100, the secret, and no other process
    for name, page in pages.items():
        assert [other for other in STUDENTS if other in page] in ([name], [])
        assert f"{rows[name]:g}" in page
        assert SECRET not in page


POINTS = (
    "import json; from nbgrader.api import Gradebook; book = Gradebook('sqlite:///class/gradebook.db');"
    f"found = book.assignment_submissions('{ASSIGNMENT}');"
    "print(json.dumps({each.student.id: each.score for each in found}))"
)
