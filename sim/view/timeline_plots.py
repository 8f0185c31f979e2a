"""`plot_topics`, `plot_logs` and `plot_signal`: messages, log lines and errors over simulated time."""

from __future__ import annotations

import functools
import itertools
import math
import numbers
import statistics
from collections.abc import Iterator, Sequence
from typing import Any

from matplotlib.axes import Axes

from sim.evidence import Recording, rate, stamps
from sim.view.field_labels import field_label, is_command, panel_unit
from sim.view.plot import (
    CAUTION,
    GRID,
    MARKERS,
    MUTED,
    PATH,
    SOLID,
    STYLES,
    WARNING,
    Plot,
    legend_beside,
    note_failure,
    plot,
)
from sim.view.plot_data import FEW, panel, plot_data, row, series
from sim.view.units import unit_of

LEVELS = {
    "DEBUG": (MUTED, "."),
    "INFO": (PATH, "|"),
    "WARN": (CAUTION, "^"),
    "ERROR": (WARNING, "x"),
    "FATAL": ("black", "*"),
}
_PALETTE = {SOLID: "muted", MUTED: "muted", CAUTION: "caution", WARNING: "warning", "black": "warning"}
SILENCE = 5  # a gap of this many median intervals breaks a line


def plot_topics(recording: Recording, topics: Sequence[str] | None = None) -> Plot:
    """One row per topic with a tick for each message, then the log lines and the errors.

    topics: names from top to bottom. If omitted, all topics of the run, then the services with a tick for
    each call, and the actions with a tick for each change of a goal's status.
    """
    names = list(recording.topics if topics is None else topics)
    rows = [(_label(recording, name), stamps(recording.messages(name)), PATH) for name in names]
    rows += _exchanges(recording) if topics is None else []
    if recording.logs:
        rows.append((f"log lines\n{len(recording.logs)}", [line.stamp for line in recording.logs], SOLID))
    if recording.errors:
        rows.append(("errors", [error.stamp for error in recording.errors], WARNING))
    figure, axes = plot(7.2, 0.9 + 0.5 * max(len(rows), 1))
    for height, (_, moments, color) in enumerate(rows):
        axes.plot(moments, [height] * len(moments), "|", color=color, markersize=16, markeredgewidth=1.5)
    _along_time(recording, axes, [label for label, _, _ in rows])
    ticks = [row(label, moments, _PALETTE.get(color, 0)) for label, moments, color in rows]
    figure.offer(plot=plot_data(recording, "Messages over time", rows=ticks))
    return note_failure(figure, recording)


def _exchanges(recording: Recording) -> list[tuple[str, list[float], str]]:
    """A row for each called service and each action with a goal."""
    rows = []
    for service in dict.fromkeys(call.service for call in recording.calls_of()):
        calls = recording.calls_of(service)
        begun = (call.taken if call.requested is None else call.requested for call in calls)
        moments = [stamp for stamp in begun if stamp is not None]
        rows.append((f"{service}\n{_count(calls, 'call')}", moments, PATH))
    for action in dict.fromkeys(goal.action for goal in recording.goals):
        goals = recording.goals_of(action)
        moments = [stamp for goal in goals for stamp, _ in goal.events]
        rows.append((f"{action}\n{_count(goals, 'goal')}", moments, PATH))
    return rows


def _count(items: Sequence[Any], noun: str) -> str:
    return f"{len(items)} {noun}{'s' * (len(items) != 1)}"


def plot_logs(recording: Recording) -> Plot:
    """One row per logger with a tick for each log line; the color is its level."""
    names = sorted({line.node for line in recording.logs})
    figure, axes = plot(7.2, 0.9 + 0.5 * max(len(names), 1))
    for level, (color, marker) in LEVELS.items():
        lines = [line for line in recording.logs if line.level == level]
        if lines:
            moments, rows = [line.stamp for line in lines], [names.index(line.node) for line in lines]
            size = 16 if marker == "|" else 9
            look: dict[str, Any] = {"color": color, "markersize": size, "markeredgewidth": 2, "label": level}
            axes.plot(moments, rows, marker, **look)
    _along_time(recording, axes, names)
    figure.offer(plot=plot_data(recording, "Log lines over time", rows=_log_rows(recording, names)))
    if names:
        legend_beside(axes)
    return note_failure(figure, recording)


def _log_rows(recording: Recording, names: Sequence[str]) -> list[dict[str, Any]]:
    """A row of ticks for each logger and each of its levels."""
    rows = []
    for name, level in itertools.product(names, LEVELS):
        moments = [line.stamp for line in recording.logs if (line.node, line.level) == (name, level)]
        if moments:
            rows.append(row(f"{name}, {level}", moments, _PALETTE.get(LEVELS[level][0], 0)))
    return rows


