"""The plugin of pytest: runs tests that are marked with `launch`. PYTEST_DONT_REWRITE"""

from __future__ import annotations

import inspect
from collections import defaultdict
from collections.abc import Generator
from types import FunctionType
from typing import Any

import pytest

from launch_pytest.fixtures import LAUNCHES, fixture_name
from launch_pytest.marked_tests import run_test

MARK = "launch"
UNITTESTS = ("launch_testing", "launch_testing_ros")  # of other tests of launch files, which are not here


def pytest_configure(config: pytest.Config) -> None:
    """Describe the mark."""
    config.addinivalue_line(
        "markers",
        "launch(fixture, shutdown=False): runs while the launch description of a launch_pytest.fixture is "
        "executed, or after it was shut down",
    )


@pytest.hookimpl(tryfirst=True)
def pytest_pycollect_makeitem(collector: Any, name: str, obj: Any) -> list[pytest.Item] | None:
    """Collect marked generators, which pytest refuses otherwise."""
    is_function = type(obj) is FunctionType  # without a look at what it says of itself
    is_test = is_function and inspect.isgeneratorfunction(obj) and collector.istestfunction(obj, name)
    if is_test and any(mark.name == MARK for mark in getattr(obj, "pytestmark", ())):
        return list(collector._genfunctions(name, obj))
    return None


def pytest_itemcollected(item: pytest.Item) -> None:
    """Let a marked test use the fixture that its mark names."""
    name = _launch_fixture(item)
    if name is not None and name not in item.fixturenames:
        item.fixturenames.insert(0, name)


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Run the tests that need a launch to have ended after those that need it to run."""
    groups: dict[Any, list[int]] = defaultdict(list)
    for index, item in enumerate(items):
        name = _launch_fixture(item)
        if name is not None:
            groups[item.path, name].append(index)
    for indices in groups.values():
        ordered = sorted((items[index] for index in indices), key=_ends_launch)
        for index, item in zip(indices, ordered, strict=True):
            items[index] = item


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> None:
    """Refuse a mark that is wrong."""
    mark = item.get_closest_marker(MARK)
    error = None if mark is None else _mark_error(item, mark)
    if error is not None:
        pytest.fail(error, pytrace=False)


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report() -> Generator[None, pytest.CollectReport, pytest.CollectReport]:
    """Advise where a file with tests imports launch_testing."""
    report = yield
    return _advise(report, getattr(report, "call", None))  # --last-failed skips files without a call


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    call: pytest.CallInfo[None],
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Advise where a test imports launch_testing."""
    return _advise((yield), call)


def _advise(report: Any, call: pytest.CallInfo[Any] | None) -> Any:
    error = call.excinfo.value if call is not None and call.excinfo is not None else None
    error = (error and error.__cause__) or error  # pytest reports the error of an import as its own
    name = str(getattr(error, "name", None)).partition(".")[0]
    if isinstance(error, ModuleNotFoundError) and name in UNITTESTS:
        sentence = (
            f"`{name}` (tests of launch files) is a ROS package that the course does not include. "
            "launch_pytest is here and does the same for pytest."
        )
        report.sections.append(("What to do", sentence))
    return report


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> bool | None:
    """Run a marked test."""
    name = _launch_fixture(pyfuncitem)
    if name is None:
        return None
    launch = pyfuncitem.config.stash[LAUNCHES][name]
    arguments = {each: pyfuncitem.funcargs[each] for each in pyfuncitem._fixtureinfo.argnames}
    after_shutdown = bool(pyfuncitem.get_closest_marker(MARK).kwargs.get("shutdown"))
    run_test(pyfuncitem.obj, arguments, launch, after_shutdown=after_shutdown)
    return True


@pytest.fixture
def launch_service(request: pytest.FixtureRequest) -> Any:
    """The launch service of the test's launch."""
    name = _launch_fixture(request.node)
    if name is None:
        pytest.fail(
            "the fixtures launch_service, launch_context and event_loop need a test that is marked with "
            "@pytest.mark.launch(fixture=...).",
            pytrace=False,
        )
    request.getfixturevalue(name)
    return request.config.stash[LAUNCHES][name].service


@pytest.fixture
def launch_context(launch_service: Any) -> Any:
    """The launch context of the test's launch."""
    return launch_service.context


@pytest.fixture
def event_loop(launch_service: Any) -> Any:
    """The event loop of the test's launch."""
    return launch_service.event_loop


def _launch_fixture(item: pytest.Item) -> str | None:
    """The name of the fixture that a test's mark names; None for a test without such a mark."""
    mark = item.get_closest_marker(MARK) if isinstance(item, pytest.Function) else None
    return None if mark is None else fixture_name(mark.kwargs.get("fixture"))


def _mark_error(item: pytest.Item, mark: pytest.Mark) -> str | None:
    """Return what is wrong with a test's mark, or None."""
    given = mark.kwargs.get("fixture")
    if fixture_name(given) is None:
        has = "no fixture" if given is None else f"fixture={given!r}"
        return (
            "@pytest.mark.launch needs fixture=F, where F is a function that is decorated with "
            f"@launch_pytest.fixture; it has {has}."
        )
    unknown = [*map(repr, mark.args), *sorted({*mark.kwargs} - {"fixture", "shutdown"})]
    if unknown:
        return f"@pytest.mark.launch takes fixture=F and shutdown=True, but not {', '.join(unknown)}."
    if "shutdown" in mark.kwargs and _generates(item):
        return (
            "a generator runs beside the launch and, after its yield, without it: "
            "its @pytest.mark.launch takes no `shutdown`."
        )
    return None


def _generates(item: pytest.Function) -> bool:
    function = inspect.unwrap(item.function)
    return inspect.isgeneratorfunction(function) or inspect.isasyncgenfunction(function)


def _ends_launch(item: pytest.Function) -> bool:
    """Return whether a marked test shuts its launch down."""
    return _generates(item) or bool(item.get_closest_marker(MARK).kwargs.get("shutdown"))
