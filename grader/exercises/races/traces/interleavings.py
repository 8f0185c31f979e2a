"""Which traces a counting node can have: a search through all orders of its statements.

The node has two callbacks. `on_parcel` runs for the parcels A and B, which come from one publisher in this
order, and for C from another; `on_report` runs once. The notebook of the assignment shows their code.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

SINGLE, EXCLUSIVE, REENTRANT = EXECUTORS = "single", "exclusive", "reentrant"
PARCELS, REPORT = ("A", "B", "C"), "report"
STATEMENTS = {**dict.fromkeys(PARCELS, ("read", "publish", "write", "publish")), REPORT: ("read", "publish")}

Trace = tuple[str, ...]
"""The lines that the node publishes, such as "A reads 0", "A writes 1" and "report 1"."""


class State(NamedTuple):
    """The progress of a node: the next statement of each callback, what each has read, and the total."""

    at: dict[str, int]
    read: dict[str, int]
    total: int
    lines: int  # that were published


def is_possible(trace: Trace, executor: str) -> bool:
    """Return whether the node can publish exactly these lines under this executor.

    executor: "single", for one thread. "exclusive": several threads, a mutually exclusive group for the
    parcels, and another for the report. "reentrant": several threads, and a reentrant group for all.
    """
    return _leads_to(trace, executor, State(dict.fromkeys(STATEMENTS, 0), {}, 0, 0))


def _leads_to(trace: Trace, executor: str, state: State) -> bool:
    if all(state.at[name] == len(STATEMENTS[name]) for name in STATEMENTS):
        return state.lines == len(trace)
    return any(_leads_to(trace, executor, after) for after in _next(trace, executor, state))


def _next(trace: Trace, executor: str, state: State) -> Iterator[State]:
    """The states after one more statement, as far as they fit the trace."""
    for name, statements in STATEMENTS.items():
        at = state.at[name]
        if at == len(statements) or not (at or _may_start(name, executor, state)):
            continue
        moved = state._replace(at={**state.at, name: at + 1})
        if statements[at] == "read":
            yield moved._replace(read={**state.read, name: state.total})
        elif statements[at] == "write":
            yield moved._replace(total=state.read[name] + 1)
        elif trace[state.lines : state.lines + 1] == (_line(name, at, state.read[name]),):
            yield moved._replace(lines=state.lines + 1)


def _may_start(name: str, executor: str, state: State) -> bool:
    running = {other for other in STATEMENTS if 0 < state.at[other] < len(STATEMENTS[other])}
    if executor == REENTRANT:
        return True
    if name == "B" and state.at["A"] < len(STATEMENTS["A"]):
        return False  # its message is behind that of A, in the same queue
    same_group = running & set(PARCELS) if name in PARCELS else running - set(PARCELS)
    return not (running if executor == SINGLE else same_group)


def _line(name: str, at: int, read: int) -> str:
    if name == REPORT:
        return f"report {read}"
    return f"{name} reads {read}" if at == 1 else f"{name} writes {read + 1}"
