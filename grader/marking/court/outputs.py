"""The outputs of a notebook's cells, put together from what a student's process says that they showed.

That process is the student's and may say anything. So nothing of it is taken over as it comes: every output
is made anew from the few fields that one has, with text of bounded size.
"""

from __future__ import annotations

import base64
import sys
import sysconfig
from collections.abc import Mapping
from pathlib import Path
from typing import Any

MOST = 1_000_000  # characters that one cell shows
MOST_OF_ALL = 20_000_000  # that all cells of a submission show
MOST_OUTPUTS = 1_000  # of one cell
MOST_OUTPUTS_OF_ALL = 10_000  # of all cells: nbconvert looks at each again and again
MOST_LINES = 1_000  # of a traceback
MOST_WORDS = 1_000  # characters that tell of a picture
MOST_NAME = 200  # characters of a display_id
LEFT_OUT = "\n[This cell showed more than a notebook can hold. The rest is left out.]\n"

SHOWN = (
    "text/plain", "text/html", "text/markdown", "text/latex", "image/png", "image/jpeg", "image/svg+xml",
)  # fmt: skip
SIZES = ("width", "height")  # of a picture, in pixels
MOST_PIXELS = 100_000

# Of Python's libraries and of the course. A longer one comes first, for one may lie in another.
COURSE = str(Path(__file__).parents[3])
PLACES = (*sysconfig.get_paths().values(), sys.prefix, sys.base_prefix, COURSE)
FOLDERS = sorted({f"{place}/" for place in PLACES if len(place) > 1}, key=len, reverse=True)


class Outputs:
    """What one cell showed, in order, as nbformat 4 has it. It shares `Screen` with the other cells."""

    def __init__(self, screen: Screen) -> None:
        self.list: list[dict[str, Any]] = []
        self._screen = screen
        self._used = 0  # characters
        self._full = False
        self._clear = False  # before the next output

    def take(self, event: Mapping[str, Any]) -> None:
        """Add what the student's process says; whatever makes no sense is left out."""
        if "clear" in event:
            self._clear = True
            if not event["clear"]:
                self._begin()
            return
        output, identity = made(event.get("output")), event.get("display_id")
        if output is None:
            return
        if event.get("update"):
            self._screen.update(identity, output)
        elif self._has_room(output):
            self._join(output)
            if isinstance(identity, str) and "data" in output:
                self._screen.shown(identity, self, output)

    def say(self, text: str) -> None:
        """Add a line of ours. It is there however much the cell showed."""
        self._begin()
        self._join({"output_type": "stream", "name": "stdout", "text": text.rstrip("\n") + "\n"})

    def grow(self, more: int) -> bool:
        """Take so much more room for an output of the cell, or give it back; whether there is that much."""
        if self._used + more > MOST or more > self._screen.room:
            return False
        self._used += more
        self._screen.room -= more
        return True

    @property
    def printed(self) -> list[dict[str, Any]]:
        """Only what was written as text, all of it as stdout."""
        text = "".join(output["text"] for output in self.list if output["output_type"] == "stream")
        return [{"output_type": "stream", "name": "stdout", "text": text}] if text else []

    def _begin(self) -> None:
        if self._clear:
            self._screen.outputs -= len(self.list)
            self.list.clear()
            self._screen.forget(self)
            self._screen.room += self._used
            self._used, self._full, self._clear = 0, False, False

    def _join(self, output: dict[str, Any]) -> None:
        last = self.list[-1] if self.list else {}
        if output["output_type"] == "stream" == last.get("output_type") and output["name"] == last["name"]:
            last["text"] += output["text"]
        else:
            self.list.append(output)
            self._screen.outputs += 1

    def _has_room(self, output: dict[str, Any]) -> bool:
        """Whether it still fits. Says once that the rest is left out; text is cut where it has to be."""
        if self._full and not self._clear:
            return False
        self._begin()
        room = min(MOST - self._used, self._screen.room)
        used = min(size(output), room)
        self._used += used
        self._screen.room -= used
        many = len(self.list) >= MOST_OUTPUTS or self._screen.outputs >= MOST_OUTPUTS_OF_ALL
        if size(output) <= room and not many:
            return True
        self._full = True
        if output["output_type"] == "stream":
            self._join({**output, "text": output["text"][: max(room, 0)]})
        self.say(LEFT_OUT)
        return False


