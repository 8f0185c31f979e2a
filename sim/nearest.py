"""What a name that nobody knows was probably meant to be."""

import difflib
from collections.abc import Iterable

LIKENESS = 0.75  # of two names of topics or services, so that one was probably meant to be the other


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


def closest(wanted: str, candidates: Iterable[str]) -> str:
    """The candidate that was probably meant to be `wanted`, or ""."""
    names = sorted(candidates)
    for name in names:
        if _leaf(name) == _leaf(wanted) or _folded(name) == _folded(wanted):
            return name
    return nearest(wanted, names, LIKENESS)


def difference(found: str, wanted: str) -> str:
    """A sentence on what makes `found` another name than `wanted`."""
    if found.lower() == wanted.lower():
        return f"Capital letters count: write {wanted}."
    if _leaf(found) == _leaf(wanted) and not _alike(_space(found), _space(wanted)):
        return (
            f"Only the namespace differs: write {wanted}. A name that starts with a slash is taken as it is; "
            "without the slash the node's namespace is put before it."
        )
    return f"Is {found} a typing slip? Did you mean {wanted}?"


def _leaf(name: str) -> str:
    return name.rsplit("/", 1)[-1]


def _space(name: str) -> str:
    return name.rsplit("/", 1)[0]


def _alike(one: str, other: str) -> bool:
    return difflib.SequenceMatcher(None, one, other).ratio() >= LIKENESS


def _folded(name: str) -> str:
    return name.lower().replace("_", "").replace("/", "")
