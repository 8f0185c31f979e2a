"""JupyterLab as students see it: a real server with their configuration, driven in Chromium."""

import json
import os
import shutil
import subprocess
import sys
import urllib.request
import uuid
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import nbformat
from playwright.sync_api import Locator, Page

from tests.patience import PATIENCE, until
from tests.ports import free_port

ROOT = Path(__file__).parents[2]
ARTIFACTS = ROOT / "test-artifacts"
ASKED = 100  # ms; Playwright would ask with each frame, and a large notebook do nothing but answer
STUDENTS_FILES = ("course", "exercises", "jupyter", "nbgrader_config.py")
SHOWN = ".jp-NotebookPanel:not(.lm-mod-hidden)"  # Lab may still hold one that a test before has closed
START = ".ros2-course-start:not(.lm-mod-hidden)"  # the start page, as it shows
# The notebook that shows: beside it may be the panel with its robot, which then is Lab's current widget.
NOTEBOOK = """window.notebook = () => [...window.jupyterapp.shell.widgets('main')].find(
    panel => panel.content?.model?.cells && panel.isVisible);"""
KERNEL_READY = """async () => {
    const panel = window.notebook();
    await panel.context.ready;
    await panel.sessionContext.ready;
    await panel.sessionContext.session.kernel.info;
}"""
OPEN = """async path => {
    await window.jupyterapp.restored;
    const panel = await window.jupyterapp.commands.execute('docmanager:open', {path});
    panel.context.saveState.connect((_, state) => { panel.isSaving = state === 'started'; });
}"""
# Without its result: some give a widget, which has too many parts to be sent here.
COMMAND = """async ([name, given]) => {
    await window.jupyterapp.commands.execute(name, given);
}"""
LOADED_AGAIN = "performance.getEntriesByType('navigation')[0].type === 'reload'"
# Without a question whether to save: a notebook that was run is changed. One that is being saved is awaited:
# otherwise JupyterLab shows "File Save Error" over the next test's.
CLOSE_ALL = """async () => {
    const shown = [...window.jupyterapp.shell.widgets('main')];
    while (shown.some(widget => widget.isSaving)) await new Promise(done => setTimeout(done, 20));
    for (const widget of shown) {
        if (widget.context) widget.context.model.dirty = false;
        if (!widget.isDisposed) widget.close();
    }
}"""
# By the session and not by its sign, which a narrow toolbar hides.
KERNEL_IDLE = "() => window.notebook()?.sessionContext.kernelDisplayStatus === 'idle'"
# In the order of the cells: each has a count, up to one whose output is an error.
ALL_CELLS_DONE = """() => {
    for (const cell of window.notebook().content.model.cells) {
        if (cell.type !== 'code' || !cell.sharedModel.getSource().trim()) continue;
        if (cell.executionCount === null || cell.executionState === 'running') return false;
        if (cell.outputs.toJSON().some(output => output.output_type === 'error')) return true;
    }
    return true;
}"""
# Of the cells that are on the page. What an output contains is drawn later than the output itself.
ALL_OUTPUTS_DRAWN = """() => window.notebook().content.widgets.every(cell =>
    !cell.outputArea || cell.isPlaceholder?.() || !cell.isAttached
    || cell.outputArea.widgets.length >= cell.model.outputs.length
    && [...cell.node.querySelectorAll('.jp-OutputArea-output')].every(output => output.hasChildNodes()))"""

RUN_CELL = """index => {
    const panel = window.notebook();
    panel.content.model.cells.get(index).executionCount = null;  // that of the run before
    panel.content.activeCellIndex = index;
    panel.content.deselectAll();
    window.jupyterapp.commands.execute('notebook:run-cell');
}"""
CELL_DONE = """index => {
    const cell = window.notebook().content.model.cells.get(index);
    return cell.executionCount !== null && cell.executionState === 'idle';
}"""
# Beside the notebook: it is no cell, so nothing of it shows.
ASK = """async code => {
    const kernel = window.notebook().sessionContext.session.kernel;
    let said = '';
    const future = kernel.requestExecute({code, store_history: false, stop_on_error: false});
    future.onIOPub = ({content, header}) => {
        if (header.msg_type === 'stream') said += content.text;
        if (header.msg_type === 'error') said += content.evalue;
    };
    await future.done;
    return said;
}"""
BACKGROUND = "getComputedStyle(document.body).getPropertyValue('--jp-layout-color1').trim()"
SOURCES = """() => [...window.notebook().content.model.cells].map(
    cell => cell.sharedModel.getSource())"""
OUTPUTS = """index => window.notebook().content.model.cells.get(index).outputs.toJSON()"""


