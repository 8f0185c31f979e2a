"""`plot_jitter`: the intervals between the messages of a topic."""

from __future__ import annotations

import itertools
import statistics

from sim.evidence import Recording, Seconds, rate, stamps
from sim.view.plot import CAUTION, GRID, MUTED, PATH, WARNING, Plot, legend_beside, note_failure, plot
from sim.view.plot_data import panel, plot_data, series


def plot_jitter(
    recording: Recording, topic: str, *, period: Seconds | None = None, deadline: Seconds | None = None
) -> Plot:
    """Plot the intervals between consecutive messages of a topic, in milliseconds, over simulated time.

    period: the nominal interval, drawn as a line; the mean if omitted. deadline: the greatest allowed
    interval; longer ones are red. The title has the rate, the jitter (standard deviation) and the number of
    missed deadlines. Raises ValueError for fewer than two messages, and for a period or a deadline that isn't
    above 0.
    """
    moments = stamps(recording.messages(topic))
    if len(moments) < 2:
        known = ", ".join(recording.topics) or "no topics"
        raise ValueError(f"jitter needs two messages; {topic} has {len(moments)}, and this run has {known}")
    for name, value in (("period", period), ("deadline", deadline)):
        if value is not None and not value > 0:
            raise ValueError(f"the {name} is {value!r}; give seconds above 0, or leave it out")
    gaps = [(after, 1000 * (after - before)) for before, after in itertools.pairwise(moments)]
    limit = float("inf") if deadline is None else 1000 * deadline + 1e-6
    late = [row for row in gaps if row[1] > limit]
    nominal = 1000 * (
        statistics.fmean(b - a for a, b in itertools.pairwise(moments)) if period is None else period
    )
    figure, axes = plot(7.2, 3.2)
    axes.axhline(nominal, color=MUTED, linewidth=1.0, label="mean" if period is None else "period")
    axes.plot(*zip(*gaps, strict=True), ".", color=PATH, markersize=4, label="time since the last")
    if deadline is not None:
        axes.axhline(1000 * deadline, color=CAUTION, linestyle="--", linewidth=1.0, label="deadline")
    if late:
        axes.plot(*zip(*late, strict=True), "x", color=WARNING, markersize=7, label="missed")
    end = recording.ended.stamp or recording.seconds or moments[-1]
    axes.set(
        xlabel="time (s)", ylabel="ms", xlim=(0.0, end), title=_title(topic, moments, gaps, deadline, late)
    )
    axes.set_ylim(bottom=0.0)
    axes.grid(color=GRID)
    legend_beside(axes)
    curves = [series("time since the last", *zip(*gaps, strict=True), style="points")]
    curves += [series("missed", *zip(*late, strict=True), style="points", color="warning")] if late else []
    levels = [(nominal, "mean" if period is None else "period", "muted")]
    levels += [] if deadline is None else [(1000 * deadline, "deadline", "caution")]
    title = _title(topic, moments, gaps, deadline, late)
    figure.offer(plot=plot_data(recording, title, panels=[panel("ms", curves, levels)]))
    return note_failure(figure, recording)


def _title(
    topic: str,
    moments: list[Seconds],
    gaps: list[tuple[Seconds, float]],
    deadline: Seconds | None,
    late: list[tuple[Seconds, float]],
) -> str:
    spread = round(statistics.pstdev(gap for _, gap in gaps), 6)  # without rounding noise
    parts = [f"{topic}: {rate(moments):.3g} Hz", f"jitter {spread:.2g} ms"]
    if deadline is not None:
        parts.append(f"{len(late)} {'deadline' if len(late) == 1 else 'deadlines'} missed")
    return ", ".join(parts)
