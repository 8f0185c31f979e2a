"""Finds files and modules that are older than the notebook's `%%writefile` cells."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

_WRITES = re.compile(r"%%writefile\s+(?!-a\b)(\S+)[^\n]*\n")


@dataclass(frozen=True)
class OutdatedFile:
    """A file whose cell was changed after it wrote it."""

    name: str

    @property
    def saw(self) -> str:
        """The observation, as a clause."""
        return f"the cell that writes {self.name} was changed, and has not run since"

    @property
    def hint(self) -> str:
        """Return what to do next."""
        return "Run that cell (Shift+Enter), then the cells that import the file; then run this one again."


@dataclass(frozen=True)
class OutdatedModule:
    """A module that was imported before its file was written again."""

    name: str

    @property
    def saw(self) -> str:
        """The observation, as a clause."""
        return f"the file of {self.name} was written again, and the module has not been reloaded since"

    @property
    def hint(self) -> str:
        """Return what to do next."""
        return f"Run the cell with importlib.reload({self.name}); then run this one again."


class WrittenFiles:
    """The files that cells of a notebook write."""

    def __init__(self) -> None:
        self._written: dict[str, tuple[str, str]] = {}  # path: the cell that wrote it last, with the source
        self._before = b""
        self._imported: dict[str, Any] = {}  # module: its spec when its file was written again

    def begin(self, source: str) -> None:
        """A cell starts to execute."""
        self._before = _read(written_path(source))

    def end(self, cell: str, source: str) -> None:
        """The cell has finished."""
        path = written_path(source)
        if not path:
            return
        self._written[path] = cell, source
        if _read(path) != self._before:
            for name, module in list(sys.modules.items()):
                if _file_of(module) == os.path.abspath(path):
                    self._imported[name] = module.__spec__

    def outdated(
        self, things: Iterable[Any], sources: Mapping[str, str]
    ) -> OutdatedFile | OutdatedModule | None:
        """The first file or module that these objects use and that is outdated.

        things: modules, objects of modules, and paths of files or folders. sources: of all cells of the page.
        A file that was changed elsewhere, as in an editor, is not outdated.
        """
        for path, (cell, source) in self._written.items():
            if sources.get(cell, source).rstrip() != source.rstrip() and _is_used(path, things):
                return OutdatedFile(path)
        for thing in things:
            spec = self._imported.get(name := _module_name(thing))
            if spec is not None and getattr(sys.modules.get(name), "__spec__", None) is spec:
                return OutdatedModule(name)
        return None


def written_path(source: str) -> str:
    """The path that a `%%writefile` cell writes; "" for other cells."""
    found = _WRITES.match(source)
    return found[1].strip("'\"") if found else ""


def _is_used(path: str, things: Iterable[Any]) -> bool:
    for thing in things:
        if isinstance(thing, str | Path):
            if Path(path).is_relative_to(thing):
                return True
        else:
            module = thing if isinstance(thing, ModuleType) else sys.modules.get(_module_name(thing))
            if _file_of(module) == os.path.abspath(path):
                return True
    return False


def _module_name(thing: Any) -> str:
    name = thing.__name__ if isinstance(thing, ModuleType) else getattr(thing, "__module__", "")
    return name if isinstance(name, str) else ""


def _file_of(module: Any) -> str | None:
    file = getattr(module, "__file__", None)
    return os.path.abspath(file) if isinstance(file, str) else None


def _read(path: str) -> bytes:
    try:
        return Path(path).read_bytes()
    except OSError:
        return b""