def write_notebook(path: Path, *sources: str) -> None:
    """Write a notebook with these cells of code."""
    cells = [nbformat.v4.new_code_cell(source.strip()) for source in sources]
    notebook = nbformat.v4.new_notebook(cells=cells)
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
    path.parent.mkdir(exist_ok=True)
    nbformat.write(notebook, path)


def copy_for_students(target: Path) -> Path:
    """Copy what a student works with into `target`, so that a test may save notebooks; return `target`."""
    for name in STUDENTS_FILES:
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(source, target / name, ignore=shutil.ignore_patterns(".ipynb_checkpoints"))
        elif source.exists():
            shutil.copy(source, target)
    return target


@contextmanager
def server(folder: Path, *more: str, settings: str = "jupyter") -> Iterator[str]:
    """Run JupyterLab for the course in `folder`; yield its address. Its log: `log_of(address)`.

    more: options for its command line. settings: the folder with its configuration.
    """
    port = free_port()
    address = f"http://127.0.0.1:{port}"
    # Tests write notebooks beside the course's; students see copies, in work/.
    root = f"--ServerApp.root_dir={folder}"
    options = ["--no-browser", f"--ServerApp.port={port}", "--IdentityProvider.token=", root, *more]
    options.append("--LabApp.expose_app_in_browser=True")  # for Lab.run_all and Lab.has_command
    home = folder / "home"  # Lab keeps a student's layout and settings there
    home.mkdir(exist_ok=True)
    environment = {**os.environ, "HOME": str(home), "JUPYTER_CONFIG_PATH": str(folder / settings)}
    ARTIFACTS.mkdir(exist_ok=True)
    with open(log_of(address), "w") as log:
        command = [sys.executable, "-m", "jupyterlab", *options]
        process = subprocess.Popen(command, cwd=folder, env=environment, stdout=log, stderr=subprocess.STDOUT)
        try:
            _wait_until_up(f"{address}/api", process, log_of(address))
            yield address
        finally:
            process.terminate()
            process.wait(PATIENCE)


def log_of(address: str) -> Path:
    """Each server has its own log: tests run side by side."""
    return ARTIFACTS / f"jupyterlab-{address.rpartition(':')[2]}.log"


def _wait_until_up(url: str, process: subprocess.Popen, log: Path) -> None:
    until(lambda: process.poll() is not None or _answers(url), f"JupyterLab at {url}")
    assert process.poll() is None, f"JupyterLab has ended; its last lines:\n{log.read_text()[-2000:]}"


def _answers(url: str) -> bool:
    with suppress(OSError), urllib.request.urlopen(url, timeout=PATIENCE):
        return True
    return False


