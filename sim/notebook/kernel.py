"""Ties the book of cells and the page to the kernel of a notebook; where there is none, it does nothing."""

from __future__ import annotations

import builtins
import json
import os
import re
from collections.abc import Iterable
from pathlib import Path
from types import TracebackType
from typing import Any

from sim.notebook.cells import Cells, Outdated
from sim.notebook.page import Page

OURS = tuple(str(Path(__file__).parents[2] / name) for name in ("sim", "grader"))
_cells: Cells | None = None
_page = Page()


def interrupted() -> KeyboardInterrupt:
    """What a run raises that the user interrupted. A notebook shows it in one line."""
    error = KeyboardInterrupt("The run was interrupted.")
    error._render_traceback_ = lambda: [f"KeyboardInterrupt: {error}"]
    return error


class LastVersionDidNotRun(RuntimeError):
    """A run was asked of code that is older than what the notebook shows. A notebook shows it in one line."""

    def _render_traceback_(self) -> list[str]:
        return [str(self)]


def shell() -> Any:
    """The shell of the notebook's kernel that this is; None anywhere else."""
    here = getattr(builtins, "get_ipython", lambda: None)()
    return here if getattr(here, "kernel", None) is not None else None


def in_notebook() -> bool:
    """Whether a notebook's cell is running, which can show a picture."""
    return shell() is not None


def notebook_page() -> Page:
    """The page that shows the notebook; it takes what it is told, also where there is none."""
    return _page


def watch() -> None:
    """From now on, know what becomes of the notebook's cells. Doing it again does nothing."""
    global _cells
    here = shell()
    if here is None or _cells is not None:
        return
    cells = _cells = Cells(here.user_ns)

    def begin(info: Any) -> None:
        cells.begin(_key(info), info.raw_cell or "")

    def end(result: Any) -> None:
        error = result.error_before_exec or result.error_in_exec
        cells.end(_key(result.info), result.info.raw_cell or "", _words(error))

    here.events.register("pre_run_cell", begin)
    here.events.register("post_run_cell", end)
    here.set_custom_exc((NameError, KeyboardInterrupt), show_error)
    _page.open(cells.shown)


def outdated(nodes: Iterable[Any]) -> Outdated | None:
    """What about these programs is not as the notebook's cells have it; None when all is."""
    if _cells is None:
        return None
    programs = list(nodes)
    return _cells.outdated([*programs, *(node.target for node in programs if hasattr(node, "target"))])


def refuse_outdated(nodes: Iterable[Any]) -> None:
    """Raise LastVersionDidNotRun when there is something outdated about these programs."""
    found = outdated(nodes)
    if found is not None:
        raise LastVersionDidNotRun(f"Your last version did not run: {found.saw}. {found.hint}")


def missing(name: str) -> str:
    """What to do about a name that is not there but defined by a cell above; "" where none defines it."""
    return _cells.missing(name, *_file()) if _cells is not None and name else ""


def show_error(
    here: Any, kind: type[BaseException], error: BaseException, trace: TracebackType, tb_offset: Any = None
) -> None:
    """Show an error of a cell: in one sentence where that says all, else as always."""
    watch()
    words = missing(error.name) if isinstance(error, NameError) else _interruption(error, trace)
    if words:
        error._render_traceback_ = lambda: [f"{kind.__name__}: {words}"]
    here.showtraceback((kind, error, trace), tb_offset=tb_offset, running_compiled_code=True)


def _interruption(error: BaseException, trace: TracebackType | None) -> str:
    """One line for an interrupt that came while code of ours was at work."""
    if hasattr(error, "_render_traceback_"):
        return ""  # it speaks for itself
    while trace is not None:
        if trace.tb_frame.f_code.co_filename.startswith(OURS):
            return "You interrupted this cell."
        trace = trace.tb_next
    return ""


def _file() -> tuple[list[str], dict[str, str]]:
    """The cells as the notebook's file has them, in order, with their texts; nothing if it can't be read."""
    try:
        cells = json.loads(Path(os.environ["JPY_SESSION_NAME"]).read_text(encoding="utf-8"))["cells"]
        code = [cell for cell in cells if cell["cell_type"] == "code"]
        return [cell["id"] for cell in code], {cell["id"]: "".join(cell["source"]) for cell in code}
    except (KeyError, OSError, TypeError, ValueError):
        return [], {}


def _key(info: Any) -> str:
    return info.cell_id or f"no id: {info.raw_cell}"


def _words(error: BaseException | None) -> str:
    """An exception in one line; a syntax error with the line where it is."""
    if error is None:
        return ""
    if isinstance(error, SyntaxError):
        return f"{type(error).__name__}: {error.msg} (line {error.lineno})"
    text = re.sub(r"\s+", " ", str(error)).strip()[:120]
    return f"{type(error).__name__}: {text}" if text else type(error).__name__
