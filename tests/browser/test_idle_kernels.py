"""Servers end kernels in which nothing runs, but none with a robot that moves or a cell that runs."""
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from grader.marking.extras.hub.server_environment import server_arguments
from tests.browser.lab import Lab, copy_for_students, server, write_notebook
from tests.patience import PATIENCE, until

pytestmark = [pytest.mark.soak, pytest.mark.browser]
MINUTES = 0.5
SHOWS = "name => window.notebook()?.context.path === `course/${name}.ipynb`"
CELL_RUNS = "() => window.notebook().content.model.cells.get(0).executionState === 'running'"
CLOSE_OTHERS = """path => {
    for (const widget of [...window.jupyterapp.shell.widgets('main')]) {
        if (!widget.context || widget.context.path === path) continue;
        widget.context.model.dirty = false;
        widget.close();
    }
}"""
CELLS = {
    "idle": ["answer = 41", "answer + 1"],
    "open": ["answer = 41"],
    "robot": ["from sim import play\nplayer = play(world='room', seconds=100_000)"],
    "busy": ["import threading\nthreading.Event().wait()"],
}


@contextmanager
def opened(browser, folder, *options: str) -> Iterator[Lab]:
    """JupyterLab with these options, and a notebook for each of `CELLS`."""
    copy_for_students(folder)
    for name, cells in CELLS.items():
        write_notebook(folder / "course" / f"{name}.ipynb", *cells)
    with server(folder, *options) as address:
        page = browser.new_page()
        yield Lab(page, address)
        page.close()


@pytest.fixture
def hub_lab(browser, tmp_path) -> Iterator[Lab]:
    """JupyterLab as a hub starts it, but for the time."""
    with opened(browser, tmp_path, *server_arguments(MINUTES)) as lab:
        yield lab


@pytest.fixture
def students_lab(browser, tmp_path) -> Iterator[Lab]:
    """JupyterLab as `make lab` starts it, but for the time."""
    with opened(browser, tmp_path, f"--MappingKernelManager.cull_idle_timeout={60 * MINUTES:g}",
                "--MappingKernelManager.cull_interval=10") as lab:
        yield lab


def with_kernel(lab: Lab) -> set[str]:
    """The notebooks that have a kernel."""
    sessions = lab.page.request.get(f"{lab.address}/api/sessions", timeout=PATIENCE * 1000)
    return {session["path"].removeprefix("course/").removesuffix(".ipynb") for session in sessions.json()}


def run_in_each(lab: Lab) -> None:
    """Run the first cell of each notebook, that of `idle` last."""
    for name in ("robot", "busy", "idle"):
        lab.turn_to(f"course/{name}.ipynb")
        lab.wait(SHOWS, arg=name)
        run_by_keys(lab, 0)
        lab.wait(CELL_RUNS) if name == "busy" else lab.wait_for_cell(0)


def run_by_keys(lab: Lab, index: int) -> None:
    """Run a cell of the notebook that shows; a command could still mean the one that showed before."""
    lab.cell(index).locator(".cm-content").click()
    lab.page.keyboard.press("Control+Enter")


def test_a_closed_notebooks_idle_kernel_ends_while_an_open_ones_stays(students_lab):
    run_in_each(students_lab)
    students_lab.turn_to("course/open.ipynb")
    students_lab.wait(SHOWS, arg="open")
    run_by_keys(students_lab, 0)
    students_lab.wait_for_cell(0)
    students_lab.page.evaluate(CLOSE_OTHERS, "course/open.ipynb")
    until(lambda: "idle" not in with_kernel(students_lab))
    assert with_kernel(students_lab) == {"robot", "busy", "open"}


def test_an_idle_kernel_ends_and_the_next_cell_starts_a_new_one(hub_lab):
    run_in_each(hub_lab)
    until(lambda: "idle" not in with_kernel(hub_lab))
    assert with_kernel(hub_lab) == {"robot", "busy"}
    hub_lab.page.locator(".jp-NotebookPanel:not(.lm-mod-hidden)", has_text="No Kernel").wait_for()
    hub_lab.screenshot("idle_kernel")
    run_by_keys(hub_lab, 1)
    hub_lab.wait_for_cell(1)
    assert hub_lab.outputs(1)[0]["ename"] == "NameError"
    assert with_kernel(hub_lab) == {"robot", "busy", "idle"}
