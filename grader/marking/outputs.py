"""Outputs of notebook cells as plain data.

Both a student's process, which makes them, and the judge, which checks them, use this module; it imports
nothing of either.
"""

from __future__ import annotations

import base64
from collections.abc import Mapping
from typing import Any

MAX_CELL_CHARS = 1_000_000  # that one cell shows
MAX_ALT_CHARS = 1_000  # of the description of a picture
FOR_INSTRUCTOR = "for_instructor"  # in an output's metadata: it is not on the student's page
TRUNCATED = "\n[This cell showed more than a notebook can hold. The rest is left out.]\n"

MIME_TYPES = (
    "text/plain", "text/html", "text/markdown", "text/latex", "image/png", "image/jpeg", "image/svg+xml",
)  # fmt: skip
SIZES = ("width", "height")  # of a picture, in pixels
MAX_PIXELS = 100_000


def mime_bundle(data: Mapping[str, Any], metadata: Mapping[str, Any] | None) -> dict[str, Any]:
    """The `data` and `metadata` of an output from what Jupyter's formatters give: pictures become text."""
    text = {
        mime: base64.b64encode(item).decode() if isinstance(item, bytes) else item
        for mime, item in data.items()
        if mime in MIME_TYPES and isinstance(item, (bytes, str))
    }
    return {"data": text, "metadata": image_metadata(metadata)}


def writable_text(text: str) -> str:
    """Text that every program can write to a file: a lone surrogate, such as "\\ud83d", becomes "?"."""
    return text.encode(errors="replace").decode()


def image_metadata(metadata: Any) -> dict[str, Any]:
    """The descriptions and sizes of pictures in an output's metadata; all else is dropped."""
    kept = {}
    for mime, settings in metadata.items() if isinstance(metadata, Mapping) else ():
        if mime in MIME_TYPES and isinstance(settings, Mapping):
            found = {key: settings[key] for key in SIZES if _is_size(settings.get(key))}
            if isinstance(settings.get("alt"), str):
                found["alt"] = writable_text(settings["alt"][:MAX_ALT_CHARS])
            if found:
                kept[mime] = found
    return kept


def _is_size(value: Any) -> bool:
    return type(value) is int and 0 < value < MAX_PIXELS


def output_size(output: dict[str, Any]) -> int:
    """The size of an output, in characters."""
    lines = output.get("traceback", ())
    about = [settings.get("alt", "") for settings in output.get("metadata", {}).values()]
    parts = [output.get("text", ""), *output.get("data", {}).values(), *lines, *about]
    error = output.get("ename", ""), output.get("evalue", "")
    return sum(map(len, (*parts, *error))) + 50 * (1 + len(lines))
