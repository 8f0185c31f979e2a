"""Eight traces of the counting node; some can happen, some can't."""

from grader.exercises.races.traces.interleavings import EXECUTORS, PARCELS, Trace, is_possible

SHORT = {
    1: "A0 A1 C1 C2 2 B2 B3",
    2: "C0 C1 A1 A2 B2 B3 3",
    3: "B0 B1 A1 A2 C2 C3 3",
    4: "A0 0 A1 C1 C2 B2 B3",
    5: "A0 C0 A1 C1 B1 B2 2",
    6: "A0 A1 C0 C1 B1 B2 2",
    7: "C1 C2 A0 A1 B1 B2 2",
    8: "A0 A1 C1 C2 B2 B3 2",
}


def _lines(short: str) -> Trace:
    """The lines of a trace. The first entry of a parcel is what it reads, the second what it writes."""
    lines: list[str] = []
    for entry in short.split():
        name, number = entry[:1], entry[1:]
        if name not in PARCELS:
            lines.append(f"report {entry}")
        elif f"{name} reads" in " ".join(lines):
            lines.append(f"{name} writes {number}")
        else:
            lines.append(f"{name} reads {number}")
    return tuple(lines)


TRACES: dict[int, Trace] = {number: _lines(short) for number, short in SHORT.items()}


def possible_traces(executor: str) -> set[int]:
    """Return the numbers of the traces that can happen under an executor."""
    if executor not in EXECUTORS:
        raise ValueError(f"executor must be one of {', '.join(EXECUTORS)}; it is {executor!r}.")
    return {number for number, trace in TRACES.items() if is_possible(trace, executor)}
