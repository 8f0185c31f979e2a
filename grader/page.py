"""Renders a score as HTML and as text.

The HTML is one table with inline styles: no scripts, no classes, no URLs except of embedded pictures. Text
has the page's color, and each status its own background, so all is legible in light and dark themes. Equal
scores give equal bytes. A moment of a run that has a replay is a link, which moves the replay there; see
sim/view/web/cursor.js.
"""

from __future__ import annotations

import html as escaping
import re
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType

from grader.checks.verdicts import Verdict

# Per status: symbol, word, and the colors of text and background: legible in light and dark themes, with a
# contrast of 7 or more; on a white page also where a sanitizer removes the background.
STATUS_STYLES = {
    "passed": ("✔", "passed", "#0b5a26", "#e3f4e8"),
    "partly": ("◐", "partly", "#6b4700", "#fff1d0"),
    "failed": ("✘", "missed", "#8c1d18", "#fdecea"),
    "skipped": ("○", "skipped", "#4a4a4a", "#eeeeee"),
    "broken": ("!", "our mistake", "#4b2a8f", "#eee7fb"),
}
_, _, _GREEN, _LIGHT_GREEN = STATUS_STYLES["passed"]
FULL = f' <b style="color: {_GREEN}; background-color: {_LIGHT_GREEN}; padding: 0 4px">✔ Full points</b>'
NO_REPLAYS: Mapping[int, str] = MappingProxyType({})
WIDTH = 88  # characters per line in a terminal
MOMENT = re.compile(r"\b(?:at|from|until) (\d{1,6}(?:\.\d{1,6})?) s\b")


def html(
    title: str,
    points: float,
    most: float,
    verdicts: Sequence[Verdict],
    runs: Sequence[str] = (),
    note: str = "",
    below: tuple[int, str] = (0, ""),
    replays: Mapping[int, str] = NO_REPLAYS,
) -> str:
    """The table for Jupyter.

    runs: the label of each run, if there are several. note: a sentence on the total points.
    below: the index of a verdict, and HTML to insert below its text. replays: the keys of runs that have a
    replay, by index.
    """
    more = {below[0]: below[1]}
    rows = "".join(
        _row(verdict, runs, more.get(index, ""), replays.get(verdict.run, ""))
        for index, verdict in enumerate(verdicts)
    )
    return (
        '<table style="border-collapse: collapse; text-align: left; width: 100%">'
        '<caption style="text-align: left; color: inherit">'
        f"<b>{_escape(title)}: {format_points(points)} of {format_points(most)} points</b>"
        f"{FULL if points >= most > 0 else ''}"
        f'{note and f"<br>{_escape(note)}"}</caption>'
        f"<thead><tr>{_heading('', '6.5em')}{_heading('What is checked')}{_heading('Points', '5em')}</tr>"
        "</thead>"
        f"<tbody>{rows}</tbody></table>"
    )


def text(
    title: str,
    points: float,
    most: float,
    verdicts: Sequence[Verdict],
    runs: Sequence[str] = (),
    note: str = "",
) -> str:
    """The table for a terminal."""
    lines = [f"{title}: {format_points(points)} of {format_points(most)} points", *textwrap.wrap(note, WIDTH)]
    for verdict in verdicts:
        symbol, word, *_ = STATUS_STYLES[status_key(verdict)]
        lines.append(f"  {symbol} {word:<11} {_points(verdict):>9}  {verdict.sentence}")
        for label, content in details(verdict, runs):
            lines += textwrap.wrap(
                f"{label}: {content}", WIDTH, initial_indent=" " * 8, subsequent_indent=" " * 10
            )
    return "\n".join(lines)


def status_key(verdict: Verdict) -> str:
    """The key in STATUS_STYLES: the status, or "partly" for a missed or skipped check with partial credit."""
    return "partly" if verdict.status in ("failed", "skipped") and verdict.credit > 0 else verdict.status


def details(verdict: Verdict, runs: Sequence[str] = ()) -> Iterator[tuple[str, str]]:
    """The details of a verdict besides its sentence, as label and content."""
    run = runs[verdict.run] if runs and verdict.status == "failed" else ""
    content = {"Run": run, "Expected": verdict.expected, "Saw": verdict.saw}
    yield from ((label, words) for label, words in content.items() if words)
    if verdict.hint:
        yield ("Note" if verdict.status in ("skipped", "broken") else "Hint"), verdict.hint
    if verdict.alarm:
        yield "For the instructor", verdict.alarm.strip().splitlines()[-1]


def format_points(points: float) -> str:
    """Points without trailing zeros."""
    return f"{points:.2f}".rstrip("0").rstrip(".")


def _points(verdict: Verdict) -> str:
    return f"{format_points(verdict.earned)} / {format_points(verdict.points)}" if verdict.points else ""


def named_moments(verdict: Verdict) -> list[float]:
    """The moments (s) that the text of a check names: what was seen, or else what was expected."""
    found = MOMENT.findall(verdict.saw) or MOMENT.findall(verdict.expected)
    return [float(seconds) for seconds in found]


def _row(verdict: Verdict, runs: Sequence[str], below: str, replay: str) -> str:
    symbol, word, color, background = STATUS_STYLES[status_key(verdict)]
    more = "".join(
        f"<div><b>{label}:</b> {_linked(_escape(content), replay)}</div>"
        for label, content in details(verdict, runs)
    )
    more += below
    cell = "text-align: left; vertical-align: top"
    return (
        f'<tr><td style="{cell}; white-space: nowrap">'
        f'<b style="color: {color}; background-color: {background}; padding: 0 4px">{symbol} {word}</b></td>'
        f'<td style="{cell}; white-space: normal"><div><b>{_escape(verdict.sentence)}</b></div>{more}</td>'
        f'<td style="{cell}; white-space: nowrap">{_points(verdict)}</td></tr>'
    )


def _linked(content: str, replay: str) -> str:
    """Escaped text in which each moment is a link to the replay of this key; "" for none."""
    if not replay:
        return content
    return MOMENT.sub(
        lambda found: found[0].replace(
            f"{found[1]} s", f'<a href="#run-{replay}-{found[1]}">{found[1]} s</a>'
        ),
        content,
    )


def _heading(word: str, width: str = "auto") -> str:
    # Jupyter gives all columns of a table the same width unless widths are specified.
    return f'<th scope="col" style="text-align: left; font-weight: bold; width: {width}">{word}</th>'


def _escape(words: str) -> str:
    """Escaped HTML, with text between backticks as code."""
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", escaping.escape(words))
