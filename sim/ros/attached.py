"""What a run attaches to objects of rclpy and Python: one attribute, `_sim`, of one type for each kind."""

from __future__ import annotations

from collections.abc import Callable
from operator import attrgetter
from typing import Any, Generic, TypeVar

T = TypeVar("T")


class Attached(Generic[T]):
    """The accessor of what is attached to one kind of object. Each is declared beside its type.

    of: returns what an object has; AttributeError if it was created outside a run.
    """

    def __init__(self) -> None:
        self.of: Callable[[Any], T] = attrgetter("_sim")  # called for each message, and in C

    def find(self, owner: Any) -> T | None:
        """Return what an object has; None if it was created outside a run."""
        return owner.__dict__.get("_sim")

    def attach(self, owner: Any, part: T) -> T:
        """Attach this, and return it."""
        owner._sim = part
        return part

    def detach(self, owner: Any) -> T | None:
        """Return what an object has, and take it away."""
        return owner.__dict__.pop("_sim", None)
