"""The summary of a class for a terminal, and as CSV."""
import csv
import io
import textwrap
from collections.abc import Iterator, Mapping

from grader.marking.command.summary import Summary, cells, missed_checks
from grader.marking.progress_line import printable
from grader.marking.result import Result

WIDTH = 100
MISTAKES = 8
ABOUT = "student assignment verdict notebook cell exercise points max missed needs_look"
FIELDS = [*ABOUT.split(), "flags", "repairs", "reason", "seconds"]
RUNS = ("=", "+", "-", "@", "\t", "\r")  # a spreadsheet takes text that begins so for a formula


def as_text(summary: Summary, mistakes: int = MISTAKES) -> str:
    """The summary in lines. `mistakes` of the common ones are shown."""
    return "\n".join(printable(line) for line in _lines(summary, mistakes))


def _lines(summary: Summary, mistakes: int) -> Iterator[str]:
    yield from _table(summary)
    if summary.unstarted:
        counts = ", ".join(f"{exercise} {count}" for exercise, count in summary.unstarted.items())
        yield from ("", *textwrap.wrap(f"Not started by so many of {len(summary.rows)}: {counts}", WIDTH))
    if summary.mistakes:
        yield from ("", "Common mistakes")
    for mistake in summary.mistakes[:mistakes]:
        yield f"  {mistake.students} of {len(summary.rows)}  {mistake.exercise}: {mistake.sentence}"
        for label, words in (("Saw", mistake.saw), ("Hint", mistake.hint)):
            indents = {"initial_indent": " " * 10, "subsequent_indent": " " * 12}
            yield from textwrap.wrap(f"{label}: {words}", WIDTH, **indents) if words else ()
    if summary.concerns:
        yield from ("", "For you to look at")
    for concern in summary.concerns:
        yield from textwrap.wrap(f"  {concern.whose}: {concern.what}", WIDTH, subsequent_indent="      ")
    if summary.times:
        times = summary.times
        yield ""
        yield f"A submission took {times.median:.1f} s (median), {times.longest:.1f} s at most."
        slowest = ", ".join(f"{name} {seconds:.2g} s" for name, seconds in times.cells)
        yield from textwrap.wrap(f"Slowest cells: {slowest}", WIDTH) if slowest else ()


def _table(summary: Summary) -> Iterator[str]:
    head = ["student", *summary.names.values(), "total", "verdict", "flags"]
    whole = sum(summary.worth.values())
    rows = [head, ["of", *(f"{points:g}" for points in (*summary.worth.values(), whole)), "", ""]]
    for row in summary.rows:
        points = [f"{row.points[key]:g}" if key in row.points else "-" for key in summary.worth]
        rows.append([row.student, *points, f"{row.total:g}", row.verdict, str(row.flags or "")])
    widths = [max(len(row[column]) for row in rows) for column in range(len(head))]
    for first, *rest in rows:
        cells = (word.rjust(width) for word, width in zip(rest, widths[1:], strict=True))
        yield "  ".join([first.ljust(widths[0]), *cells]).rstrip()


def as_csv(assignment: str, results: Mapping[str, Result]) -> str:
    """One row for each student and test cell; one with empty cells for a student without any."""
    file = io.StringIO()
    table = csv.DictWriter(file, FIELDS, restval="", lineterminator="\n")
    table.writeheader()
    for student in sorted(results):
        for row in _csv_rows(assignment, results[student]):
            table.writerow({key: _inert(value) for key, value in row.items()})
    return file.getvalue()


def _csv_rows(assignment: str, result: Result) -> Iterator[dict[str, object]]:
    about: dict[str, object] = {
        "student": result.student,
        "assignment": assignment,
        "verdict": result.verdict,
        "flags": "; ".join(result.flags),
        "repairs": "; ".join(result.repairs),
        "reason": result.reason,
    }
    marked = list(cells(result))
    for (notebook, name), cell in marked:
        yield about | {
            "notebook": notebook,
            "cell": name,
            "exercise": cell.exercise,
            "points": cell.points,
            "max": cell.max,
            "missed": "; ".join(verdict["sentence"] for verdict in missed_checks(cell)),
            "needs_look": "yes" if cell.needs_look else "",
            "seconds": result.timings.get(f"{notebook}/{name}", ""),
        }
    if not marked:
        yield about


def _inert(value: object) -> object:
    """The value without control characters, and quoted where a spreadsheet would take it for a formula."""
    if not isinstance(value, str):
        return value
    return f"'{printable(value)}" if value.startswith(RUNS) else printable(value)
