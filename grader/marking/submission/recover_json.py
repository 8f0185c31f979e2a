"""Reads the JSON of a notebook's file, and recovers the cells of a damaged one."""

import codecs
import itertools
import json
import re
from collections.abc import Sequence
from typing import Any

from grader.marking.errors import Unusable
from grader.marking.submission.quoting import quote

MERGE_MARKS = (re.compile(r"^<{7} ", re.MULTILINE), re.compile(r"^>{7} ", re.MULTILINE))
WEB_PAGE = re.compile(r"<[!?a-zA-Z]")
CELLS = re.compile(r'"cells"\s*:\s*\[')
MAX_JSON_PARTS = 10_000_000  # each takes some 60 bytes, and notebooks of 100 MB in long lines have fewer
CELL = re.compile(r'\{\s*"(?:attachments|cell_type|execution_count|id|metadata|outputs|source)"\s*:')
MAX_DAMAGES, MAX_BEGINNINGS = 10, 20  # places that are skipped, and next cells that are tried at each
BETWEEN = re.compile(r"[\s,]*")
AGAIN = "Download the notebook again in JupyterLab (File, Download) and hand that in."


def read_json_object(data: bytes, file: str) -> tuple[dict[str, Any], list[str]]:
    """Return the JSON object in the bytes of the file called `file`, with a sentence for each odd thing.

    Raises Unusable, and nothing else.
    """
    if not data.strip(b"\0 \t\r\n"):
        saw = "is empty" if not data else "contains nothing but zeros and blanks"
        raise Unusable(f"{quote(file)} {saw}; expected a notebook. {AGAIN}")
    if data.startswith(b"PK\x03\x04"):
        problem = f"{quote(file)} is a zip archive; expected a notebook."
        raise Unusable(f"{problem} Unpack it and hand in the notebook inside.")
    if (parts := sum(map(data.count, (b"{", b"[", b",")))) > MAX_JSON_PARTS:
        raise Unusable(
            f"{quote(file)} is made of {parts / 1e6:.0f} million parts; at most {MAX_JSON_PARTS / 1e6:g} "
            "million can be read. Clear its outputs (Edit, Clear Outputs of All Cells) and hand it in again."
        )
    text, repairs = _decoded(data)
    twice: list[str] = []
    decoder = json.JSONDecoder(strict=False, object_pairs_hook=lambda pairs: _unique(pairs, twice))
    text = text.lstrip()
    try:
        value, end = decoder.raw_decode(text)
    except (ValueError, RecursionError) as error:
        value, end = {"nbformat": 4, "cells": _cells_before(text, error, decoder, file, repairs)}, len(text)
    if text[end:].strip():
        repairs.append("The notebook's file contained something else after its end; that was left out.")
    if twice:
        repairs.append(f"The notebook's file had {quote(twice[0])} twice in one place; the last was read.")
    if not isinstance(value, dict):
        raise Unusable(f"{quote(file)} contains JSON, but not a notebook. {AGAIN}")
    return value, repairs


def _decoded(data: bytes) -> tuple[str, list[str]]:
    encoding = json.detect_encoding(data)
    if not encoding.startswith("utf-8"):
        name = encoding[:6].upper()
        return data.decode(encoding, "replace"), [
            f"The notebook's file was saved as {name}; it was read as such."
        ]
    repairs = []
    if data.startswith(codecs.BOM_UTF8):
        repairs.append("The notebook's file began with a byte order mark; it was read without.")
        data = data.removeprefix(codecs.BOM_UTF8)
    if b"\0" in data:
        repairs.append("There were zero bytes in the notebook's file; they were left out.")
        data = data.replace(b"\0", b"")
    try:
        return data.decode(), repairs
    except UnicodeDecodeError:
        text = data.decode(errors="replace")
    bad, good = text.count("\ufffd"), sum(letter > "\x7f" and letter != "\ufffd" for letter in text)
    if good >= bad:
        saw = "1 character was damaged; it was" if bad == 1 else f"{bad} characters were damaged; they were"
        repairs.append(f"In the notebook's file {saw} read as �.")
        return text, repairs
    repairs.append("The notebook's file was not saved as UTF-8; it was read as Latin 1.")
    return data.decode("latin-1"), repairs


def _unique(pairs: Sequence[tuple[str, Any]], twice: list[str]) -> dict[str, Any]:
    """The object with these pairs; `twice` gets the first key that is repeated in it."""
    unique = dict(pairs)
    if len(unique) < len(pairs):
        left = dict.fromkeys(unique, True)
        twice.append(next(name for name, _ in pairs if not left.pop(name, False)))
    return unique


def _cells_before(
    text: str, error: Exception, decoder: json.JSONDecoder, file: str, repairs: list[str]
) -> list[Any]:
    """The complete cells of a file that is truncated or invalid, before the damage and after it."""
    _refuse_what_is_no_notebook(text, error, file)
    start = CELLS.search(text)
    cells: list[Any] = []
    left_out: list[int] = []  # how many cells stand before each damage that others follow
    position = _after_commas(text, start.end()) if start else len(text)
    while text[position : position + 1] not in ("", "]"):
        try:
            cell, position = decoder.raw_decode(text, position)
        except (ValueError, RecursionError):
            found = _next_cell(text, position + 1, decoder) if len(left_out) < MAX_DAMAGES else None
            if found is None:
                break
            left_out.append(len(cells))
            cell, position = found
        cells.append(cell)
        position = _after_commas(text, position)
    if not cells:
        raise Unusable(f"{quote(file)} is damaged from its beginning; expected a notebook. {AGAIN}")
    for before in left_out:
        where = f"after cell {before}" if before else "in its first cell"
        repairs.append(f"The notebook's file is damaged {where}; the next cell that can be read was marked.")
    if text[position : position + 1] != "]" or not left_out:
        repairs.append(
            f"The notebook's file is damaged after cell {len(cells)}; the cells before that were marked."
        )
    return cells


def _after_commas(text: str, position: int) -> int:
    between = BETWEEN.match(text, position)
    return between.end() if between else position


def _next_cell(text: str, position: int, decoder: json.JSONDecoder) -> tuple[dict[str, Any], int] | None:
    """The next cell from a position on, and where it ends; None if there is none that can be read."""
    for begin in itertools.islice(CELL.finditer(text, position), MAX_BEGINNINGS):
        try:
            cell, end = decoder.raw_decode(text, begin.start())
        except (ValueError, RecursionError):
            continue
        if "cell_type" in cell and "source" in cell:  # the metadata of nbgrader have a cell_type, too
            return cell, end
    return None


def _refuse_what_is_no_notebook(text: str, error: Exception, file: str) -> None:
    if isinstance(error, RecursionError):
        raise Unusable(f"{quote(file)} contains endlessly nested tables; expected a notebook. {AGAIN}")
    if all(mark.search(text) for mark in MERGE_MARKS):
        problem = (
            f"{quote(file)} contains git's merge conflict markers (`<<<<<<<`), which means two versions of "
            "it."
        )
        raise Unusable(f"{problem} Choose one, open it in JupyterLab, save it and hand it in again.")
    if WEB_PAGE.match(text):
        problem = f"{quote(file)} contains a web page, perhaps a login page; expected a notebook."
        raise Unusable(f"{problem} {AGAIN}")
    if not text.startswith("{"):  # it is not quoted: it may be a link to a file with a secret
        problem = f"{quote(file)} is not a notebook: expected JSON, beginning with `{{`, saw something else."
        raise Unusable(f"{problem} {AGAIN}")
