"""Reads what was appended to a list since the last look: lists of a recording, its graph and its recorder."""

from __future__ import annotations

from typing import Generic, TypeVar

T = TypeVar("T")


class NewItems(Generic[T]):
    """The items appended to a list since the last call of `take`."""

    def __init__(self, items: list[T]) -> None:
        self._items, self._taken = items, 0

    def take(self) -> list[T]:
        """The new items; each is returned once."""
        start, self._taken = self._taken, len(self._items)
        return self._items[start:] if start < self._taken else []
