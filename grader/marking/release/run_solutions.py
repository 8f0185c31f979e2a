"""Runs every lesson and solution: all must run without errors and have all points.

    python -m grader.marking.release.run_solutions [--junit FILE] [notebook or folder ...]
"""
import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from xml.etree import ElementTree

from grader.course_files.notebook_format import FOLDERS, InvalidNotebook, find_notebooks
from grader.marking.release.run_notebooks import ExecutedNotebook, TestCellMark, run_notebooks

RUNS_TO_END = "runs to its end"  # the one test of a notebook without points


def row(name: str, points: str, seconds: str, width: int) -> str:
    """A line of the table."""
    return f"{name:{width}}{points:>14}{seconds:>8}"


def points_of(run: ExecutedNotebook) -> str:
    """Points as "85 of 85"; "-" for a notebook that gives none."""
    return f"{run.points:g} of {run.most:g}" if run.marks else "-"


def misses(run: ExecutedNotebook) -> list[str]:
    """The errors and missed points of a notebook, as lines."""
    lines = [f"{run.path}: {problem}" for problem in run.problems]
    for marks in run.marks:
        if marks.points < marks.most:
            lines.append(f"{run.path}, {marks.cell}: {marks.points:g} of {marks.most:g} points")
            lines += [f"    {line}" for line in marks.missed]
    return lines


def junit(runs: Sequence[ExecutedNotebook]) -> str:
    """The runs in JUnit's XML: a suite for each notebook, with a test for each exercise and for itself."""
    root = ElementTree.Element("testsuites")
    for run in runs:
        failed = sum(marks.points < marks.most for marks in run.marks) + bool(run.problems)
        suite = ElementTree.SubElement(
            root,
            "testsuite",
            name=str(run.path),
            tests=str(len(run.marks) + 1),
            failures=str(failed),
            time=f"{run.seconds:.1f}",
        )
        whole = _case(suite, run, RUNS_TO_END, run.problems, "errors")
        whole.set("time", f"{run.seconds:.1f}")
        for marks in run.marks:
            _case(suite, run, marks.cell, *_failure(marks))
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode", xml_declaration=True) + "\n"


def _case(
    suite: ElementTree.Element, run: ExecutedNotebook, name: str, lines: Sequence[str], message: str
) -> ElementTree.Element:
    case = ElementTree.SubElement(suite, "testcase", classname=str(run.path), name=name)
    if lines:
        ElementTree.SubElement(case, "failure", message=message).text = "\n".join(lines)
    return case


def _failure(marks: TestCellMark) -> tuple[Sequence[str], str]:
    if marks.points >= marks.most:
        return (), ""
    message = f"{marks.points:g} of {marks.most:g} points"
    return marks.missed or (message,), message


def report(paths: Sequence[Path]) -> list[ExecutedNotebook]:
    """Run the notebooks; print a line for each, then the sum and what was missed."""
    print(f"Running {len(paths)} notebooks ...")
    width = max(len(str(path)) for path in paths)
    print(row("", "points", "s", width), flush=True)
    runs = []
    for run in run_notebooks(paths):
        runs.append(run)
        print(row(str(run.path), points_of(run), f"{run.seconds:.0f}", width), flush=True)
    points, most = sum(run.points for run in runs), sum(run.most for run in runs)
    print(row("all", f"{points:g} of {most:g}", f"{sum(run.seconds for run in runs):.0f}", width))
    lines = [line for run in runs for line in misses(run)]
    if lines:
        print("\n".join(["", "Missed:", *lines]))
    return runs


def main(arguments: list[str] | None = None) -> int:
    """Run the command line in the course's folder; returns the exit status: 1 for less than all points."""
    parser = argparse.ArgumentParser(
        "python -m grader.marking.release.run_solutions", description="Run every lesson and every solution."
    )
    parser.add_argument("paths", nargs="*", type=Path, help="notebooks or folders; default: all")
    parser.add_argument("--junit", type=Path, metavar="FILE", help="also write the result as JUnit's XML")
    chosen = parser.parse_args(arguments)
    try:
        paths = find_notebooks(chosen.paths or FOLDERS)
    except InvalidNotebook as error:
        print(error, file=sys.stderr)
        return 2
    runs = report(paths)
    if chosen.junit:
        chosen.junit.write_text(junit(runs), encoding="utf-8")
    return 0 if all(run.is_right for run in runs) else 1


if __name__ == "__main__":
    sys.exit(main())
