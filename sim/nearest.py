"""What a name that nobody knows was probably meant to be."""

import difflib
from collections.abc import Iterable


def nearest(name: str, names: Iterable[str], likeness: float = 0.6) -> str:
    """The one of the names that is most like this one, or "" where none is.

    likeness: how much the two must have in common at least, from 0, nothing, to 1, everything.
    """
    return next(iter(difflib.get_close_matches(name, list(names), n=1, cutoff=likeness)), "")


def unknown(kind: str, name: str, names: Iterable[str]) -> str:
    """The sentences for a name that none of this kind has: what was probably meant, and what there is."""
    names = list(names)
    near = nearest(name, names)
    guess = f"Did you mean {near!r}? " if near else ""
    return f"There is no {kind} {name!r}. {guess}The {kind}s are {', '.join(names)}."
