"""Tracks the cells of a notebook: which ran, which failed, and which were changed since.

The kernel knows which code it ran. Only the page knows that a cell was changed and not run: it sends the
source of all cells before it executes one. Without such a page, changes are unknown.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from sim.notebook.name_analysis import bound_names, defined_names, is_same_code, looked_up_names
from sim.suggestions import NAME_CUTOFF, closest_match

MIN_LENGTH = 4  # of a name: shorter ones are similar by chance


@dataclass(frozen=True)
class OutdatedName:
    """A name whose current value is older than the code in the notebook.

    error: the error of its cell, such as "SyntaxError: invalid syntax"; "" if the cell was changed and not
    run.
    """

    name: str
    error: str = ""

    @property
    def saw(self) -> str:
        """The observation, as a clause."""
        if self.error:
            return f"the cell with {self.name} ended with {self.error}"
        return f"the cell with {self.name} was changed, and has not run since"

    @property
    def hint(self) -> str:
        """Return what to do next."""
        if self.error:
            return "Fix that cell and run it; then run this one again."
        return "Run that cell (Shift+Enter); then run this one again."


class CellHistory:
    """The history of executed cells, and the names in `namespace` that they defined."""

    def __init__(self, namespace: Mapping[str, Any]) -> None:
        self._namespace = namespace
        self._before: dict[str, Any] = {}
        self._definition: dict[str, tuple[str, str]] = {}  # name: its last cell, with the source
        self._failed: dict[str, str] = {}  # name: the error of a later attempt to define it
        self._errors: dict[str, str] = {}  # cell: the error of its last execution; "" if none
        self._running = ""
        self._order: list[str] = []
        self._sources: dict[str, str] = {}

    def begin(self, cell: str, source: str) -> None:
        """A cell starts to execute."""
        self._running = cell
        self._before = {name: self._namespace.get(name) for name in self._names(cell, source)}

    def end(self, cell: str, source: str, error: str) -> None:
        """The cell has finished. error: the exception that ended it, or ""."""
        self._errors[cell] = error
        for name in self._names(cell, source):
            value = self._namespace.get(name)
            if value is None or (error and value is self._before.get(name)):
                self._failed |= {name: error} if error else {}
            elif not error or name in defined_names(source):
                self._definition[name] = cell, source
                self._failed.pop(name, None)

    def update(self, order: list[str], sources: dict[str, str]) -> None:
        """Store the state of the page: its cells from top to bottom, and the sources that have changed."""
        self._order = order
        self._sources = {cell: text for cell, text in {**self._sources, **sources}.items() if cell in order}

    def outdated(self, things: Iterable[Any]) -> OutdatedName | None:
        """The first name that these objects need and that is outdated; None if all are up to date."""
        for name in self._needed(things):
            if name in self._failed:
                return OutdatedName(name, self._failed[name])
            cell, source = self._definition.get(name, ("", ""))
            if cell in self._sources and not is_same_code(self._sources[cell], source):
                return OutdatedName(name)
        return None

    def objects_of(self, things: Iterable[Any]) -> list[Any]:
        """These objects, and those that they look up by a name of the notebook, directly or indirectly."""
        found: list[Any] = []
        waiting = list(things)
        while waiting:
            thing = waiting.pop(0)
            if not any(thing is other for other in found):
                found.append(thing)
                names = looked_up_names(thing)
                waiting += [self._namespace[name] for name in names if name in self._namespace]
        return found

    @property
    def sources(self) -> Mapping[str, str]:
        """The source of each cell, as the page last sent it; empty without a page."""
        return self._sources

    def explain_missing(
        self, name: str, order: list[str] | None = None, sources: dict[str, str] | None = None
    ) -> str:
        """Return how to define an undefined name; "" if no cell above defines it.

        order and sources: from the notebook's file, used if the page has sent none.
        """
        order, sources = self._order or order or [], self._sources or sources or {}
        above = order[: order.index(self._running)] if self._running in order else order
        cells = [cell for cell in above if name in bound_names(sources.get(cell, ""))]
        if not cells:
            return ""
        error = self._errors.get(cells[-1], "")
        if error:
            return (
                f"The cell above that defines `{name}` ended with {error}. Fix that cell and run it first."
            )
        return (
            f"A cell above defines `{name}`, and it has not run: "
            "choose Run > Run All Above Selected Cell, then run this cell again."
        )

    def suggest(self, name: str) -> str:
        """The defined name that an undefined one is likely a typo of, as a sentence; "" if there is none."""
        defined = [other for other in self._definition if other in self._namespace]
        near = closest_match(name, defined, NAME_CUTOFF) if len(name) >= MIN_LENGTH else ""
        return f"There is no `{name}`. Did you mean `{near}`?" if near else ""

    def _names(self, cell: str, source: str) -> set[str]:
        """The names that a cell defines now, and those that it defined when it was last executed."""
        return defined_names(source) | {name for name, (by, _) in self._definition.items() if by == cell}

    def _needed(self, things: Iterable[Any]) -> Iterator[str]:
        """The user's names of these objects, and all names that they look up, directly or indirectly."""
        known = self._definition.keys() | self._failed.keys()
        waiting = [name for thing in things for name in self._names_of(thing)]
        seen: set[str] = set()
        while waiting:
            name = waiting.pop(0)
            if name in known and name not in seen:
                seen.add(name)
                yield name
                waiting += looked_up_names(self._namespace.get(name))

    def _names_of(self, thing: Any) -> Iterator[str]:
        yield from (name for name, value in list(self._namespace.items()) if value is thing)
        yield from looked_up_names(thing)
