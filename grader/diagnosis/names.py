"""Names of topics, services and actions that nearly match."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

from sim.evidence import INFRASTRUCTURE_TOPICS, Recording
from sim.nearest import nearest

_LIKENESS = 0.75


def shared_name(recording: Recording) -> str:
    """A node of the student's with the name of one that the exercise or the world brings along."""
    if not recording.shared:
        return ""
    name = min(recording.shared)
    return (
        f"Two nodes are called {name}, yours and one that takes part in this exercise, and nobody can tell "
        "them apart: give yours a name of its own, in super().__init__('...')."
    )


def typing_slip(recording: Recording) -> str:
    """A topic with only publishers and one with only subscriptions, whose names are nearly the same."""
    published = {e.name: e.node for e in recording.graph.publishers() if e.name not in INFRASTRUCTURE_TOPICS}
    heard = {e.name: e.node for e in recording.graph.subscriptions() if e.name not in INFRASTRUCTURE_TOPICS}
    lonely = [name for name in published if name not in heard]
    for wanted in heard:
        near = closest(wanted, lonely) if wanted not in published else ""
        if near:
            return (
                f"{published[near]} publishes on {near}, {heard[wanted]} listens on {wanted}: "
                f"two different topics. {difference(near, wanted)}"
            )
    return ""


def service_slip(recording: Recording) -> str:
    """A client for something that nobody offers, of nearly the same name as what somebody does offer."""
    for kind, client_kind, what in (
        ("service", "client", "services"),
        ("action server", "action client", "actions"),
    ):
        offered = {end.name: end.node for end in recording.graph.ends(kind)}
        wanted = {end.name: end.node for end in recording.graph.ends(client_kind)}
        lonely = [name for name in offered if name not in wanted]
        for name in wanted:
            near = closest(name, lonely) if name not in offered else ""
            if near:
                return (
                    f"{wanted[name]} calls {name}, {offered[near]} offers {near}: two different {what}. "
                    f"{difference(near, name)}"
                )
    return ""


def closest(wanted: str, candidates: Iterable[str]) -> str:
    """The candidate that was probably meant to be `wanted`, or ""."""
    names = sorted(candidates)
    for name in names:
        if _leaf(name) == _leaf(wanted) or _folded(name) == _folded(wanted):
            return name
    return nearest(wanted, names, _LIKENESS)


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
    return difflib.SequenceMatcher(None, one, other).ratio() >= _LIKENESS


def _folded(name: str) -> str:
    return name.lower().replace("_", "").replace("/", "")
