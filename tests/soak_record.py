"""The day on which each file's soak tests passed last: `.ci/run all` writes it to tests/soak.txt, to commit.

python -m tests.soak_record    names the files whose soak tests have not passed in a fortnight

As a plugin of pytest (`-p tests.soak_record`) it adds the files of which every soak test that ran passed.
"""
import datetime
import subprocess
from collections import defaultdict
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
RECORD = "tests/soak.txt"
FORTNIGHT = datetime.timedelta(days=14)
# What a file of soak tests contains: the mark, or the class of an assignment, whose tests have it.
SIGNS = "pytest.mark." + "soak", "(Assignment" + ")"

Entry = tuple[datetime.date, float]  # the day, and the minutes that the tests took together

_seconds: defaultdict[str, float] = defaultdict(float)
_not_passed: set[str] = set()


def read_record(root: Path) -> dict[str, Entry]:
    """Return the day and the minutes of each file in the record."""
    file = root / RECORD
    rows = [line.split() for line in file.read_text().splitlines()] if file.exists() else []
    return {path: (datetime.date.fromisoformat(day), float(minutes)) for day, minutes, path in rows}


def add_to_record(root: Path, entries: dict[str, Entry]) -> None:
    """Write these files' entries into the record; the others stay, unless their file is gone."""
    every = {path: entry for path, entry in (read_record(root) | entries).items() if (root / path).exists()}
    lines = [f"{day} {minutes:6.1f} {path}\n" for path, (day, minutes) in sorted(every.items())]
    (root / RECORD).write_text("".join(lines))


def overdue(root: Path, today: datetime.date) -> list[str]:
    """Return a sentence for each file with soak tests that have not passed in a fortnight."""
    signs = [word for sign in SIGNS for word in ("-e", sign)]
    command = ["git", "grep", "--untracked", "-lF", *signs, "--", "tests/test_*.py", "tests/*/test_*.py"]
    found = subprocess.run(command, cwd=root, capture_output=True, text=True).stdout.split()
    record = read_record(root)
    return [
        f"{path}: its soak tests passed last on {record[path][0]}" if path in record
        else f"{path}: {RECORD} has no run of its soak tests"
        for path in found
        if path not in record or today - record[path][0] > FORTNIGHT
    ]


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    """Sum up the time of each file."""
    if "soak" in report.keywords:
        file = report.nodeid.partition("::")[0]
        _seconds[file] += report.duration
        if not report.passed:
            _not_passed.add(file)


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Add the files that passed; only the process that collects all results does that."""
    if not hasattr(session.config, "workerinput"):
        today = datetime.date.today()
        if passed := _seconds.keys() - _not_passed:
            add_to_record(session.config.rootpath, {file: (today, _seconds[file] / 60) for file in passed})


if __name__ == "__main__":
    sentences = overdue(ROOT, datetime.date.today())
    for sentence in sentences:
        print(sentence)
    if sentences:
        print(f"`.ci/run all` runs these {len(sentences)} files; it takes hours.")
