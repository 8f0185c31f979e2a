"""The sentences about repaired cells: one sentence for all cells with the same repair."""

from collections.abc import Mapping
from types import MappingProxyType

from grader.marking.submission.quoting import list_names

# Of one cell, of several. Repairs: for student and instructor.
REPAIRS: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "found by id": (
            "The cell {} had lost its name; it was found by its id.",
            "The cells {} had lost their names; they were found by their ids.",
        ),
        "found by text": (
            "The cell {} had lost its name; it was found by its text and place.",
            "The cells {} had lost their names; they were found by their text and place.",
        ),
        "answer twice": (
            "The cell {} was in the notebook more than once; the last one with an answer was marked.",
            "The cells {} were in the notebook more than once; the last ones with an answer were marked.",
        ),
        "answer of another type": (
            "The type of the cell {} was changed; its text was used anyway.",
            "The types of the cells {} were changed; their texts were used anyway.",
        ),
        "answer missing": (
            "The answer {} was missing; an empty cell took its place.",
            "The answers {} were missing; empty cells took their places.",
        ),
        "test twice": (
            "The test cell {} was in the notebook more than once; it was run once.",
            "The test cells {} were in the notebook more than once; they were run once.",
        ),
        "test of another type": (
            "The type of the test cell {} was changed; the instructor's own was run.",
            "The types of the test cells {} were changed; the instructor's own were run.",
        ),
        "test missing": (
            "The test cell {} was missing; the instructor's own was run.",
            "The test cells {} were missing; the instructor's own were run.",
        ),
        "moved": (
            "The cell {} was not in its place in the assignment; it was run there.",
            "The cells {} were not in their places in the assignment; they were run there.",
        ),
        "test older": (
            "The test cell {} came from another version of the assignment; the current one was run.",
            "The test cells {} came from another version of the assignment; the current ones were run.",
        ),
        "test of another variant": (
            "The test cell {} came from another variant of the task; that of the student's own was run.",
            "The test cells {} came from other variants of the tasks; those of the student's own were run.",
        ),
        "code missing": (
            "The cell {} was missing; the one that was handed out was run.",
            "The cells {} were missing; those that were handed out were run.",
        ),
    }
)
# Flags: for the instructor alone.
FLAGS: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "test edited": (
            "The test cell {} was edited; the instructor's own was run.",
            "The test cells {} were edited; the instructor's own were run.",
        ),
        "settings changed": (
            "The points or other settings of the cell {} were changed; the instructor's own count.",
            "The points or other settings of the cells {} were changed; the instructor's own count.",
        ),
        "test to be skipped": (
            "The test cell {} was tagged `skip-execution`; it was run.",
            "The test cells {} were tagged `skip-execution`; they were run.",
        ),
        "name of another": (
            "The cell {} had the name of another; it was recognized by its id.",
            "The cells {} had the names of others; they were recognized by their ids.",
        ),
    }
)


class Notes:
    """Collects the repairs and flags of cells."""

    def __init__(self) -> None:
        self._cells: dict[str, list[str]] = {}

    def add(self, about: str, cell: str) -> None:
        """Note a thing, by its key in REPAIRS or FLAGS, of the cell with this name."""
        cells = self._cells.setdefault(about, [])
        if cell not in cells:
            cells.append(cell)

    def sentences(self, texts: Mapping[str, tuple[str, str]]) -> list[str]:
        """Return a sentence for each thing that was noted and is a key of `texts`."""
        return [
            one_or_several[len(self._cells[about]) > 1].format(list_names(self._cells[about]))
            for about, one_or_several in texts.items()
            if about in self._cells
        ]