def _along_time(recording: Recording, axes: Axes, rows: Sequence[str]) -> None:
    """Set up the time axis, and the rows from top to bottom."""
    axes.set(xlabel="time (s)", xlim=(-0.02 * _end(recording), 1.02 * _end(recording)))
    axes.set_yticks(range(len(rows)), rows)
    axes.set_ylim(max(len(rows), 1) - 0.5, -0.5)
    axes.grid(axis="x", color=GRID)


def _label(recording: Recording, topic: str) -> str:
    moments = stamps(recording.messages(topic))
    frequency = f", {rate(moments):.3g} Hz" if rate(moments) else ""
    return f"{topic}\n{len(moments)}{frequency}"


def plot_signal(recording: Recording, topic: str, *fields: str, unit: str | None = None) -> Plot:
    """Plot numeric fields of a topic's messages over time. The line is broken at gaps without messages.

    fields: such as "linear.x", or "position.0" for an item of a list, which has a line for each joint that
        has this place in a message; "data" if omitted.
    unit: for the axis, such as "V"; if omitted, the unit that the message definition specifies.
    Raises ValueError when there are no messages, no such field, or no numbers in it.
    """
    received = recording.messages(topic)
    if not received:
        known = ", ".join(recording.topics) or "no topics"
        raise ValueError(f"there are no messages on {topic} to draw; this run has {known}")
    messages = [item.message for item in received]
    figure, axes = plot(7.2, 3.2)
    fields = fields or ("data",)
    command = is_command(topic, received[0].type)
    panels: dict[str, list[dict[str, Any]]] = {}
    found = [curve for field in fields for curve in _curves(received, messages, field, topic)]
    looks = itertools.cycle(STYLES), itertools.cycle(MARKERS)
    for (label, of_curve, points), style, marker in zip(found, *looks, strict=False):
        look: dict[str, Any] = {"linestyle": style, "marker": marker if len(points) <= FEW else ""}
        look |= {"linewidth": 1.2, "markersize": 4, "drawstyle": "steps-post" if command else "default"}
        times, drawn = _broken(*zip(*points, strict=True))
        axes.plot(times, drawn, **look, label=label)
        curves = panels.setdefault(of_curve if unit is None else unit, [])
        # The page counts the colors of a panel from that of its first curve: no two panels begin with one.
        first = len(panels) - 1 if not curves else curves[0]["color"]
        curves.append(series(label, times, drawn, style="step" if command else "line", color=first))
    if unit is None:
        unit = ", ".join(dict.fromkeys(filter(None, (unit_of(messages[0], field) for field in fields))))
    axes.set(xlabel="time (s)", ylabel=unit, title=topic, xlim=(0.0, _end(recording)))
    axes.grid(color=GRID)
    axes.legend(framealpha=0.9, edgecolor="none")  # legible even on top of a line
    shown = [panel(name, curves) for name, curves in panels.items()]
    figure.offer(plot=plot_data(recording, topic, panels=shown))
    return note_failure(figure, recording)


def _curves(
    received: Sequence[Any], messages: Sequence[Any], field: str, topic: str
) -> Iterator[tuple[str, str, list[tuple[float, float]]]]:
    """The label, the unit and the points of each curve of a field: one for each name that its item has."""
    curves: dict[str, tuple[str, list[tuple[float, float]]]] = {}
    for item, message in zip(received, messages, strict=True):
        label = field_label(message, field)
        _, points = curves.setdefault(label, (panel_unit(message, field), []))
        points.append((item.stamp, _number(message, field, topic)))
    for label, (unit, points) in curves.items():
        yield label, unit, points


def _broken(moments: Sequence[float], values: Sequence[float]) -> tuple[list[float], list[float]]:
    """The points with NaN in long gaps, because a line across a gap would suggest measurements."""
    gaps = [after - before for before, after in itertools.pairwise(moments)]
    longest = SILENCE * statistics.median(gaps) if gaps else 0.0
    times, drawn = list(moments[:1]), list(values[:1])
    for gap, moment, value in zip(gaps, moments[1:], values[1:], strict=True):
        if gap > longest > 0:
            times.append(moment)
            drawn.append(math.nan)
        times.append(moment)
        drawn.append(value)
    return times, drawn


def _number(message: Any, field: str, topic: str) -> float:
    try:
        value = functools.reduce(_field, field.split("."), message)
    except (AttributeError, IndexError):
        fields = ", ".join(type(message).get_fields_and_field_types())
        raise ValueError(f"the messages on {topic} have no field {field}; they have {fields}") from None
    if not isinstance(value, numbers.Real):
        raise ValueError(f"{field} on {topic} is not a number, but {type(value).__name__}")
    return float(value)


def _field(value: Any, name: str) -> Any:
    """A field of a message, or an item of a list in it."""
    return value[int(name)] if name.isdecimal() and hasattr(value, "__len__") else getattr(value, name)


def _end(recording: Recording) -> float:
    return recording.ended.stamp or recording.seconds or 1.0
