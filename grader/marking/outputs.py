"""Outputs of notebook cells as plain data, for whoever makes them and whoever checks them.

Both a student's process and its judge use this module, so nothing in here knows either of them.
"""

from __future__ import annotations

import base64
from collections.abc import Mapping
from typing import Any

MOST = 1_000_000  # characters that one cell shows
MOST_WORDS = 1_000  # characters that tell of a picture
FOR_INSTRUCTOR = "for_instructor"  # in an output's metadata: it is not on the student's page
LEFT_OUT = "\n[This cell showed more than a notebook can hold. The rest is left out.]\n"

SHOWN = (
    "text/plain", "text/html", "text/markdown", "text/latex", "image/png", "image/jpeg", "image/svg+xml",
)  # fmt: skip
SIZES = ("width", "height")  # of a picture, in pixels
MOST_PIXELS = 100_000


def mime_bundle(data: Mapping[str, Any], metadata: Mapping[str, Any] | None) -> dict[str, Any]:
    """The `data` and `metadata` of an output from what Jupyter's formatters give: pictures become text."""
    text = {
        mime: base64.b64encode(item).decode() if isinstance(item, bytes) else item
        for mime, item in data.items()
        if mime in SHOWN and isinstance(item, (bytes, str))
    }
    return {"data": text, "metadata": picture_settings(metadata)}


def writable_text(text: str) -> str:
    """Text that every program can write to a file: half a character, as in "\\ud83d", becomes a "?"."""
    return text.encode(errors="replace").decode()


def picture_settings(metadata: Any) -> dict[str, Any]:
    """Of an output's metadata the words and sizes of its pictures; all else is left out."""
    kept = {}
    for mime, settings in metadata.items() if isinstance(metadata, Mapping) else ():
        if mime in SHOWN and isinstance(settings, Mapping):
            found = {key: settings[key] for key in SIZES if _is_size(settings.get(key))}
            if isinstance(settings.get("alt"), str):
                found["alt"] = writable_text(settings["alt"][:MOST_WORDS])
            if found:
                kept[mime] = found
    return kept


def _is_size(value: Any) -> bool:
    return type(value) is int and 0 < value < MOST_PIXELS


def output_size(output: dict[str, Any]) -> int:
    """How much room an output takes, in characters."""
    lines = output.get("traceback", ())
    about = [settings.get("alt", "") for settings in output.get("metadata", {}).values()]
    parts = [output.get("text", ""), *output.get("data", {}).values(), *lines, *about]
    words = output.get("ename", ""), output.get("evalue", "")
    return sum(map(len, (*parts, *words))) + 50 * (1 + len(lines))
