"""What is new in lists that only grow: those of a recording, of its graph and of the recorder."""

from __future__ import annotations

from typing import Generic, TypeVar

T = TypeVar("T")


class News(Generic[T]):
    """What was added to a list since the last look at it."""

    def __init__(self, items: list[T]) -> None:
        self._items, self._seen = items, 0

    def take(self) -> list[T]:
        """What is new; next time it isn't."""
        start, self._seen = self._seen, len(self._items)
        return self._items[start:] if start < self._seen else []
