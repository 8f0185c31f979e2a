"""What has become of a notebook's cells: which ran, which failed, and which were changed since.

A kernel knows what it ran. That a cell was changed and not run, only the page knows, which sends the text of
the cells before it has one run; without such a page it is not known.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from sim.notebook.names import bound, defined, looked_up, same


@dataclass(frozen=True)
class Outdated:
    """A name whose newest version in the notebook is not the one that would run.

    error: how its cell ended, such as "SyntaxError: invalid syntax"; "" if it was changed and not run.
    """

    name: str
    error: str = ""

    @property
    def saw(self) -> str:
        """What was seen, as the end of a sentence."""
        if self.error:
            return f"the cell with {self.name} ended with {self.error}"
        return f"the cell with {self.name} was changed, and has not run since"

    @property
    def hint(self) -> str:
        """What to do next."""
        if self.error:
            return "Mend that cell and run it; then run this one again."
        return "Run that cell (Shift+Enter); then run this one again."


class Cells:
    """Told of every cell that begins and ends, it answers for the names in `namespace`, the user's own."""

    def __init__(self, namespace: Mapping[str, Any]) -> None:
        self._namespace = namespace
        self._before: dict[str, Any] = {}
        self._maker: dict[str, tuple[str, str]] = {}  # name: the cell that defined it last, and its text then
        self._failed: dict[str, str] = {}  # name: how a later try to define it ended
        self._errors: dict[str, str] = {}  # cell: how its last run ended; "" if well
        self._running = ""
        self._order: list[str] = []
        self._texts: dict[str, str] = {}

    def begin(self, cell: str, source: str) -> None:
        """A cell is about to run."""
        self._running = cell
        self._before = {name: self._namespace.get(name) for name in self._names(cell, source)}

    def end(self, cell: str, source: str, error: str) -> None:
        """It has run. error: what stopped it; "" if nothing did."""
        self._errors[cell] = error
        for name in self._names(cell, source):
            there = self._namespace.get(name)
            if there is None or (error and there is self._before.get(name)):
                self._failed |= {name: error} if error else {}
            elif not error or name in defined(source):
                self._maker[name] = cell, source
                self._failed.pop(name, None)

    def shown(self, order: list[str], texts: dict[str, str]) -> None:
        """What the page shows: its cells from top to bottom, and the texts that have changed."""
        self._order = order
        self._texts = {cell: text for cell, text in {**self._texts, **texts}.items() if cell in order}

    def outdated(self, things: Iterable[Any]) -> Outdated | None:
        """Why these, or what they need, are not as the notebook has them; None if all are."""
        for name in self._needed(things):
            if name in self._failed:
                return Outdated(name, self._failed[name])
            cell, source = self._maker.get(name, ("", ""))
            if cell in self._texts and not same(self._texts[cell], source):
                return Outdated(name)
        return None

    def missing(self, name: str, order: list[str] | None = None, texts: dict[str, str] | None = None) -> str:
        """What to do about a name that is not there; "" if no cell above defines it.

        order and texts: of the notebook's file, where no page has told.
        """
        order, texts = self._order or order or [], self._texts or texts or {}
        above = order[: order.index(self._running)] if self._running in order else order
        makers = [cell for cell in above if name in bound(texts.get(cell, ""))]
        if not makers:
            return ""
        error = self._errors.get(makers[-1], "")
        if error:
            return (
                f"The cell above that defines `{name}` ended with {error}. Mend that cell and run it first."
            )
        return (
            f"A cell above defines `{name}`, and it has not run: "
            "choose Run > Run All Above Selected Cell, then run this cell again."
        )

    def _names(self, cell: str, source: str) -> set[str]:
        """What a cell defines, and what it defined when it could still be read."""
        return defined(source) | {name for name, (maker, _) in self._maker.items() if maker == cell}

    def _needed(self, things: Iterable[Any]) -> Iterator[str]:
        """The user's own names of these things, and those that they look up, by way of others too."""
        known = self._maker.keys() | self._failed.keys()
        waiting = [name for thing in things for name in self._names_of(thing)]
        seen: set[str] = set()
        while waiting:
            name = waiting.pop(0)
            if name in known and name not in seen:
                seen.add(name)
                yield name
                waiting += looked_up(self._namespace.get(name))

    def _names_of(self, thing: Any) -> Iterator[str]:
        yield from (name for name, value in list(self._namespace.items()) if value is thing)
        yield from looked_up(thing)
