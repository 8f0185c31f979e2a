"""The summary of a class for a terminal, and as CSV."""
import csv
import io
import math
import textwrap
from collections import Counter
from collections.abc import Iterator, Mapping

from grader.marking.command.summary import Summary, cells, missed_checks
from grader.marking.gradebook.student_standings import Cell, Standing
from grader.marking.progress_line import printable
from grader.marking.result import Result
from grader.marking.spreadsheet import inert

WIDTH = 100
MISTAKES = 8
MANY = 100  # students: above that, what would be a line for each is in a file
CONCERNS = 40  # that are shown then
NAME = 40  # characters of a name in the table
ABOUT = "student assignment verdict notebook cell exercise points max missed needs_look"
BY_HAND = ["by_hand", "comment", "days_late", "penalty"]
FIELDS = [*ABOUT.split(), "flags", "repairs", "reason", "seconds", *BY_HAND]


def as_text(summary: Summary, mistakes: int = MISTAKES) -> str:
    """The summary in lines. `mistakes` of the common ones are shown."""
    return "\n".join(printable(line) for line in _lines(summary, mistakes))


def _lines(summary: Summary, mistakes: int) -> Iterator[str]:
    many = len(summary.rows) > MANY
    yield from _spread(summary) if many else _table(summary)
    if summary.version:
        yield f"Version of the course: {summary.version}"
    if summary.unstarted:
        counts = ", ".join(f"{exercise} {count}" for exercise, count in summary.unstarted.items())
        text = f"Students, of {len(summary.rows)}, who have not started: {counts}"
        yield from ("", *textwrap.wrap(text, WIDTH))
    if summary.mistakes:
        yield from ("", "Common mistakes")
    for mistake in summary.mistakes[:mistakes]:
        yield f"  {mistake.students} of {len(summary.rows)}  {mistake.exercise}: {mistake.sentence}"
        for label, words in (("Saw", mistake.saw), ("Hint", mistake.hint)):
            lines = textwrap.TextWrapper(WIDTH, initial_indent=" " * 10, subsequent_indent=" " * 12)
            yield from lines.wrap(f"{label}: {words}") if words else ()
    if summary.concerns:
        yield from ("", "Needs your attention")
    shown = summary.concerns[: CONCERNS if many else None]
    for concern in shown:
        yield from textwrap.wrap(f"  {concern.whose}: {concern.what}", WIDTH, subsequent_indent="      ")
    if len(shown) < len(summary.concerns):
        yield f"  {len(summary.concerns) - len(shown)} more, which are in the file, too"
    if summary.times:
        times = summary.times
        yield ""
        yield f"A submission took {times.median:.1f} s (median), {times.longest:.1f} s at most."
        slowest = ", ".join(f"{name} {seconds:.2g} s" for name, seconds in times.cells)
        yield from textwrap.wrap(f"Slowest cells: {slowest}", WIDTH) if slowest else ()


def _spread(summary: Summary) -> Iterator[str]:
    """How many students have how many points, in place of a line for each."""
    most = sum(summary.worth.values())
    yield f"{len(summary.rows)} students, of {most:g} points:"
    tenths = Counter(min(int(10 * row.total / most), 9) if most else 0 for row in summary.rows)
    edges = [f"{most * edge / 10:g}" for edge in range(11)]
    width = max(map(len, edges))
    for tenth in sorted(tenths, reverse=True):
        bar = "#" * math.ceil(40 * tenths[tenth] / len(summary.rows))
        yield f"  {edges[tenth]:>{width}} to {edges[tenth + 1]:>{width}}  {tenths[tenth]:5}  {bar}"


def _table(summary: Summary) -> Iterator[str]:
    late = ["late"] if summary.any_late else []
    head = ["student", *summary.names.values(), "total", *late, "verdict", "flags"]
    whole = sum(summary.worth.values())
    most = (f"{points:g}" for points in (*summary.worth.values(), whole))
    rows = [head, ["of", *most, *([""] * len(late)), "", ""]]
    for row in summary.rows:
        points = [f"{row.points[key]:g}" if key in row.points else "-" for key in summary.worth]
        late = [row.late] if summary.any_late else []
        name = row.student if len(row.student) <= NAME else f"{row.student[: NAME - 1]}…"
        rows.append([name, *points, f"{row.total:g}", *late, row.verdict, str(row.flags or "")])
    widths = [max(len(row[column]) for row in rows) for column in range(len(head))]
    for first, *rest in rows:
        cells = (word.rjust(width) for word, width in zip(rest, widths[1:], strict=True))
        yield "  ".join([first.ljust(widths[0]), *cells]).rstrip()


def as_csv(
    assignment: str, results: Mapping[str, Result], standings: Mapping[str, Standing] | None = None
) -> str:
    """One row for each student and graded cell; one with empty cells for a student without any."""
    file = io.StringIO()
    table = csv.DictWriter(file, FIELDS, restval="", lineterminator="\n")
    table.writeheader()
    for student in sorted(results):
        for row in _csv_rows(assignment, results[student], (standings or {}).get(student, Standing({}))):
            table.writerow({key: inert(value) for key, value in row.items()})
    return file.getvalue()


def _csv_rows(assignment: str, result: Result, standing: Standing) -> Iterator[dict[str, object]]:
    about: dict[str, object] = {
        "student": result.student,
        "assignment": assignment,
        "verdict": result.verdict,
        "flags": "; ".join(result.flags),
        "repairs": "; ".join(result.repairs),
        "reason": result.reason,
        "days_late": round(standing.days_late, 2) or "",
        "penalty": standing.penalty or "",
    }
    marked, comments = list(cells(result)), dict(standing.comments)
    for (notebook, name), cell in marked:
        yield about | {
            **_by_hand((notebook, name), standing, comments),
            "exercise": cell.exercise,
            "points": standing.points.get((notebook, name), cell.points),
            "max": cell.max,
            "missed": "; ".join(verdict["sentence"] for verdict in missed_checks(cell)),
            "needs_look": "yes" if cell.needs_look else "",
            "seconds": result.timings.get(f"{notebook}/{name}", ""),
        }
    rest = sorted({*standing.by_hand, *comments} - {key for key, _ in marked})
    for key in rest:
        yield about | _by_hand(key, standing, comments) | {"points": standing.points.get(key, "")}
    if not marked and not rest:
        yield about


def _by_hand(key: Cell, standing: Standing, comments: Mapping[Cell, str]) -> dict[str, object]:
    by_hand = "yes" if key in standing.by_hand else ""
    return {"notebook": key[0], "cell": key[1], "by_hand": by_hand, "comment": comments.get(key, "")}
