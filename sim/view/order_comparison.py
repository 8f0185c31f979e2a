"""An explored order beside the usual one, as HTML: a column for each node, around the first difference."""

from __future__ import annotations

from collections import Counter
from html import escape
from typing import NamedTuple

from sim.evidence import Departure, Recording
from sim.view.replay import replay

ROWS = 12  # of each run, around the first difference
BEFORE = 4  # of these, before it


class Row(NamedTuple):
    """One thing that happened: a callback, a message or an error of one node."""

    stamp: float
    node: str
    text: str
    kind: str  # callback, message or error


def comparison(explanation: str, usual: Recording, other: Recording | None) -> str:
    """An explanation, both runs around the first difference, and their replays if there is a robot.

    other: the run in another order; None if there is none.
    """
    parts = [f"<p>{escape(explanation)}</p>"]
    if other is not None and other.departures:
        parts.append(runs_side_by_side(usual, other))
        if other.world is not None:
            parts += [_replay("The usual order", usual), _replay("This order", other)]
    return f'<div class="sim-order">{_STYLE}{"".join(parts)}</div>'


def runs_side_by_side(usual: Recording, other: Recording) -> str:
    """Two tables, one for each run: what each node did around the first difference."""
    named = " ".join(departure.text for departure in other.departures)
    hidden = {node for node in other.course_nodes if node not in named}  # the robot, mostly
    rows = [[row for row in _rows(recording) if row.node not in hidden] for recording in (usual, other)]
    first = next(
        (i for i, pair in enumerate(zip(*rows, strict=False)) if pair[0] != pair[1]), min(map(len, rows))
    )
    begin = max(first - BEFORE, 0)
    shown = [run[begin : begin + ROWS] for run in rows]
    nodes = list(dict.fromkeys(row.node for run in shown for row in run))
    tables = [
        _table(title, run, nodes, other.departures if marked else [], first - begin)
        for title, run, marked in zip(("The usual order", "This order"), shown, (False, True), strict=True)
    ]
    return f'<div class="sim-orders">{"".join(tables)}</div>'


def _rows(recording: Recording) -> list[Row]:
    """Return what happened, in order: callbacks when they began, what was sent, the errors."""
    ran = Counter((run.stamp, run.node) for run in recording.callbacks)
    sent: dict[tuple[float, str], list[str]] = {}
    for message in recording.messages():
        sent.setdefault((message.stamp, message.sender), []).append(message.topic)
    found = []
    for run in recording.callbacks:
        at = run.stamp, run.node
        topics = sent.pop(at, []) if ran[at] == 1 else []  # else it is unknown which of them sent it
        text = f"{run.callback}()" + (f" → {', '.join(topics)}" if topics else "")
        found.append((run.stamp, 0, Row(run.stamp, run.node, text, "callback")))
    for (stamp, node), topics in sent.items():
        found.append((stamp, 1, Row(stamp, node, f"→ {', '.join(topics)}", "message")))
    for error in recording.errors:
        text = f"{error.callback}() fails: {error.type}{error.says}"
        found.append((error.stamp, 2, Row(error.stamp, error.node, text, "error")))
    return [row for _, _, row in sorted(found, key=lambda item: item[:2])]


def _table(title: str, rows: list[Row], nodes: list[str], departures: list[Departure], first: int) -> str:
    head = "".join(f"<th scope='col'>{escape(node)}</th>" for node in nodes)
    lines = []
    marks = {round(departure.stamp, 6): departure for departure in reversed(departures)}
    for index, row in enumerate(rows):
        departure = marks.pop(round(row.stamp, 6), None)
        if departure is not None:
            text = f"↷ {escape(departure.text)}"
            lines.append(f"<tr class='departure'><td></td><td colspan='{len(nodes)}'>{text}</td></tr>")
        cells = "".join(
            f"<td class='{row.kind}'>{escape(row.text)}</td>" if node == row.node else "<td></td>"
            for node in nodes
        )
        lines.append(f"<tr{' class=first' if index == first else ''}><td>{row.stamp:.4g} s</td>{cells}</tr>")
    caption = f"<caption>{escape(title)}</caption>"
    return f"<table>{caption}<tr><th scope='col'>time</th>{head}</tr>{''.join(lines)}</table>"


def _replay(title: str, recording: Recording) -> str:
    return f"<h4>{escape(title)}</h4>{replay(recording).html}"


_STYLE = """<style>
.sim-order p { max-width: 50em; }
.sim-orders { display: flex; flex-wrap: wrap; gap: 1.5em; align-items: flex-start; overflow-x: auto; }
.sim-orders table { border-collapse: collapse; font-size: 90%; }
.sim-orders caption { text-align: left; font-weight: bold; padding: 0.3em 0; }
.sim-orders table :is(td, th) {
  text-align: left !important; vertical-align: top; padding: 0.15em 0.7em; border-bottom: 1px solid #8884;
}
.sim-orders table tr { background: none; }
.sim-orders td:first-child { font-variant-numeric: tabular-nums; white-space: nowrap; }
.sim-orders table .departure td { color: #a04d00; font-style: italic; }
.sim-orders table td.error { color: #b3261e; font-weight: bold; }
.sim-orders table tr.first td { background: #ffb70340; }
[data-jp-theme-light="false"] .sim-orders table .departure td { color: #ffb266; }
[data-jp-theme-light="false"] .sim-orders table td.error { color: #ff8a80; }
</style>"""
