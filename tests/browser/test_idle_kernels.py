"""A hub's server ends kernels in which nothing runs, but none with a robot that moves or a cell that runs."""
from collections.abc import Iterator

import pytest

from grader.marking.extras.hub.server_environment import server_arguments
from tests.browser.lab import Lab, copy_for_students, server, write_notebook
from tests.patience import PATIENCE, until

pytestmark = [pytest.mark.soak, pytest.mark.browser]
MINUTES = 0.5
SHOWS = "name => window.notebook()?.context.path === `course/${name}.ipynb`"
CELL_RUNS = "() => window.notebook().content.model.cells.get(0).executionState === 'running'"
CELLS = {
    "idle": ["answer = 41", "answer + 1"],
    "robot": ["from sim import play\nplayer = play(world='room', seconds=100_000)"],
    "busy": ["import threading\nthreading.Event().wait()"],
}


@pytest.fixture
def hub_lab(browser, tmp_path) -> Iterator[Lab]:
    """JupyterLab as a hub starts it, but for the time; with a notebook for each of `CELLS`."""
    folder = copy_for_students(tmp_path)
    for name, cells in CELLS.items():
        write_notebook(folder / "course" / f"{name}.ipynb", *cells)
    with server(folder, *server_arguments(MINUTES)) as address:
        page = browser.new_page()
        yield Lab(page, address)
        page.close()


def run_by_keys(lab: Lab, index: int) -> None:
    """Run a cell of the notebook that shows; a command could still mean the one that showed before."""
    lab.cell(index).locator(".cm-content").click()
    lab.page.keyboard.press("Control+Enter")


def test_an_idle_kernel_ends_and_the_next_cell_starts_a_new_one(hub_lab):
    def with_kernel() -> set[str]:
        sessions = hub_lab.page.request.get(f"{hub_lab.address}/api/sessions", timeout=PATIENCE * 1000)
        return {session["path"].removeprefix("course/").removesuffix(".ipynb") for session in sessions.json()}

    for name in ("robot", "busy", "idle"):
        hub_lab.turn_to(f"course/{name}.ipynb")
        hub_lab.page.wait_for_function(SHOWS, arg=name)
        run_by_keys(hub_lab, 0)
        hub_lab.page.wait_for_function(CELL_RUNS) if name == "busy" else hub_lab.wait_for_cell(0)
    until(lambda: "idle" not in with_kernel())
    assert with_kernel() == {"robot", "busy"}
    hub_lab.page.locator(".jp-NotebookPanel:not(.lm-mod-hidden)", has_text="No Kernel").wait_for()
    hub_lab.screenshot("idle_kernel")
    run_by_keys(hub_lab, 1)
    hub_lab.wait_for_cell(1)
    assert hub_lab.outputs(1)[0]["ename"] == "NameError"
    assert with_kernel() == {"robot", "busy", "idle"}
