"""The outputs of a notebook's cells, from the events that a student's process sends.

That process is untrusted. So every output is made anew from the known fields of one, with text of bounded
size.
"""

from __future__ import annotations

import sys
import sysconfig
from collections.abc import Mapping
from typing import Any

from grader.marking.outputs import (
    MAX_CELL_CHARS,
    MIME_TYPES,
    TRUNCATED,
    image_metadata,
    output_size,
    writable_text,
)
from sim.course_folders import COURSE, ROS_PACKAGES

MAX_SUBMISSION_CHARS = 20_000_000  # of all cells of a submission
MAX_OUTPUTS = 1_000  # of one cell
MAX_SUBMISSION_OUTPUTS = 10_000  # of all cells: nbconvert processes each many times
MAX_TRACEBACK_LINES = 1_000  # of a traceback
MAX_DISPLAY_ID = 200  # characters of a display_id

# Of Python's libraries and of the course; longer paths first, because one may be inside another.
FOLDERS = COURSE, ROS_PACKAGES.parent
PREFIXES = (*sysconfig.get_paths().values(), sys.prefix, sys.base_prefix, *map(str, FOLDERS))
INSTALL_FOLDERS = sorted({f"{place}/" for place in PREFIXES if len(place) > 1}, key=len, reverse=True)


class CellOutputs:
    """The outputs of one cell, in order, in nbformat 4. All cells share one `DisplayRegistry`."""

    def __init__(self, displays: DisplayRegistry) -> None:
        self.list: list[dict[str, Any]] = []
        self._displays = displays
        self._used = 0  # characters
        self._full = False
        self._clear = False  # before the next output

    def add(self, event: Mapping[str, Any]) -> None:
        """Add an event of the student's process; an invalid one is dropped."""
        if "clear" in event:
            self._clear = True
            if not event["clear"]:
                self._begin()
            return
        output, identity = make_output(event.get("output")), event.get("display_id")
        if output is None:
            return
        if event.get("update"):
            self._displays.update(identity, output)
        elif self._has_room(output):
            self._join(output)
            if isinstance(identity, str) and "data" in output:
                self._displays.remember(identity, self, output)

    def add_line(self, text: str) -> None:
        """Add a line of the judge's, however much the cell has shown."""
        self._begin()
        self._join({"output_type": "stream", "name": "stdout", "text": text.rstrip("\n") + "\n"})

    def reserve(self, more: int) -> bool:
        """Reserve more characters for the cell's outputs, or free some; return whether there are enough."""
        if self._used + more > MAX_CELL_CHARS or more > self._displays.room:
            return False
        self._used += more
        self._displays.room -= more
        return True

    @property
    def printed_text(self) -> str:
        """Only the text of streams."""
        return "".join(output["text"] for output in self.list if output["output_type"] == "stream")

    def _begin(self) -> None:
        if self._clear:
            self._displays.outputs -= len(self.list)
            self.list.clear()
            self._displays.forget(self)
            self._displays.room += self._used
            self._used, self._full, self._clear = 0, False, False

    def _join(self, output: dict[str, Any]) -> None:
        last = self.list[-1] if self.list else {}
        if output["output_type"] == "stream" == last.get("output_type") and output["name"] == last["name"]:
            last["text"] += output["text"]
        else:
            self.list.append(output)
            self._displays.outputs += 1

    def _has_room(self, output: dict[str, Any]) -> bool:
        """Return whether it still fits. Otherwise its text is truncated, and one line says so."""
        if self._full and not self._clear:
            return False
        self._begin()
        room = min(MAX_CELL_CHARS - self._used, self._displays.room)
        used = min(output_size(output), room)
        self._used += used
        self._displays.room -= used
        many = len(self.list) >= MAX_OUTPUTS or self._displays.outputs >= MAX_SUBMISSION_OUTPUTS
        if output_size(output) <= room and not many:
            return True
        self._full = True
        if output["output_type"] == "stream":
            self._join({**output, "text": output["text"][: max(room, 0)]})
        self.add_line(TRUNCATED)
        return False


class DisplayRegistry:
    """Shared by the cells of a submission: the room for outputs, and displays that later cells may update."""

    def __init__(self) -> None:
        self.room, self.outputs = MAX_SUBMISSION_CHARS, 0
        self._displays: dict[str, list[tuple[CellOutputs, dict[str, Any]]]] = {}

    def remember(self, identity: str, cell: CellOutputs, output: dict[str, Any]) -> None:
        """Remember an output of a cell by its display_id."""
        if len(self._displays) < MAX_OUTPUTS:
            self._displays.setdefault(identity[:MAX_DISPLAY_ID], []).append((cell, output))

    def update(self, identity: Any, output: dict[str, Any]) -> None:
        """Replace the outputs with this display_id, if there are any."""
        known = self._displays.get(identity[:MAX_DISPLAY_ID], ()) if isinstance(identity, str) else ()
        for cell, old in known if "data" in output else ():
            if cell.reserve(output_size(output) - output_size(old)):
                old.update(data=output["data"], metadata=output["metadata"])

    def forget(self, cell: CellOutputs) -> None:
        """Forget the displays of a cell whose outputs were cleared."""
        left = {name: [it for it in known if it[0] is not cell] for name, known in self._displays.items()}
        self._displays = {name: known for name, known in left.items() if known}


def make_output(output: Any) -> dict[str, Any] | None:
    """Make an output of nbformat 4 from untrusted data; None if it is not one."""
    match output:
        case {"output_type": "stream", "name": "stdout" | "stderr" as name, "text": str(text)}:
            return {"output_type": "stream", "name": name, "text": without_folders(text)}
        case {"output_type": "error", "ename": str(name), "evalue": str(value), "traceback": [*lines]}:
            lines = [without_folders(line) for line in lines[:MAX_TRACEBACK_LINES] if isinstance(line, str)]
            words = {"ename": without_folders(name), "evalue": without_folders(value)}
            return {"output_type": "error", **words, "traceback": lines}
        case {"output_type": "display_data" | "execute_result" as kind, "data": dict(data)}:
            words = {mime: data[mime] for mime in MIME_TYPES if isinstance(data.get(mime), str)}
            shown = {
                mime: without_folders(it) if mime.startswith("text/") else writable_text(it)
                for mime, it in words.items()
            }
            new = {"output_type": kind, "data": shown, "metadata": image_metadata(output.get("metadata"))}
            if kind == "execute_result":
                count = output.get("execution_count")
                new["execution_count"] = count if type(count) is int and 0 < count < 10**6 else None
            return new if shown else None
    return None


def without_folders(text: str) -> str:
    """The text without the install folders of the machine that marks."""
    for folder in INSTALL_FOLDERS:
        text = text.replace(folder, "")
    return writable_text(text)


