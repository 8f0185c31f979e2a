"""Quotes names and values of a submission in sentences for the student and the instructor."""

from collections.abc import Iterable
from typing import Any

NAMES_LISTED = 5
NAME_LENGTH = 60  # characters


def quote(name: object) -> str:
    """Return an untrusted name as inline code of Markdown: short, printable and on one line."""
    plain = str(name).encode(errors="replace").decode()
    plain = "".join(letter if letter.isprintable() and letter != "`" else "?" for letter in plain)
    return f"`{plain if len(plain) <= NAME_LENGTH else plain[: NAME_LENGTH - 1] + '…'}`"


def list_names(names: Iterable[object]) -> str:
    """Return the first names as in "`a`, `b` and 3 more"."""
    every = [quote(name) for name in names]
    if len(every) <= NAMES_LISTED:
        return " and ".join([", ".join(every[:-1]), every[-1]] if len(every) > 1 else every)
    return f"{', '.join(every[:NAMES_LISTED])} and {len(every) - NAMES_LISTED} more"


def kind_of_value(value: Any) -> str:
    """Return the kind of a JSON value in words that need no knowledge of JSON."""
    kinds = {bool: "true or false", int: "a number", float: "a number", str: "text", list: "a list"}
    return "nothing" if value is None else kinds.get(type(value), "a table")
