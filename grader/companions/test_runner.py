"""Runs a package's tests by pytest in simulated time: on its own module, and on others in place of it."""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from grader.workspace.installation import read_sources
from sim.ros.fibers.scheduler import engine
from sim.ros.launching.respawned import kill

CANDIDATES, VERDICTS = "/candidates", "/verdicts"
OWN = "own"
PASSED, FAILED = "passed", "failed"
FOLDER = "package-tests-"
OPTIONS = ("-q", "-s", "--disable-plugin-autoload", "-p", "no:cacheprovider", "--tb=short", "-o", "addopts=")
DISCOVERY = 10_000_000_000  # ns in which a program that sends candidates is discovered, if there is one
MOST_TEXT, MOST_REASON = 500, 100  # characters of a verdict, and of why a test failed


def run_tests(workspace: Any, package: str, module: str, launches: bool = False) -> Callable[[], None]:
    """A `prepare` for scenarios: a program that runs a package's tests.

    It tries the package as it is, and then each module that is published on /candidates (String, the first
    line is its name) in place of its own. Verdicts are published on /verdicts (String): a name, `passed` or
    `failed`, the number of tests, and what failed. module: its path below the package's folder. launches: the
    tests start programs, which must have ended with them.
    """

    def tests() -> None:
        sources = read_sources(workspace, package)
        _Tester(sources, package, module, launches).run()

    return tests


class _Tester:
    """Publishes verdicts on candidates, in a context of its own: the tests have the default one."""

    def __init__(self, sources: Mapping[str, bytes], package: str, module: str, launches: bool) -> None:
        self._sources, self._package, self._module, self._launches = sources, package, module, launches

    def run(self) -> None:
        """Try the package's own module, then each candidate."""
        import rclpy
        from rclpy.context import Context
        from rclpy.executors import SingleThreadedExecutor
        from rclpy.node import Node
        from rclpy.qos import DurabilityPolicy, QoSProfile
        from std_msgs.msg import String

        context = Context()
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        rclpy.init(context=context)
        node, waiting = Node("tester", context=context), []
        verdicts = node.create_publisher(String, VERDICTS, 100)
        node.create_subscription(String, CANDIDATES, lambda msg: waiting.append(msg.data), latched)  # type: ignore[attr-defined]
        begin = node.get_clock().now().nanoseconds
        executor = SingleThreadedExecutor(context=context)
        executor.add_node(node)
        while (
            not verdicts.get_subscription_count() and node.get_clock().now().nanoseconds < begin + DISCOVERY
        ):
            executor.spin_once(timeout_sec=0.1)
        executor.spin_once(timeout_sec=0.2)  # the other side discovers this one, too

        def judge(name: str, text: bytes | None) -> None:
            outcome = self._outcome(text)
            left = _end_programs() if self._launches else []
            outcome = f"{FAILED} 1 left running: {', '.join(left)}" if left else outcome
            verdicts.publish(String(data=f"{name} {outcome}"[:MOST_TEXT]))

        judge(OWN, None)
        while True:
            while not waiting:
                executor.spin_once()
            name, _, text = waiting.pop(0).partition("\n")
            judge(name, text.encode())

    def _outcome(self, text: bytes | None) -> str:
        files = {path.removeprefix(f"{self._package}/"): data for path, data in self._sources.items()}
        if text is not None:
            files[self._module] = text
        with tempfile.TemporaryDirectory(prefix=FOLDER, ignore_cleanup_errors=True) as folder:
            for path, data in files.items():
                file = Path(folder, path)
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_bytes(data)
            return _pytest(Path(folder), self._package)


def _pytest(folder: Path, package: str) -> str:
    """The outcome of the tests of the package in this folder, and of each test that failed."""
    import pytest
    from launch_pytest import plugin

    reports, before = _Reports(), list(sys.path)
    sys.path.insert(0, str(folder))
    _forget(package)
    try:
        code = pytest.main(
            [*OPTIONS, "--rootdir", str(folder), str(folder / "test")], plugins=[reports, plugin]
        )
    finally:
        sys.path[:] = before
        _forget(package)
    outcome = PASSED if code == pytest.ExitCode.OK else FAILED
    return f"{outcome} {reports.tests} {'; '.join(reports.failed) or pytest.ExitCode(code).name}"


def _end_programs() -> list[str]:
    """End the programs that this one has started, and which are still running; returns their names."""
    run = engine()
    own = run.current.process
    left = [each for each in run.programs if each is not own and not each.from_course and run.lives(each)]
    for program in left:
        kill(run, program)
    return sorted(program.name for program in left)


def _forget(package: str) -> None:
    """Let the package and its tests be imported anew, after a run that was ended in the middle as well."""
    for name, module in list(sys.modules.items()):
        at = str(getattr(module, "__file__", None) or "")
        if name.split(".")[0] == package or f"/{FOLDER}" in at:
            del sys.modules[name]


class _Reports:
    """Counts tests, and notes what failed."""

    def __init__(self) -> None:
        self.tests = 0
        self.failed: list[str] = []

    def pytest_runtest_logreport(self, report: Any) -> None:
        """Note the outcome of a test or of its set-up."""
        self.tests += report.when == "call"
        if report.failed:
            self.failed.append(f"{report.nodeid.rpartition('::')[2]}: {_reason(report)}")

    def pytest_collectreport(self, report: Any) -> None:
        """Note a file that can't be imported."""
        if report.failed:
            self.failed.append(_reason(report))


def _reason(report: Any) -> str:
    """The first line of what an assertion or an error states."""
    crash = getattr(report.longrepr, "reprcrash", None)
    if crash:
        return str(crash.message).partition("\n")[0][:MOST_REASON]
    lines = [line for line in str(report.longreprtext).splitlines() if line.startswith("E ")]
    return lines[-1].removeprefix("E").strip() if lines else str(report.nodeid)
