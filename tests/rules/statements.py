"""What of a lesson must have a row in its table of rules: sentences that state rules, as their words show."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tests.rules.table import Cell, Table, one_line

TRIGGER = re.compile(r"\b(always|never|must|mustn't|don't|rules?|please|cures?|poor|traps?)\b", re.I)
GOES_WRONG = re.compile(r"(?:#+ |\*\*)What goes wrong")
POOR_CODE = re.compile(r"please don't|#.*\bpoor\b", re.I)
CODE_BLOCK = re.compile(r"^```.*?^```", re.S | re.M)
BLOCK_BEGIN = re.compile(r"\n(?=[-|#>]|\d+\. |<)")  # of a list item, a table row, a heading, a tag
SENTENCE_END = re.compile(r"(?<=[.!?:])(?:\*\*)? +(?=\W*[A-Z`])")
DETAILS = re.compile(r"<details><summary>.*?</summary>(.*?)</details>", re.S)
ANSWER = re.compile(r"\n(?=\d+\. )")


def statements(cells: dict[str, Cell]) -> Iterator[tuple[str, str]]:
    """Cell and words of everything in a lesson that must have a row: "" for a cell that needs any row."""
    for name, cell in cells.items():
        if cell.kind == "code":
            if POOR_CODE.search(cell.source):
                yield name, ""
        elif _id(name) == "summary":
            yield from ((name, block) for block in blocks(cell.source) if block.startswith("- "))
        elif _id(name) == "check":
            yield from ((name, answer) for answer in answers(cell.source))
        elif _id(name) != "title":  # which says what a reader can do afterwards
            if GOES_WRONG.search(cell.source):
                yield name, ""
            yield from ((name, words) for words in sentences(cell.source) if TRIGGER.search(words))


def _id(name: str) -> str:
    """The id of a cell, without the name of its notebook."""
    return name.rpartition(".")[2]


def without_row(table: Table, cells: dict[str, Cell]) -> list[str]:
    """Each statement of a lesson that no row of its table quotes, with its cell."""
    quotes = [quote for rule in table.rules for quote in rule.quotes]
    found = []
    for name, words in statements(cells):
        known = quotes if not words or _id(name) in ("summary", "check") else [*quotes, *table.no_rule]
        if not any(cell == name and (not words or quoted in words) for cell, quoted in known):
            found.append(f"{name}: {words or 'says what goes wrong'}")
    return found


def blocks(text: str) -> list[str]:
    """The paragraphs, list items, table rows and headings of a cell, each on one line; no blocks of code."""
    parts = re.split(r"\n\s*\n", BLOCK_BEGIN.sub("\n\n", CODE_BLOCK.sub("", text)))
    return [one_line(part) for part in parts if part.strip()]


def sentences(text: str) -> list[str]:
    """The sentences of a cell, each on one line; a heading or a row of a table is one, too."""
    return [words for block in blocks(text) for words in SENTENCE_END.split(block)]


def answers(text: str) -> list[str]:
    """The answers to a lesson's questions, each on one line."""
    parts = [part for inside in DETAILS.findall(text) for part in ANSWER.split(inside)]
    return [one_line(part) for part in parts if part.strip()]
