"""The pages of a comparison, and the ZIP for other programs that compare."""

from __future__ import annotations

import csv
import difflib
import zipfile
from collections.abc import Sequence
from io import BytesIO, StringIO
from pathlib import Path

from grader.marking.atomic_file import write_atomically
from grader.marking.extras.likeness.equal_runs import RARE, EqualRuns
from grader.marking.extras.likeness.pairs import ClassLikeness, LikePair
from grader.marking.extras.likeness.student_texts import StudentText, release_source
from grader.marking.page_templates import template_environment
from grader.marking.submission.assignment_release import Release

ZIP_EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest time that a ZIP can hold
RELEASE = "release/release.py"
Rows = list[tuple[str, str, bool]]  # lines side by side, and whether they are equal


def write_pages(found: ClassLikeness, runs: Sequence[EqualRuns], assignment: str, folder: Path) -> Path:
    """Write an overview and a page for each pair; returns the overview. Raises OSError."""
    links = {f"pair-{number:02}.html": pair for number, pair in enumerate(found.pairs, 1)}
    for old in folder.glob("pair-*.html"):
        old.unlink()
    common = {"found": found, "runs": runs, "assignment": assignment}
    for name, pair in links.items():
        about = common | {"pair": pair, "rows": side_by_side(pair)}
        write_atomically(folder / name, _pages.get_template("pair.html").render(about), 0o600)
    overview = folder / "index.html"
    about = common | {"links": links, "rare": RARE}
    write_atomically(overview, _pages.get_template("overview.html").render(about), 0o600)
    return overview


def side_by_side(pair: LikePair) -> Rows:
    """The texts of both, line by line; equal lines beside each other."""
    first, second = pair.first.source.splitlines(), pair.second.source.splitlines()
    rows: Rows = []
    for kind, i, j, k, m in difflib.SequenceMatcher(None, _plain(first), _plain(second), False).get_opcodes():
        height = max(j - i, m - k)
        left = first[i:j] + [""] * (height - (j - i))
        right = second[k:m] + [""] * (height - (m - k))
        rows += [(a, b, kind == "equal") for a, b in zip(left, right, strict=True)]
    return rows


def _plain(lines: Sequence[str]) -> list[str]:
    return [" ".join(line.split()) for line in lines]


def write_texts(texts: Sequence[StudentText], release: Release, path: Path) -> None:
    """Write a ZIP with a `.py` for each student, for JPlag and Dolos. Raises OSError.

    The folder `release` in it is what JPlag calls base code. Dolos reads info.csv: the names of students, and
    that the release is a template.
    """
    names = [(text, text.student.replace("/", "_")) for text in texts]
    files = {f"{name}/{name}.py": text.source for text, name in names}
    rows = [(f"{name}/{name}.py", text.student, "false") for text, name in names]
    files |= {RELEASE: release_source(release), "info.csv": _csv([*rows, (RELEASE, "the release", "true")])}
    buffer = BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(zipfile.ZipInfo(name, ZIP_EPOCH), content, zipfile.ZIP_DEFLATED)
    write_atomically(path, buffer.getvalue(), 0o600)


def _csv(rows: Sequence[tuple[str, str, str]]) -> str:
    """The rows under the headings that Dolos knows."""
    table = StringIO(newline="")
    csv.writer(table, lineterminator="\n").writerows([("filename", "full_name", "ignored"), *rows])
    return table.getvalue()


_pages = template_environment(Path(__file__).parent)
_pages.filters["percent"] = "{:.0%}".format