class Lab:
    """A browser tab with JupyterLab in it."""

    def __init__(self, page: Page, address: str):
        page.set_default_timeout(PATIENCE * 1000)
        page.add_init_script(NOTEBOOK)
        self.page = page
        self.address = address

    def wait(self, condition: str, arg: Any = None) -> None:
        """Wait until this JavaScript is true."""
        self.page.wait_for_function(condition, arg=arg, polling=ASKED)

    def open(self, notebook: str = "") -> None:
        """Load JupyterLab with a notebook, by its path, and await its kernel; or its start page."""
        workspace = uuid.uuid4().hex  # a new one each time: Lab would restore the tabs of the last test
        self.page.goto(f"{self.address}/lab/workspaces/{workspace}" if notebook else self.address)
        self.wait("window.jupyterapp")
        if notebook:
            self.page.evaluate(OPEN, notebook)
            self.wait_for_kernel()
        else:
            self.page.locator(f"{START} .next").wait_for()

    def turn_to(self, notebook: str) -> None:
        """Open a notebook in the JupyterLab that shows; where none shows, load it."""
        if not self.page.url.startswith(self.address):
            self.open(notebook)
            return
        self.page.evaluate(OPEN, notebook)
        self.wait_for_kernel()

    def leave(self) -> None:
        """Close all notebooks, and shut down their kernels, so that what plays ends here.

        A page that was loaded again is left, too: some seconds later it opens the notebook of its address
        once more, in front of the next test's.
        """
        self.page.evaluate(CLOSE_ALL)
        self.shut_down()
        if self.page.evaluate(LOADED_AGAIN):
            self.page.goto("about:blank")

    def wait_for_kernel(self) -> None:
        """Wait until the notebook shows and its kernel is idle."""
        self.page.wait_for_selector(f"{SHOWN} .jp-Notebook .jp-Cell")
        self.page.evaluate(KERNEL_READY)
        self.wait(KERNEL_IDLE)

    def run_all(self) -> None:
        """Run all cells of the notebook, and wait until they are done or one has failed."""
        self.command("notebook:run-all-cells")
        self.wait(ALL_CELLS_DONE)
        self.wait(ALL_OUTPUTS_DRAWN)

    def run_cell(self, index: int, *, wait: bool = True) -> None:
        """Run a cell, and wait until the kernel is done with it."""
        self.page.evaluate(RUN_CELL, index)
        if wait:
            self.wait_for_cell(index)

    def wait_for_cell(self, index: int) -> None:
        """Wait until a cell is done."""
        self.wait(CELL_DONE, arg=index)

    def cell(self, index: int) -> Locator:
        """Return a cell of the notebook, as it shows."""
        return self.page.locator(f"{SHOWN} .jp-Notebook .jp-Cell[data-windowed-list-index='{index}']")

    def sources(self) -> list[str]:
        """Return the text of all cells."""
        return self.page.evaluate(SOURCES)

    def outputs(self, index: int) -> list[dict]:
        """Return a cell's outputs as the notebook keeps them."""
        return self.page.evaluate(OUTPUTS, index)

    def ask(self, expression: str) -> Any:
        """Return what a Python expression is in the notebook's kernel, through JSON."""
        said = self.page.evaluate(ASK, f"import json; print(json.dumps({expression}))")
        try:
            return json.loads(said)
        except ValueError:
            raise AssertionError(f"{expression} gave: {said}") from None

    def save(self) -> None:
        """Save the notebook."""
        self.page.evaluate("window.notebook().context.save()")
        self.wait("() => !window.notebook().context.model.dirty")

    def command(self, name: str, **arguments: str) -> None:
        """Execute one of JupyterLab's commands, such as `docmanager:save`, and wait until it is done."""
        self.page.evaluate(COMMAND, [name, arguments])

    @contextmanager
    def narrow_and_dark(self) -> Iterator[None]:
        """Show JupyterLab in a narrow window, without its left area, and in its dark theme for a while.

        The server would keep the theme for the next test, and the page the rest.
        """
        before = self.page.viewport_size
        self._use_theme("JupyterLab Dark")
        self.page.set_viewport_size({"width": 480, "height": 900})
        self.command("application:toggle-left-area")
        try:
            yield
        finally:
            self.command("application:toggle-left-area")
            self.page.set_viewport_size(before)
            self._use_theme("JupyterLab Light")

    @contextmanager
    def dark(self) -> Iterator[None]:
        """Show JupyterLab in its dark theme for a while."""
        self._use_theme("JupyterLab Dark")
        try:
            yield
        finally:
            self._use_theme("JupyterLab Light")

    def _use_theme(self, name: str) -> None:
        before = self.page.evaluate(BACKGROUND)
        self.command("apputils:change-theme", theme=name)
        # the style sheet comes after the name
        self.wait(f"before => {BACKGROUND} !== before", arg=before)

    def shut_down(self) -> None:
        """Shut down all kernels of the server, so that what a test leaves playing ends here."""
        sessions = f"{self.address}/api/sessions"
        for session in self.page.request.get(sessions, timeout=PATIENCE * 1000).json():
            address = f"{sessions}/{session['id']}"
            self.page.request.delete(address, headers=self._token(), timeout=PATIENCE * 1000)

    def _token(self) -> dict[str, str]:
        """Return what the server wants to see in a request that changes something."""
        cookies = {cookie["name"]: cookie["value"] for cookie in self.page.context.cookies()}
        return {"X-XSRFToken": cookies["_xsrf"]}

    def output(self) -> str:
        """Return the text of all outputs that show."""
        return "\n".join(self.page.locator(f"{SHOWN} .jp-OutputArea-output").all_inner_texts())

    def validate(self) -> list[str]:
        """Click Validate, and return the rows of the table in its dialog, when all has run."""
        self.page.locator(".validate-button").first.click()
        dialog = self.page.locator(".jp-Dialog", has_text="Validation Results")
        dialog.locator("tbody tr").first.wait_for()
        dialog.locator("p[role='status']:empty").wait_for(state="attached")
        rows = [" | ".join(row.locator("th, td").all_inner_texts()) for row in dialog.locator("tr").all()]
        self.screenshot("validate")
        dialog.locator("button.jp-mod-accept").click()
        return rows[1:]

    def has_command(self, name: str) -> bool:
        """Return whether JupyterLab knows a command, such as nbgrader's `nbgrader:open-formgrader`."""
        return self.page.evaluate("name => window.jupyterapp.commands.hasCommand(name)", name)

    def screenshot(self, name: str) -> Path:
        """Save a picture of the tab as test-artifacts/NAME.png and return its path."""
        path = ARTIFACTS / f"{name}.png"
        self.page.screenshot(path=path)
        return path
