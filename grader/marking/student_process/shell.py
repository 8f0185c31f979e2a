"""The IPython shell that runs a student's cells, without a kernel; their outputs are sent to the judge.

As in a notebook, a cell may await, and the tasks that it has started run while later cells await.
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
from grader.marking.student_process.output_sender import OutputSender

INLINE = "module://matplotlib_inline.backend_inline"


class DisplaySender(DisplayPublisher):
    """Sends what `display` shows."""

    def publish(  # type: ignore[override]  # without the deprecated `source`
        self,
        data: dict[str, Any],
        metadata: dict[str, Any] | None = None,
        *,
        transient: dict[str, Any] | None = None,
        update: bool = False,
        **_: Any,
    ) -> None:
        """Show it, or replace what has the same display_id."""
        output = {"output_type": "display_data", **mime_bundle(data, metadata)}
        identity = (transient or {}).get("display_id")
        self.shell.sender.show(output=output, display_id=identity, update=update)

    def clear_output(self, wait: bool = False) -> None:
        """Clear the cell's output; with `wait`, when the next output comes."""
        self.shell.sender.show(clear=bool(wait))


class ValueHook(DisplayHook):
    """Sends the value of a cell's last line."""

    shell: Shell

    def write_output_prompt(self) -> None:
        """The number is part of the output."""

    def write_format_data(self, format_dict: dict[str, Any], md_dict: dict[str, Any] | None = None) -> None:
        """Show it."""
        count = {"execution_count": self.prompt_count}
        output = {"output_type": "execute_result", **mime_bundle(format_dict, md_dict), **count}
        self.shell.sender.show(output=output)


class Shell(InteractiveShell):
    """An IPython shell that behaves like that of a notebook's kernel."""

    sender: OutputSender = AnyTrait()  # type: ignore[assignment]
    display_pub_class = Type(DisplaySender)
    displayhook_class = Type(ValueHook)

    def ask_exit(self) -> None:
        """`exit` and `quit`: like a kernel, it ends after this cell."""
        self.exit_now = True

    def enable_gui(self, gui: Any = None) -> None:
        """Do nothing: there is no window system."""

    def showtraceback(self, exc_tuple: Any = None, *_: Any, **__: Any) -> None:
        """Show an error in the form for students."""
        error = exc_tuple[1] if exc_tuple else sys.exc_info()[1]
        if error is not None:
            self.sender.show(output=error_output(error, self.compile._filename_map))

    def showsyntaxerror(self, *_: Any, **__: Any) -> None:
        """The same for invalid code."""
        self.showtraceback()

    def _format_exception_for_storage(self, *_: Any, **__: Any) -> list[str]:
        """Store nothing: it is not used, and formatting takes longer than most cells."""
        return []

    async def execute(self, source: str) -> None:
        """Run one cell; its outputs, errors too, are sent."""
        try:
            code, problem = self.transform_cell(source), None
        except Exception:
            code, problem = source, sys.exc_info()
        await self.run_cell_async(
            source, store_history=True, transformed_cell=code, preprocessing_exc_tuple=problem
        )
        self.events.trigger("post_execute")
        self.events.trigger("post_run_cell", self.last_execution_result)


def start_shell(sender: OutputSender) -> Shell:
    """Start the shell of this process; it shows Python's streams and matplotlib's figures from now on."""
    settings = Config()
    settings.HistoryManager.enabled = False  # it writes to a database, from a thread
    made = Shell.instance(config=settings)
    made.sender = sender
    sys.stdout, sys.stderr = Stream(sender, "stdout", 1), Stream(sender, "stderr", 2)
    warnings.filterwarnings("ignore", "To exit: use")  # IPython's, for sys.exit(); it shows a path
    activate_matplotlib(INLINE)
    configure_inline_support(made, INLINE)
    return made


class Stream(io.TextIOBase):
    """A text stream whose text is shown in the cell."""

    encoding, errors = "utf-8", "replace"

    def __init__(self, sender: OutputSender, name: str, descriptor: int) -> None:
        self._sender, self.name, self._descriptor = sender, f"<{name}>", descriptor
        self._channel = name

    def writable(self) -> bool:
        """True."""
        return True

    def fileno(self) -> int:
        """The descriptor to which C code writes such text."""
        return self._descriptor

    def write(self, text: str) -> int:
        """Work like `TextIO.write`."""
        if not isinstance(text, str):
            raise TypeError(f"write() argument must be str, not {type(text).__name__}")
        self._sender.write(self._channel, text)
        return len(text)


class DescriptorCapture:
    """Captures what C code writes to file descriptors 1 and 2, and shows it when the cell is over."""

    def __init__(self, sender: OutputSender) -> None:
        self._sender = sender
        self._files = {name: self._capture(number) for name, number in (("stdout", 1), ("stderr", 2))}

    def show(self) -> None:
        """Show what was captured since the last call."""
        for name, file in self._files.items():
            file.seek(0)  # also the position of the writers, which share it
            text = file.read(self._sender.most).decode(errors="replace")
            file.seek(0)
            file.truncate()
            self._sender.write(name, text)

    @staticmethod
    def _capture(number: int) -> BinaryIO:
        file = tempfile.TemporaryFile(buffering=0)  # noqa: SIM115  (as long as the process)
        os.dup2(file.fileno(), number)
        return file