class Screen:
    """What the cells of a submission share: room, and displays that later cells may update."""

    def __init__(self) -> None:
        self.room, self.outputs = MOST_OF_ALL, 0
        self._displays: dict[str, list[tuple[Outputs, dict[str, Any]]]] = {}

    def shown(self, identity: str, cell: Outputs, output: dict[str, Any]) -> None:
        """Remember an output of a cell by its display_id."""
        if len(self._displays) < MOST_OUTPUTS:
            self._displays.setdefault(identity[:MOST_NAME], []).append((cell, output))

    def update(self, identity: Any, output: dict[str, Any]) -> None:
        """Let an output take the place of those with this display_id, if there are any."""
        known = self._displays.get(identity[:MOST_NAME], ()) if isinstance(identity, str) else ()
        for cell, old in known if "data" in output else ():
            if cell.grow(size(output) - size(old)):
                old.update(data=output["data"], metadata=output["metadata"])

    def forget(self, cell: Outputs) -> None:
        """The outputs of a cell are gone."""
        left = {name: [it for it in known if it[0] is not cell] for name, known in self._displays.items()}
        self._displays = {name: known for name, known in left.items() if known}


def made(output: Any) -> dict[str, Any] | None:
    """An output of nbformat 4 out of anything that claims to be one; None where that can't be."""
    match output:
        case {"output_type": "stream", "name": "stdout" | "stderr" as name, "text": str(text)}:
            return {"output_type": "stream", "name": name, "text": told(text)}
        case {"output_type": "error", "ename": str(name), "evalue": str(value), "traceback": [*lines]}:
            lines = [told(line) for line in lines[:MOST_LINES] if isinstance(line, str)]
            return {"output_type": "error", "ename": told(name), "evalue": told(value), "traceback": lines}
        case {"output_type": "display_data" | "execute_result" as kind, "data": dict(data)}:
            words = {mime: data[mime] for mime in SHOWN if isinstance(data.get(mime), str)}
            shown = {mime: (told if mime.startswith("text/") else plain)(it) for mime, it in words.items()}
            new = {"output_type": kind, "data": shown, "metadata": _sizes(output.get("metadata"))}
            if kind == "execute_result":
                count = output.get("execution_count")
                new["execution_count"] = count if type(count) is int and 0 < count < 10**6 else None
            return new if shown else None
    return None


def bundle(data: Mapping[str, Any], metadata: Mapping[str, Any] | None) -> dict[str, Any]:
    """The `data` and `metadata` of an output from what Jupyter's formatters give: pictures become text."""
    text = {
        mime: base64.b64encode(item).decode() if isinstance(item, bytes) else item
        for mime, item in data.items()
        if mime in SHOWN and isinstance(item, (bytes, str))
    }
    return {"data": text, "metadata": _sizes(metadata)}


def plain(text: str) -> str:
    """Text that every program can write to a file: half a character, as in "\\ud83d", becomes a "?"."""
    return text.encode(errors="replace").decode()


def told(text: str) -> str:
    """The same without the folders of the machine that marks, which are no student's business."""
    for folder in FOLDERS:
        text = text.replace(folder, "")
    return plain(text)


def _sizes(metadata: Any) -> dict[str, Any]:
    """Of an output's metadata the words and sizes of its pictures."""
    kept = {}
    for mime, settings in metadata.items() if isinstance(metadata, Mapping) else ():
        if mime in SHOWN and isinstance(settings, Mapping):
            found = {key: settings[key] for key in SIZES if _is_size(settings.get(key))}
            if isinstance(settings.get("alt"), str):
                found["alt"] = plain(settings["alt"][:MOST_WORDS])
            if found:
                kept[mime] = found
    return kept


def _is_size(value: Any) -> bool:
    return type(value) is int and 0 < value < MOST_PIXELS


def size(output: dict[str, Any]) -> int:
    """How much room an output takes, in characters."""
    lines = output.get("traceback", ())
    about = [settings.get("alt", "") for settings in output.get("metadata", {}).values()]
    parts = [output.get("text", ""), *output.get("data", {}).values(), *lines, *about]
    words = output.get("ename", ""), output.get("evalue", "")
    return sum(map(len, (*parts, *words))) + 50 * (1 + len(lines))
