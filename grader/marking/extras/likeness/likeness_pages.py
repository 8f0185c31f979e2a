"""The pages of a comparison, and the ZIP for other programs that compare."""

from __future__ import annotations

import difflib
import zipfile
from collections.abc import Sequence
from io import BytesIO
from pathlib import Path

from grader.marking.atomic_file import write_atomically
from grader.marking.extras.likeness.equal_runs import RARE, EqualRuns
from grader.marking.extras.likeness.pairs import ClassLikeness, LikePair
from grader.marking.extras.likeness.student_texts import StudentText, release_source
from grader.marking.page_templates import template_environment
from grader.marking.submission.assignment_release import Release

ZIP_EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest time that a ZIP can hold
Rows = list[tuple[str, str, bool]]  # lines side by side, and whether they are equal


def write_pages(
    found: ClassLikeness, runs: Sequence[EqualRuns], assignment: str, folder: Path
) -> Path:
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
    """Write a ZIP with a `.py` for each student, as JPlag and Dolos take it. Raises OSError.

    The folder `release` in it is what JPlag calls base code.
    """
    buffer = BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for text in texts:
            name = text.student.replace("/", "_")
            archive.writestr(zipfile.ZipInfo(f"{name}/{name}.py", ZIP_EPOCH), text.source)
        archive.writestr(zipfile.ZipInfo("release/release.py", ZIP_EPOCH), release_source(release))
    write_atomically(path, buffer.getvalue(), 0o600)


_pages = template_environment(Path(__file__).parent)
_pages.filters["percent"] = "{:.0%}".format
