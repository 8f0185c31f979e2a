"""Suggests the correct name for a misspelt one."""

import difflib
from collections.abc import Iterable

MAX_EDITS = 3  # differences of two texts that a sentence names, and characters of one
NAME_CUTOFF = 0.75  # least similarity of two topic or service names to take one for a typo of the other


def closest_match(name: str, names: Iterable[str], cutoff: float = 0.6) -> str:
    """The most similar of the names, or "" if none is similar enough.

    cutoff: the least similarity, from 0 (nothing in common) to 1 (equal).
    """
    return next(iter(difflib.get_close_matches(name, list(names), n=1, cutoff=cutoff)), "")


def unknown_name(kind: str, name: str, names: Iterable[str]) -> str:
    """The error text for an unknown name of this kind: a suggestion, and the names that exist."""
    names = list(names)
    near = closest_match(name, names)
    guess = f"Did you mean {near!r}? " if near else ""
    return f"There is no {kind} {name!r}. {guess}The {kind}s are {', '.join(names)}."


def closest_ros_name(wanted: str, candidates: Iterable[str]) -> str:
    """The candidate that is most likely a typo of the ROS name `wanted`, or ""."""
    names = sorted(candidates)
    for name in names:
        if _base_name(name) == _base_name(wanted) or _folded(name) == _folded(wanted):
            return name
    return closest_match(wanted, names, NAME_CUTOFF)


def describe_difference(found: str, wanted: str) -> str:
    """A sentence that says how the name `found` differs from `wanted`."""
    if found.lower() == wanted.lower():
        return f"Capital letters count: write {wanted}."
    if _base_name(found) == _base_name(wanted) and not _is_similar(_namespace(found), _namespace(wanted)):
        return (
            f"Only the namespace differs: write {wanted}. A name that starts with a slash is taken as it is; "
            "without the slash the node's namespace is put before it."
        )
    return f"Is {found} a typo? Did you mean {wanted}?"


def describe_text_difference(found: str, wanted: str) -> str:
    """A sentence that says in which characters the text `found` differs from `wanted`."""
    if found.casefold() == wanted.casefold():
        return f"Capital letters count: write “{wanted}”."
    edits = [
        edit
        for edit in difflib.SequenceMatcher(None, found, wanted, autojunk=False).get_opcodes()
        if edit[0] != "equal"
    ]
    if len(edits) > MAX_EDITS or any(max(b - a, d - c) > MAX_EDITS for _, a, b, c, d in edits):
        return "Compare the two texts letter by letter."
    parts = [_describe_edit(found[a:b], wanted[c:d], found[:a]) for _, a, b, c, d in edits]
    return f"Compare the two texts: {'; '.join(parts)}."


def _describe_edit(found: str, wanted: str, before: str) -> str:
    place = f"after “{before.split(' ')[-1] or before}”" if before.strip() else "at the beginning"
    if not found:
        return f"“{wanted}” is missing {place}"
    return f"remove “{found}” {place}" if not wanted else f"write “{wanted}” for “{found}” {place}"


def _base_name(name: str) -> str:
    return name.rsplit("/", 1)[-1]


def _namespace(name: str) -> str:
    return name.rsplit("/", 1)[0]


def _is_similar(one: str, other: str) -> bool:
    return difflib.SequenceMatcher(None, one, other).ratio() >= NAME_CUTOFF


def _folded(name: str) -> str:
    return name.lower().replace("_", "").replace("/", "")
