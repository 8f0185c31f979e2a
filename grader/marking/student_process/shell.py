"""The shell that runs a student's cells: what they show goes to the judge instead of a browser.

It is IPython's own, without a kernel. Its event loop runs between awaits only, as in a notebook: a cell may
await, and what it left running goes on while other cells wait.
"""

from __future__ import annotations

import io
import os
import sys
import tempfile
import warnings
from typing import Any, BinaryIO

from IPython.core.displayhook import DisplayHook
from IPython.core.displaypub import DisplayPublisher
from IPython.core.interactiveshell import InteractiveShell
from IPython.core.pylabtools import activate_matplotlib
from matplotlib_inline.backend_inline import configure_inline_support
from traitlets import Any as AnyTrait
from traitlets import Type
from traitlets.config import Config

from grader.marking.outputs import mime_bundle
from grader.marking.student_process.error_output import error_output
from grader.marking.student_process.outlet import Outlet

INLINE = "module://matplotlib_inline.backend_inline"


class DisplaySender(DisplayPublisher):
    """Where `display` puts things."""

    def publish(
        self,
        data: dict[str, Any],
        metadata: dict[str, Any] | None = None,
        *,
        transient: dict[str, Any] | None = None,
        update: bool = False,
        **_: Any,
    ) -> None:
        """Show it, or let it take the place of what has the same display_id."""
        output = {"output_type": "display_data", **mime_bundle(data, metadata)}
        identity = (transient or {}).get("display_id")
        self.shell.outlet.show(output=output, display_id=identity, update=update)

    def clear_output(self, wait: bool = False) -> None:
        """Empty the cell's output; with `wait`, when the next output comes."""
        self.shell.outlet.show(clear=bool(wait))


class ValueHook(DisplayHook):
    """Where the value of a cell's last line goes."""

    def write_output_prompt(self) -> None:
        """The number is part of the output."""

    def write_format_data(self, format_dict: dict[str, Any], md_dict: dict[str, Any] | None = None) -> None:
        """Show it."""
        count = {"execution_count": self.prompt_count}
        output = {"output_type": "execute_result", **mime_bundle(format_dict, md_dict), **count}
        self.shell.outlet.show(output=output)


class Shell(InteractiveShell):
    """IPython as a notebook's kernel has it, as far as a cell can tell."""

    outlet: Outlet = AnyTrait()
    display_pub_class = Type(DisplaySender)
    displayhook_class = Type(ValueHook)

    def ask_exit(self) -> None:
        """`exit` and `quit`: as a kernel, it ends after this cell."""
        self.exit_now = True

    def enable_gui(self, gui: Any = None) -> None:
        """There is no window system."""

    def showtraceback(self, exc_tuple: Any = None, *_: Any, **__: Any) -> None:
        """Show an error as the student should read it."""
        error = exc_tuple[1] if exc_tuple else sys.exc_info()[1]
        if error is not None:
            self.outlet.show(output=error_output(error, self.compile._filename_map))

    def showsyntaxerror(self, *_: Any, **__: Any) -> None:
        """The same for code that can't be read."""
        self.showtraceback()

    def _format_exception_for_storage(self, *_: Any, **__: Any) -> list[str]:
        """Nobody reads that, and to make it takes longer than most cells."""
        return []

    async def execute(self, source: str) -> None:
        """Run one cell; what comes out of it, errors too, goes to the outlet."""
        try:
            code, problem = self.transform_cell(source), None
        except Exception:
            code, problem = source, sys.exc_info()
        await self.run_cell_async(
            source, store_history=True, transformed_cell=code, preprocessing_exc_tuple=problem
        )
        self.events.trigger("post_execute")
        self.events.trigger("post_run_cell", self.last_execution_result)


def start_shell(outlet: Outlet) -> Shell:
    """The shell of this process; Python's streams and matplotlib's figures lead to it from now on."""
    settings = Config()
    settings.HistoryManager.enabled = False  # it would write to a database, from a thread
    made = Shell.instance(config=settings)
    made.outlet = outlet
    sys.stdout, sys.stderr = Stream(outlet, "stdout", 1), Stream(outlet, "stderr", 2)
    warnings.filterwarnings("ignore", "To exit: use")  # IPython's, for sys.exit(); it shows a path of ours
    activate_matplotlib(INLINE)
    configure_inline_support(made, INLINE)
    return made


class Stream(io.TextIOBase):
    """A text stream that is shown in the cell."""

    encoding, errors = "utf-8", "replace"

    def __init__(self, outlet: Outlet, name: str, descriptor: int) -> None:
        self._outlet, self.name, self._descriptor = outlet, f"<{name}>", descriptor
        self._channel = name

    def writable(self) -> bool:
        """Yes."""
        return True

    def fileno(self) -> int:
        """Where C code writes the like."""
        return self._descriptor

    def write(self, text: str) -> int:
        """As `TextIO.write`."""
        if not isinstance(text, str):
            raise TypeError(f"write() argument must be str, not {type(text).__name__}")
        self._outlet.write(self._channel, text)
        return len(text)


class Descriptors:
    """Catches what is written to file descriptors 1 and 2 below Python, to be shown when the cell is over."""

    def __init__(self, outlet: Outlet) -> None:
        self._outlet = outlet
        self._files = {name: self._caught(number) for name, number in (("stdout", 1), ("stderr", 2))}

    def show(self) -> None:
        """Show what has been caught since the last time."""
        for name, file in self._files.items():
            file.seek(0)  # the writers' place, too: they share it
            text = file.read(self._outlet.most).decode(errors="replace")
            file.seek(0)
            file.truncate()
            self._outlet.write(name, text)

    @staticmethod
    def _caught(number: int) -> BinaryIO:
        file = tempfile.TemporaryFile(buffering=0)  # noqa: SIM115  (as long as the process)
        os.dup2(file.fileno(), number)
        return file
