"""The summary of a class as one HTML page: no scripts, nothing from elsewhere, everything escaped."""
from collections.abc import Iterable
from html import escape

from grader.marking.office.summary import Summary

STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; max-width: 75em; margin: 2em auto; padding: 0 1em }
table { border-collapse: collapse; margin: 1em 0 }
th, td { padding: .2em .8em; border-bottom: 1px solid #ccc; text-align: right; vertical-align: top }
th:first-child, td:first-child, td.words { text-align: left }
td.low { background: #d6454122 } td.high { background: #16883c22 }
"""


def as_page(summary: Summary) -> str:
    """The whole page."""
    name = escape(summary.assignment)
    about = (_points, _unstarted, _mistakes, _looks, _times)
    parts = [f"<h1>{name}</h1>", *(part(summary) for part in about)]
    head = f'<meta charset="utf-8"><title>{name}</title><style>{STYLE}</style>'
    body = "\n".join(filter(None, parts))
    return f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head>\n<body>\n{body}\n</body></html>\n'


def _points(summary: Summary) -> str:
    head = ["student", *summary.names.values(), "total", "verdict", "flags"]
    whole = sum(summary.worth.values())
    rows = [_row([_cell(word) for word in ["of", *summary.worth.values(), whole, "", ""]])]
    for row in summary.rows:
        points = [_points_cell(row.points.get(key), worth) for key, worth in summary.worth.items()]
        total = _points_cell(row.total, whole)
        rows.append(_row([_cell(row.student), *points, total, _cell(row.verdict), _cell(row.flags or "")]))
    return _table(head, rows)


def _unstarted(summary: Summary) -> str:
    rows = [_row([_cell(exercise), _cell(count)]) for exercise, count in summary.unstarted.items()]
    return "<h2>Not started</h2>" + _table(["exercise", "students"], rows) if rows else ""


def _mistakes(summary: Summary) -> str:
    rows = []
    for one in summary.mistakes:
        words = map(_words, (one.exercise, one.sentence, one.saw, one.hint))
        rows.append(_row([_cell(f"{one.students} of {len(summary.rows)}"), *words]))
    head = ["students", "exercise", "check", "saw", "hint"]
    return "<h2>Common mistakes</h2>" + _table(head, rows) if rows else ""


def _looks(summary: Summary) -> str:
    rows = [_row([_cell(look.whose), _words(look.what)]) for look in summary.looks]
    return "<h2>For you to look at</h2>" + _table(["student", "what"], rows) if rows else ""


def _times(summary: Summary) -> str:
    if not summary.times:
        return ""
    times = summary.times
    said = f"A submission took {times.median:.1f} s (median), {times.longest:.1f} s at most."
    rows = [_row([_cell(name), _cell(f"{seconds:.2g}")]) for name, seconds in times.cells]
    return f"<h2>Times</h2><p>{said}</p>" + (_table(["slowest cells", "seconds"], rows) if rows else "")


def _table(head: Iterable[str], rows: Iterable[str]) -> str:
    titles = "".join(f"<th>{escape(word)}</th>" for word in head)
    return f"<table><thead><tr>{titles}</tr></thead><tbody>{''.join(rows)}</tbody></table>"


def _row(cells: Iterable[str]) -> str:
    return f"<tr>{''.join(cells)}</tr>"


def _cell(value: object, kind: str = "") -> str:
    word = f"{value:g}" if isinstance(value, float) else str(value)
    return f'<td class="{kind}">{escape(word)}</td>' if kind else f"<td>{escape(word)}</td>"


def _words(value: str) -> str:
    return _cell(value, "words")


def _points_cell(points: float | None, worth: float) -> str:
    if points is None:
        return _cell("-", "low")
    return _cell(points, "high" if points >= worth else "low" if points < worth / 2 else "")
