"""rclpy's own tests, plainly and each as a program of a run: which pass, are refused, or differ.

python -m tests.fidelity CHECKOUT [NAME ...]    a checkout of ros2/rclpy, as installed; some of its test files

It ends with 1 when a test differs and KNOWN has no reason for it. Nothing is fetched. The tests need the
wheel ros-test-msgs. fidelity.txt has what was found with Jazzy and with Kilted.
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
from tests.patience import PATIENCE

SECONDS = 600  # simulated ones that a test may take
OPTIONS = ["-s", "-p", "no:terminal", "-p", "no:cacheprovider", "-p", "no:threadexception", "-W", "ignore"]
# Plainly, an EventsExecutor waits forever in these; a run refuses it.
STUCK = "create_task_during_spin", "executor_add_node_wakes_executor"
LEFT_OUT = [f"--deselect=test/test_executor.py::TestExecutor::test_{name}" for name in STUCK]
OWN = f"{Path(__file__).parents[1] / 'sim'}{os.sep}"
OUTCOMES = "passed", "skipped", "refused", "differs"
ANSWER_FIRST = (
    "A run asks one entity after the other, so that a client takes the answer of that very moment; rclpy"
    " looks at all at once, and the feedback comes before it. Nothing promises an order between the two."
)
ONE_TIME = "All clocks show the time of the run, whatever use_sim_time says."
TESTS_BEFORE = "It relies on the rclpy.init() of the test before it; in a run each is a program of its own."
NO_COMPUTING = "Between two looks at a clock no time passes: computing takes none."
FOUR_THREADS = (
    "A MultiThreadedExecutor() has four threads, not the machine's number of cores: equal runs are equal."
)
NO_THREADS = "A MultiThreadedExecutor has no threads of Python's: threading.enumerate() lists none."
NO_FILTERS = "A run delivers all messages: it ignores content filters, which Jazzy's wheel does not have."
NO_SIGNALS = "init() leaves the signals alone: Ctrl-C belongs to the notebook or another program."
KNOWN = {
    "test_action_server.py::TestActionServer::test_different_feedback_type_raises": ANSWER_FIRST,
    "test_action_server.py::TestActionServer::test_feedback": ANSWER_FIRST,
    "test_clock.py::TestClock::test_clock_now": NO_COMPUTING,
    "test_executor.py::TestExecutor::test_multi_threaded_executor_num_threads": FOUR_THREADS,
    "test_executor.py::TestExecutor::test_multi_threaded_executor_closes_threads": NO_THREADS,
    "test_init_shutdown.py::test_signal_handlers": NO_SIGNALS,
    "test_lifecycle.py::test_lifecycle_services": TESTS_BEFORE,
    "test_logging.py::TestLogging::test_log_throttle_ros_clock": ONE_TIME,
    "test_subscription.py::test_subscription_content_filter_at_create_subscription": NO_FILTERS,
    "test_subscription.py::test_subscription_content_filter_effect": NO_FILTERS,
    "test_time_source.py::TestTimeSource::test_time_source_using_sim_time": ONE_TIME,
}

Found = dict[str, tuple[str, str]]  # outcome and words of each test


class Program:
    """A test as `sim.run` takes it; names that its module has bound early count as those of a student's.

    nextitem: the test that comes after it in the same program, or None: then all is torn down.
    """

    def __init__(self, item: pytest.Item, nextitem: pytest.Item | None) -> None:
        self.item, self.nextitem, self.reports = item, nextitem, []
        self.__name__, self.__globals__ = item.name, vars(item.module)

    def __call__(self) -> None:
        """Set up, test, tear down."""
        self.reports = runtestprotocol(self.item, nextitem=self.nextitem, log=False)


class Watching:
    """Runs the tests of one file and writes a line of JSON for each. here: in a run."""

    def __init__(self, lines: Path, here: bool) -> None:
        self._lines, self._here = lines, here
        self._parts: list[pytest.TestReport] = []

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Keep the report of a subtest: only those come here, and a failed one doesn't fail its test."""
        self._parts.append(report)

    def pytest_runtest_protocol(self, item: pytest.Item, nextitem: pytest.Item | None) -> bool:
        """Instead of pytest's own."""
        self._parts.clear()
        if self._here:
            outcome = _in_a_run(item, self._parts)
        else:
            program = Program(item, nextitem)
            program()
            outcome = _outcome([*self._parts, *program.reports])
        with self._lines.open("a") as file:
            file.write(json.dumps([item.nodeid, *outcome]) + "\n")
        return True


def _in_a_run(item: pytest.Item, parts: list[pytest.TestReport]) -> tuple[str, str]:
    """The outcome of one test as a program of its own. parts: where the reports of its subtests appear."""
    from sim import run  # only here: the hooks come with it

    program = Program(item, nextitem=None)
    recording = run(program, seconds=SECONDS, quiet=True)
    if any(report.when == "teardown" for report in program.reports):
        outcome = _outcome([*parts, *program.reports])
    else:
        outcome = "differs", recording.ended.detail
        item.session._setupstate.stack.clear()  # the next test is not to tear down what went with the run
    errors = recording.errors
    refused = [f"{error.type}: {error.text}" for error in errors if error.type == "NotImplementedError"]
    return ("refused", refused[0]) if outcome[0] == "differs" and refused else outcome


def _outcome(reports: list[Any]) -> tuple[str, str]:
    """Of a test that came to its end."""
    bad = next((report for report in reports if report.failed), None)
    if bad is None:
        return ("skipped" if any(report.skipped for report in reports) else "passed"), ""
    crash = getattr(bad.longrepr, "reprcrash", None)
    refused = crash is not None and crash.path.startswith(OWN)
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
    parser.add_argument("checkout", type=Path, help="of ros2/rclpy")
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
    sys.exit(report(others))


def report(others: Found) -> int:
    """Print what does not pass in a run, with its words or the known reason; 1 if there is news, else 0."""
    news = False
    for name, (outcome, words) in sorted(others.items(), key=lambda item: (item[1], item[0])):
        known = KNOWN.get(name.removeprefix("test/")) if outcome == "differs" else None
        news |= outcome == "differs" and known is None
        print(f"{outcome}{', as known' if known else ''}: {name}\n    {known or words}")
    return int(news)


if __name__ == "__main__":
    if sys.argv[1:2] in (["plainly"], ["here"]):
        how, file, lines = sys.argv[1:]
        watching = Watching(Path(lines), how == "here")
        status = pytest.main([*OPTIONS, *LEFT_OUT, file], plugins=[watching])
        os._exit(status)  # threads that a test has left behind would keep Python from ending
    main()
