"""rclpy's own tests, plainly and each as a program of a run: which pass, are refused, or differ.

python -m tests.fidelity CHECKOUT [NAME ...]    a checkout of ros2/rclpy, branch jazzy; some of its test files

Nothing is fetched. What the tests import and no wheel has, test_msgs, must be on PYTHONPATH.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path
from typing import Any

import pytest
from _pytest.runner import runtestprotocol

from tests.bench.report import table

SECONDS = 600  # simulated ones that a test may take
PATIENCE = 120  # wall seconds that a file may take
OPTIONS = ["-s", "-p", "no:terminal", "-p", "no:cacheprovider", "-p", "no:threadexception", "-W", "ignore"]
OURS = f"{Path(__file__).parents[1] / 'sim'}{os.sep}"
OUTCOMES = "passed", "skipped", "refused", "differs"

Found = dict[str, tuple[str, str]]  # outcome and words of each test


class Program:
    """A test as `sim.run` takes it; names that its module has bound early count as those of a student's."""

    def __init__(self, item: pytest.Item) -> None:
        self.item, self.reports = item, []
        self.__name__, self.__globals__ = item.name, vars(item.module)

    def __call__(self) -> None:
        """Set up, test, tear down."""
        self.reports = runtestprotocol(self.item, nextitem=None, log=False)


class Watching:
    """Runs the tests of one file and writes a line of JSON for each. here: in a run."""

    def __init__(self, lines: Path, here: bool) -> None:
        self._lines, self._here = lines, here

    def pytest_runtest_protocol(self, item: pytest.Item, nextitem: pytest.Item | None) -> bool:
        """Instead of pytest's own."""
        program, ended = Program(item), "nothing"
        if self._here:
            from sim import run  # only here: the hooks come with it

            ended = run(program, seconds=SECONDS, quiet=True).ended.detail
        else:
            program()
        with self._lines.open("a") as file:
            file.write(json.dumps([item.nodeid, *_outcome(program.reports, ended)]) + "\n")
        return True


def _outcome(reports: list[Any], ended: str) -> tuple[str, str]:
    """Of one test. ended: why the run did, for one that came to no end."""
    if not any(report.when == "teardown" for report in reports):
        return "differs", ended
    bad = next((report for report in reports if report.failed), None)
    if bad is None:
        return ("skipped" if any(report.skipped for report in reports) else "passed"), ""
    crash = getattr(bad.longrepr, "reprcrash", None)
    refused = crash is not None and crash.path.startswith(OURS)
    words = crash.message if crash is not None else str(bad.longrepr)
    return ("refused" if refused else "differs"), words.strip().split("\n")[0]


def results(folder: Path, file: str, how: str) -> Found:
    """Of the tests of a file, in a process of its own. how: "plainly" or "here"."""
    with tempfile.NamedTemporaryFile(suffix=".jsonl") as lines:
        command = [sys.executable, "-m", "tests.fidelity", how, file, lines.name]
        environment = os.environ | {
            "PYTHONPATH": os.pathsep.join([str(Path.cwd()), os.environ.get("PYTHONPATH", "")]),
            "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF",
            "ROS_PYTHON_CHECK_FIELDS": "1",  # as sim has it
        }
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "timeout": PATIENCE}
        with contextlib.suppress(subprocess.TimeoutExpired):
            subprocess.run(command, cwd=folder, env=environment, check=False, **quiet)
        return {name: (outcome, words) for name, outcome, words in map(json.loads, Path(lines.name).open())}


def compare(folder: Path, file: str) -> tuple[list[Any], Found]:
    """A row of the table for a file, and what does not pass in a run although it passes plainly."""
    plainly, here = results(folder, file, "plainly"), results(folder, file, "here")
    good = [name for name, (outcome, _) in plainly.items() if outcome == "passed"]
    gone = "differs", "the process ended in it or before it, or took too long"
    found = {name: here.get(name, gone) for name in good}
    counted = Counter(outcome for outcome, _ in found.values())
    row = [Path(file).name, len(plainly), len(good), *(counted[outcome] for outcome in OUTCOMES)]
    return row, {name: what for name, what in found.items() if what[0] != "passed"}


def main() -> None:
    """Compare, and print the table and the words."""
    parser = argparse.ArgumentParser("python -m tests.fidelity", description=__doc__.splitlines()[0])
    parser.add_argument("checkout", type=Path, help="of ros2/rclpy, branch jazzy")
    parser.add_argument("names", nargs="*", help="some of its test files, such as test_timer.py")
    options = parser.parse_args()
    tests = options.checkout / "rclpy" / "test"
    if not tests.is_dir():
        parser.error(f"{options.checkout} is no checkout of ros2/rclpy: it has no rclpy/test")
    rows, others = [], {}
    with tempfile.TemporaryDirectory() as folder:  # beside the sources of rclpy, those would be imported
        shutil.copytree(tests, Path(folder, "test"))
        Path(folder, "test", "__init__.py").write_text("")  # upstream's wants rclpy not to be imported yet
        for file in sorted(Path(folder, "test").glob("test_*.py")):
            if file.name in options.names or not options.names:
                row, found = compare(Path(folder), f"test/{file.name}")
                print(*row, file=sys.stderr, flush=True)
                rows.append(row)
                others |= found
    total = ["all", *(sum(column) for column in zip(*(row[1:] for row in rows), strict=True))]
    table(["file", "tests", "pass plainly", "pass in a run", "skipped", "refused", "differ"], [*rows, total])
    for name, (outcome, words) in sorted(others.items(), key=lambda item: (item[1], item[0])):
        print(f"{outcome}: {name}\n    {words}")


if __name__ == "__main__":
    if sys.argv[1:2] in (["plainly"], ["here"]):
        how, file, lines = sys.argv[1:]
        sys.exit(pytest.main([*OPTIONS, file], plugins=[Watching(Path(lines), how == "here")]))
    main()
