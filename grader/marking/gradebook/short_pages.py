"""Shortens notebooks for their pages, because highlighting code and cleaning HTML take time.

The page of a hostile notebook could take hours or all memory; the feedback of a class, and the formgrader,
would wait for it. The notebook itself is not shortened.
"""

import re
from typing import Any

from nbformat.v4 import new_output

MAX_TEXT_CHARS = 50_000  # of one text
MAX_OUTPUT_CHARS = 20_000  # of what a cell prints, or of an error: one half is its beginning, one its end
MAX_PAGE_CHARS = 1_000_000  # of all texts of a page
OUTPUT = 500  # characters that an output counts for at least
REPLAY = 40_000  # that a replay counts for: its player is in the page, too
MARKUP = 4  # weight of a character of markup, which takes longer than other text
DATA = re.compile(r"[A-Za-z0-9+/=]{100,}")  # of a picture or a replay, which is not processed
TOO_LONG = "This is too long to be shown here."


def too_long(html: str) -> bool:
    """Return whether it is too long to be cleaned in a short time."""
    return _length(html) > MAX_TEXT_CHARS


def shorten(notebook: Any, resources: Any) -> tuple[Any, Any]:
    """A preprocessor of nbconvert: shortens long texts, and leaves out outputs when the page is full."""
    room = MAX_PAGE_CHARS
    for cell in notebook.cells:
        room -= len(cell.source)
        if len(cell.source) > MAX_TEXT_CHARS or room < 0:
            cell.source = f"# {TOO_LONG}" if cell.cell_type == "code" else TOO_LONG
        for number, output in enumerate(cell.get("outputs", ())):
            _shorten_texts(output)
            room -= _cost(output)
            if room < 0:
                cell.outputs[number:] = [new_output("stream", text=f"{TOO_LONG}\n")]
                break
    return notebook, resources


def _shorten_texts(output: Any) -> None:
    if "text" in output:
        output.text = _ends(output.text)
    if "text/plain" in output.get("data", {}):
        output.data["text/plain"] = _ends(output.data["text/plain"])
    if "traceback" in output:
        output.traceback = _ends("\n".join(output.traceback)).split("\n")


def _ends(text: str) -> str:
    """The beginning and the end of a text, with the number of characters between them."""
    half, more = MAX_OUTPUT_CHARS // 2, len(text) - MAX_OUTPUT_CHARS
    return text if more <= 0 else f"{text[:half]}\n[... {more:,} more characters ...]\n{text[-half:]}"


def _cost(output: Any) -> int:
    data = output.get("data", {})
    markup = [data[kind] for kind in ("text/html", "text/markdown") if kind in data]
    texts = [data.get("text/plain", ""), output.get("text", ""), *output.get("traceback", ())]
    replays = sum("data-replay" in text or "data-plot" in text for text in markup)
    return OUTPUT + REPLAY * replays + MARKUP * sum(map(_length, markup)) + sum(map(len, texts))


def _length(text: str) -> int:
    return len(DATA.sub("", text))
