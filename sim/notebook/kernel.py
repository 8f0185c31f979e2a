"""Connects the cell history and the page to a notebook's kernel; does nothing outside a notebook."""

from __future__ import annotations

import builtins
import json
import linecache
import os
import re
from collections.abc import Iterable
from pathlib import Path
from types import TracebackType
from typing import Any

from sim.notebook.cell_history import CellHistory, OutdatedName
from sim.notebook.output_limit import limit_output
from sim.notebook.page_comm import PageComm
from sim.notebook.shared_scripts import SharedScripts
from sim.notebook.written_files import OutdatedFile, OutdatedModule, WrittenFiles
from sim.ros.absent_names import explain_absent_name
from sim.ros2.absent_colcon import missing_colcon

COURSE_FOLDERS = tuple(str(Path(__file__).parents[2] / name) for name in ("sim", "grader"))
REFUSALS = TypeError, ValueError, LookupError  # what the course raises for arguments
_history: CellHistory | None = None
_files = WrittenFiles()
_page = PageComm()
_scripts = SharedScripts()


def interrupt_error() -> KeyboardInterrupt:
    """The exception of a run that the user interrupted. A notebook shows it in one line."""
    error = KeyboardInterrupt("The run was interrupted.")
    error._render_traceback_ = lambda: [f"KeyboardInterrupt: {error}"]  # type: ignore[attr-defined]
    return error


class OutdatedCodeError(RuntimeError):
    """Code to be run is older than the code in the notebook. A notebook shows this error in one line."""

    def _render_traceback_(self) -> list[str]:
        return [str(self)]


def shell() -> Any:
    """The IPython shell of this notebook kernel; None anywhere else."""
    found = getattr(builtins, "get_ipython", lambda: None)()
    return found if getattr(found, "kernel", None) is not None else None


def in_notebook() -> bool:
    """Return whether this is a notebook's kernel, which can display pictures."""
    return shell() is not None


def notebook_page() -> PageComm:
    """The comm to the notebook's page; usable without a page, too."""
    return _page


def shared_scripts() -> SharedScripts:
    """Return which outputs contain the scripts of pictures; outside a notebook, each does."""
    return _scripts


def watch_cells() -> None:
    """Start to track the notebook's cells. Idempotent."""
    global _history
    ipython = shell()
    if ipython is None or _history is not None:
        return
    limit_output(ipython)
    history = _history = CellHistory(ipython.user_ns)

    def begin(info: Any) -> None:
        history.begin(_key(info), info.raw_cell or "")
        _files.begin(info.raw_cell or "")
        _scripts.begin(_key(info))
        if sentence := missing_colcon(info.raw_cell or ""):
            print(sentence)

    def end(result: Any) -> None:
        error = result.error_before_exec or result.error_in_exec
        history.end(_key(result.info), result.info.raw_cell or "", _format_error(error))
        _files.end(_key(result.info), result.info.raw_cell or "")

    def update(order: list[str], sources: dict[str, str]) -> None:
        history.update(order, sources)
        _scripts.update(order)

    ipython.events.register("pre_run_cell", begin)
    ipython.events.register("post_run_cell", end)
    ipython.set_custom_exc((NameError, KeyboardInterrupt, ModuleNotFoundError, *REFUSALS), show_error)
    _page.open(update)


def find_outdated(nodes: Iterable[Any]) -> OutdatedName | OutdatedFile | OutdatedModule | None:
    """The first outdated name, file or module that these programs need; None if all are up to date.

    nodes: programs, and paths of folders whose files they need.
    """
    if _history is None:
        return None
    programs = list(nodes)
    programs += [node.target for node in programs if hasattr(node, "target")]
    things = _history.objects_of(programs)
    return _history.outdated(programs) or _files.outdated(things, _history.sources)


def raise_if_outdated(nodes: Iterable[Any]) -> None:
    """Raise OutdatedCodeError if these programs need an outdated name."""
    found = find_outdated(nodes)
    if found is not None:
        raise OutdatedCodeError(f"Your last version did not run: {found.saw}. {found.hint}")


def explain_missing_name(name: str) -> str:
    """Return how to define an undefined name that a cell above defines, or a similar name; "" if none."""
    if _history is None or not name:
        return ""
    return _history.explain_missing(name, *_file()) or _history.suggest(name)


def show_error(
    ipython: Any, kind: type[BaseException], error: BaseException, trace: TracebackType, tb_offset: Any = None
) -> None:
    """Show an error of a cell: in one sentence if that is sufficient, otherwise as a traceback.

    The traceback of an import ends with what the missing module is, and how to get it; that of an argument
    that the course refuses ends in the line that gave it.
    """
    watch_cells()
    if isinstance(error, REFUSALS):
        _drop_course_frames(trace)
    hint = explain_absent_name(kind.__name__, str(error))
    if hint and hint not in getattr(error, "__notes__", ()):
        error.add_note(hint)
    is_name_error = isinstance(error, NameError)
    sentence = explain_missing_name(error.name) if is_name_error else _interruption(error, trace)  # type: ignore[attr-defined]
    if sentence:
        error._render_traceback_ = lambda: [f"{kind.__name__}: {sentence}"]  # type: ignore[attr-defined]
    ipython.showtraceback((kind, error, trace), tb_offset=tb_offset, running_compiled_code=True)


def _drop_course_frames(trace: TracebackType | None) -> None:
    """End a traceback before the course's code, if a `raise` in it is the last line."""
    last, line = None, ""
    while trace is not None:
        file = trace.tb_frame.f_code.co_filename
        if file.startswith(COURSE_FOLDERS):
            line = linecache.getline(file, trace.tb_lineno).strip()
        else:
            last, line = trace, ""
        trace = trace.tb_next
    if last is not None and line.startswith("raise "):
        last.tb_next = None


def _interruption(error: BaseException, trace: TracebackType | None) -> str:
    """A sentence for an interrupt during course code, else ""."""
    if not isinstance(error, KeyboardInterrupt) or hasattr(error, "_render_traceback_"):
        return ""  # another error, or one that has its own message
    while trace is not None:
        if trace.tb_frame.f_code.co_filename.startswith(COURSE_FOLDERS):
            return "You interrupted this cell."
        trace = trace.tb_next
    return ""


def _file() -> tuple[list[str], dict[str, str]]:
    """The cell ids in the notebook's file, in order, and their sources; empty if it can't be read."""
    try:
        cells = json.loads(Path(os.environ["JPY_SESSION_NAME"]).read_text(encoding="utf-8"))["cells"]
        code = [cell for cell in cells if cell["cell_type"] == "code"]
        return [cell["id"] for cell in code], {cell["id"]: "".join(cell["source"]) for cell in code}
    except (KeyError, OSError, TypeError, ValueError):
        return [], {}


def _key(info: Any) -> str:
    return info.cell_id or f"no id: {info.raw_cell}"


def _format_error(error: BaseException | None) -> str:
    """An exception in one line; a syntax error with its line number."""
    if error is None:
        return ""
    if isinstance(error, SyntaxError):
        return f"{type(error).__name__}: {error.msg} (line {error.lineno})"
    text = re.sub(r"\s+", " ", str(error)).strip()[:120]
    return f"{type(error).__name__}: {text}" if text else type(error).__name__
